// Registers the reference's stages under the judge's names. Apart from contestant.cpp, so that a judge links without
// solvers and CHOLMOD.
#include "reference/contestant.hpp"

#include "reference/definitions/volume_depth.hpp"
#include "reference/energies/activation.hpp"
#include "reference/energies/bending.hpp"
#include "reference/energies/contact_force.hpp"
#include "reference/energies/friction_force.hpp"
#include "reference/energies/membrane.hpp"
#include "reference/energies/rods/orientation.hpp"
#include "reference/energies/rods/rod.hpp"
#include "reference/energies/spring.hpp"
#include "reference/energies/tetrahedron.hpp"
#include "reference/energies/volume_force.hpp"
#include "reference/geometry/block.hpp"
#include "reference/geometry/bound.hpp"
#include "reference/geometry/closest_face.hpp"
#include "reference/geometry/closest_points.hpp"
#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "reference/geometry/plane.hpp"
#include "reference/geometry/truncate.hpp"
#include "reference/ipc/stages.hpp"
#include "reference/solvers/initial_guess.hpp"
#include "reference/solvers/kinds/rest_state.hpp"
#include "reference/solvers/step.hpp"
#include "reference/solvers/sweep.hpp"

namespace ogc::reference {

compare::Authority authority() {
  compare::Authority authority;
  authority.name = "reference";
  authority.closest_face = closest_face;
  authority.closest_points = closest_points;
  authority.detect_vertex_facet = detect_vertex_facet;
  authority.detect_edge_edge = detect_edge_edge;
  authority.bound = bound;
  authority.plane = plane;
  authority.volume_depth = volume_depth;
  authority.activation = activation;
  authority.barrier = barrier_truth;
  authority.ccd = ccd_truth;
  authority.truncate = truncate;
  authority.membrane = [](const compare::MembraneIn& in) { return membrane(in); };
  authority.bending = [](const compare::BendingIn& in) { return bending(in); };
  authority.spring = [](const compare::SpringIn& in) { return spring(in); };
  authority.tetrahedron = [](const compare::TetrahedronIn& in) { return tetrahedron(in); };
  authority.rod = [](const compare::RodIn& in) { return rod(in); };
  authority.orientation = [](const compare::OrientationIn& in) { return orientation(in); };
  authority.contact_force = [](const compare::ContactForceIn& in) { return contact_force(in); };
  authority.friction_force = [](const compare::FrictionForceIn& in) { return friction_force(in); };
  authority.volume_force = [](const compare::VolumeForceIn& in) { return volume_force(in); };
  authority.rest_state = rest_state;
  authority.block = block;
  authority.initial_guess = initial_guess;
  authority.sweep = sweep;
  authority.step = step;
  return authority;
}

}  // namespace ogc::reference
