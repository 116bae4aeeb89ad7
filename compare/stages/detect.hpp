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

/// Largest amount by which an answer's d_min may be below the exact smallest distance d, in units of u · max(d, Σ|δ|),
/// u = 2⁻²⁴. δ are the coordinates of the nearest pair relative to its first vertex. This is the larger of
/// closest_face_below_tolerance and closest_points_below_tolerance.
inline constexpr double detect_below_tolerance = 32;

}  // namespace ogc::compare
