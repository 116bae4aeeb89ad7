// The stages of the reference under the judge's names.
#include "reference/contestant.hpp"

#include "reference/energies/bending.hpp"
#include "reference/energies/membrane.hpp"
#include "reference/geometry/activation.hpp"
#include "reference/geometry/bound.hpp"
#include "reference/geometry/closest_face.hpp"
#include "reference/geometry/closest_points.hpp"
#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "reference/geometry/truncate.hpp"

namespace ogc::reference {

compare::Authority authority() {
  compare::Authority authority;
  authority.name = "reference";
  authority.closest_face = closest_face;
  authority.closest_points = closest_points;
  authority.detect_vertex_facet = detect_vertex_facet;
  authority.detect_edge_edge = detect_edge_edge;
  authority.bound = bound;
  authority.activation = activation;
  authority.truncate = truncate;
  authority.membrane = [](const compare::MembraneIn& in) { return membrane(in); };
  authority.bending = [](const compare::BendingIn& in) { return bending(in); };
  return authority;
}

}  // namespace ogc::reference
