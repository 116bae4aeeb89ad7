// Rest data of a scene, made once on the host in double and rounded once. Triangles and hinges without energy (fixed
// bodies, models `none`) are left out here, so that no later stage has to ask.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/scene.hpp"
#include "compare/stages/rest_state.hpp"
#include "fast/kernels/contact_force.hpp"
#include "fast/kernels/models/hinge.hpp"
#include "fast/kernels/models/membrane.hpp"
#include "fast/kernels/models/spring.hpp"
#include "fast/kernels/models/tetrahedron.hpp"
#include "fast/stages/rods_at_rest.hpp"

namespace ogc::fast {

/// How a vertex moves.
enum class Mobility : std::uint8_t { free, prescribed, fixed };

/// What the sweep has to know of the rest shape.
struct RestState {
  /// m_v [kg]: a third of each incident triangle's, a quarter of each incident tetrahedron's, half of each incident
  /// segment's; 0 on fixed bodies
  std::vector<float> mass;
  std::vector<Mobility> mobility;
  std::vector<int> body;  ///< of each vertex
  std::vector<TriangleRest> triangles;
  std::vector<HingeRest> hinges;
  std::vector<HingeWeights> weights;  ///< by hinge; empty where no model reads them
  std::vector<SpringRest> springs;
  std::vector<TetrahedronRest> tetrahedra;
  RodsAtRest rods;
  std::vector<float> edge_length_squared;  ///< ‖ē‖² by edge [m²]
  std::vector<SurfaceMaterial> materials;  ///< by body
  std::vector<SurfaceModels> models;       ///< by body
  std::vector<SolidMaterial> solids;       ///< by body
  ContactActivation activation = ContactActivation::ogc;
  std::vector<ContactMaterial> contact;  ///< of bodies a and b, at a · bodies + b
};

/// Throws InputError for vertices that move and have no mass, and for free volumes, which are not simulated yet.
RestState build_rest_state(const compare::Scene& scene, const compare::Topology& topology);

/// The simulation's rest state as the judge asks for it.
compare::RestStateOut rest_state_out(const compare::RestStateIn& in);

/// The rest state whose numbers are those of `out`; what `out` does not say (mobility, materials) from the scene.
RestState rest_state_of(const compare::RestStateIn& in, const compare::RestStateOut& out);

}  // namespace ogc::fast
