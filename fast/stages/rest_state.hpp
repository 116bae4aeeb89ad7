// Rest data of a scene: what its bodies and vertices have, and the elements of each kind.
#pragma once

#include "fast/stages/kinds/hinge.hpp"
#include "fast/stages/kinds/segment.hpp"
#include "fast/stages/kinds/spring.hpp"
#include "fast/stages/kinds/tetrahedron.hpp"
#include "fast/stages/kinds/triangle.hpp"

namespace ogc::fast {

/// The elements of all kinds in a list.
template <class List>
struct AllAtRest;
template <class... All>
struct AllAtRest<KindList<All...>> : AtRest<All>... {};

/// What a step has to know of the rest shape.
struct RestState : RestShared, AllAtRest<Kinds> {};

/// The elements of one kind.
template <class Kind>
const AtRest<Kind>& at_rest(const RestState& rest) {
  return rest;
}

/// Throws InputError for vertices that move and have no mass, and for free volumes, which are not simulated yet.
RestState build_rest_state(const compare::Scene& scene, const compare::Topology& topology);

/// The simulation's rest state as the judge asks for it.
compare::RestStateOut rest_state_out(const compare::RestStateIn& in);

/// The rest state whose numbers are those of `out`; what `out` does not say (mobility, materials) from the scene.
RestState rest_state_of(const compare::RestStateIn& in, const compare::RestStateOut& out);

}  // namespace ogc::fast
