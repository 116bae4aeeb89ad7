// The stages of a contestant, one after another, for who wraps them all.
#pragma once

#include "compare/problem/contestant.hpp"

namespace ogc::compare {

/// Calls visit(name, pointer to member) for each stage that a contestant may have; the names are those of
/// compare/judge/stage.hpp.
template <class Visit>
void visit_stages(Visit visit) {
  visit("closest_face", &Contestant::closest_face);
  visit("closest_points", &Contestant::closest_points);
  visit("block", &Contestant::block);
  visit("detect_vertex_facet", &Contestant::detect_vertex_facet);
  visit("detect_edge_edge", &Contestant::detect_edge_edge);
  visit("bound", &Contestant::bound);
  visit("initial_guess", &Contestant::initial_guess);
  visit("activation", &Contestant::activation);
  visit("contact_force", &Contestant::contact_force);
  visit("friction_force", &Contestant::friction_force);
  visit("membrane", &Contestant::membrane);
  visit("bending", &Contestant::bending);
  visit("spring", &Contestant::spring);
  visit("truncate", &Contestant::truncate);
  visit("rest_state", &Contestant::rest_state);
  visit("sweep", &Contestant::sweep);
  visit("step", &Contestant::step);
}

}  // namespace ogc::compare
