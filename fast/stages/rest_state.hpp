// Holds the rest data of a scene: of its bodies, its vertices, and its elements by kind.
#pragma once

#include "fast/stages/kinds/hinge.hpp"
#include "fast/stages/kinds/segment.hpp"
#include "fast/stages/kinds/spring.hpp"
#include "fast/stages/kinds/tetrahedron.hpp"
#include "fast/stages/kinds/triangle.hpp"

namespace ogc::fast {

/// Holds the elements of all kinds of `List`.
template <class List>
struct AllAtRest;
template <class... All>
struct AllAtRest<KindList<All...>> : AtRest<All>... {};

/// The rest data of a scene that a step reads.
struct RestState : RestShared, AllAtRest<Kinds> {};

/// Returns the elements of one kind.
template <class Kind>
const AtRest<Kind>& at_rest(const RestState& rest) {
  return rest;
}

/// Computes the rest data of a scene. Throws InputError for moving vertices without mass.
RestState build_rest_state(const compare::Scene& scene, const compare::Topology& topology);

/// Returns the simulation's rest state in the judge's format.
compare::RestStateOut rest_state_out(const compare::RestStateIn& in);

/// Returns the rest state with the rest values of `out`. Mobility and materials are those of the scene, because `out`
/// does not contain them.
RestState rest_state_of(const compare::RestStateIn& in, const compare::RestStateOut& out);

}  // namespace ogc::fast
