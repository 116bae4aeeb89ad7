// Holds what the two detections share: their question, and lists of grey cases.
#pragma once

#include <span>
#include <vector>

#include "compare/problem/exclusions.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// The question of detect_vertex_facet and detect_edge_edge. Views; the owner must outlive the call.
struct DetectIn {
  const Topology* topology = nullptr;  ///< of the mesh
  ExclusionView exclusions;            ///< groups: length vertex_count or 0 (see exclusions(Scene))
  std::span<const Vec3f> positions;    ///< [m], length vertex_count
  float contact_radius = 0;            ///< r [m]
  float query_radius = 0;              ///< r_q ≥ r [m]
};

/// A grey decision: an answer may hold any one of `contacts`, or none if `absence_accepted`.
template <class Contact>
struct GreyDecision {
  std::vector<Contact> contacts;  ///< alternatives, all accepted
  bool absence_accepted = false;  ///< whether an answer may hold none of them
};

/// Largest shortfall accepted in a smallest distance, in units of u · max(d, Σ|δ|), as for distance_below of the pair
/// stages.
inline constexpr double detect_below_tolerance = 32;

}  // namespace ogc::compare
