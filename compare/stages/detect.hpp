// Defines what detect_vertex_facet and detect_edge_edge share: their input, and how their truths describe grey
// decisions.
#pragma once

#include <span>
#include <vector>

#include "compare/problem/exclusions.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// Input of detect_vertex_facet and detect_edge_edge. It holds views; their owner must outlive the call.
struct DetectIn {
  const Topology* topology = nullptr;  ///< of the mesh
  ExclusionView exclusions;            ///< groups: length vertex_count or 0 (see exclusions(Scene))
  std::span<const Vec3f> positions;    ///< [m], length vertex_count
  float contact_radius = 0;            ///< r [m]
  float query_radius = 0;              ///< r_q ≥ r [m]
};

/// A grey decision: an answer may contain any one of `contacts`, or none if `absence_accepted`.
template <class Contact>
struct GreyDecision {
  std::vector<Contact> contacts;  ///< alternatives, all accepted
  bool absence_accepted = false;  ///< whether an answer may contain none of them
};

/// Largest amount by which a smallest distance may be too small, in units of u · max(d, Σ|δ|), u = 2⁻²⁴: the larger of
/// the tolerances of distance_below in the stages closest_face and closest_points.
inline constexpr double detect_below_tolerance = 32;

}  // namespace ogc::compare
