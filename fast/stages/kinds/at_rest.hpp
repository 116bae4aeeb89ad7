// Holds the elements of a scene at rest, by kind. They are made once on the host in double and rounded once. Each kind
// defines in a file of this folder:
//
//   elements, rest_beside        its elements, and the data that some models read beside them (RestBeside)
//   add(build)                   adds the elements of a scene, and their masses
//   add(in, out)                 adds the elements with the rest values of a contestant's answer to the judge
//   give                         writes the elements in the judge's format
//   reads_beside, beside         whether a model of the scene reads extra data of an incidence; these data (Beside)
//   damps                        whether an element is damped
//   by_body                      constants by body (ByBody)
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/scene.hpp"
#include "compare/stages/rest_state.hpp"
#include "fast/kernels/contact_force.hpp"
#include "fast/kernels/kinds/kinds.hpp"

namespace ogc::fast {

/// How a vertex moves.
enum class Mobility : std::uint8_t { free, prescribed, fixed };

/// Holds the rest data of a scene except its elements.
struct RestShared {
  /// m_v [kg]: a third of the mass of each incident triangle, a quarter of each tetrahedron's, half of each segment's;
  /// 0 on fixed bodies
  std::vector<float> mass;
  std::vector<Mobility> mobility;
  std::vector<int> body;                   ///< by vertex
  std::vector<float> edge_length_squared;  ///< ‖ē‖² by edge [m²]
  std::vector<SurfaceMaterial> materials;  ///< by body
  std::vector<SurfaceModels> models;       ///< by body
  ContactActivation activation = ContactActivation::ogc;
  std::vector<ContactMaterial> contact;  ///< of bodies a and b, at a · bodies + b
};

/// The data from which a kind's elements are made.
struct RestBuild {
  const compare::Scene& scene;
  const compare::Topology& topology;
  const RestShared& shared;   ///< without masses
  std::vector<double>& mass;  ///< by vertex [kg]; each kind adds the masses of its elements
};

/// The defaults of AtRest.
template <class Kind>
struct PlainAtRest {
  std::vector<NoData> rest_beside() const { return {}; }
  bool reads_beside(const RestShared&) const { return false; }
  NoData beside(int, int) const { return {}; }
  std::vector<typename Kind::ByBody> by_body(const RestShared&) const { return {}; }
};
template <class Kind>
struct AtRest;

inline std::size_t as_index(int i) { return static_cast<std::size_t>(i); }

}  // namespace ogc::fast
