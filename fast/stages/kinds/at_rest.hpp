// The elements of a scene at rest, kind by kind, made once on the host in double and rounded once. A kind says in a
// file beside this one
//
//   elements, rest_beside        its elements, and the data that some models read beside them (RestBeside)
//   add(build)                   adds those of a scene, and their masses
//   add(in, out)                 adds those whose numbers are an answer's to the judge
//   give                         writes them as the judge asks for them
//   reads_beside, beside         whether a model of the scene reads what lies beside an incidence (Beside)
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

/// What a scene has at rest beside its elements.
struct RestShared {
  /// m_v [kg]: a third of each incident triangle's, a quarter of each incident tetrahedron's, half of each incident
  /// segment's; 0 on fixed bodies
  std::vector<float> mass;
  std::vector<Mobility> mobility;
  std::vector<int> body;                   ///< of each vertex
  std::vector<float> edge_length_squared;  ///< ‖ē‖² by edge [m²]
  std::vector<SurfaceMaterial> materials;  ///< by body
  std::vector<SurfaceModels> models;       ///< by body
  ContactActivation activation = ContactActivation::ogc;
  std::vector<ContactMaterial> contact;  ///< of bodies a and b, at a · bodies + b
};

/// What a kind's elements are made of.
struct RestBuild {
  const compare::Scene& scene;
  const compare::Topology& topology;
  const RestShared& shared;   ///< without masses
  std::vector<double>& mass;  ///< by vertex [kg]; elements add theirs
};

/// The elements of a kind at rest. What a kind has if it does not say otherwise:
template <class Kind>
struct PlainAtRest {
  std::vector<NoData> rest_beside() const { return {}; }
  bool reads_beside(const RestShared&) const { return false; }
  NoData beside(int, int) const { return {}; }
  std::vector<typename Kind::ByBody> by_body(const RestShared&) const { return {}; }
};
template <class Kind>
struct AtRest;

/// Converts an index of the mesh to an index of an array.
inline std::size_t as_index(int i) { return static_cast<std::size_t>(i); }

}  // namespace ogc::fast
