// What keeps a vertex from passing through others between two detections (method.md §5.6), and what each policy is.
// Code asks for a trait and never for a policy by name, so that a new one is a row here and its kernel.
#pragma once

#include <cstdint>

namespace ogc::compare {

/// A ball about X_prev, as in the paper; planes between near pairs, and a ball for the others; nothing; planes as
/// *Divide and Truncate* has them. As wide as every other setting.
enum class Bounds : std::int64_t { ball, planes, off, dat };

/// What code asks of a policy.
struct BoundsTraits {
  bool certifies = true;    ///< whether vertices that keep their bounds meet nothing until the next detection
  bool has_planes = false;  ///< whether near pairs have planes
  bool divides = false;     ///< whether a plane divides its gap by displacements, in place of halves
  bool slides = true;       ///< whether a vertex is cut to its region wherever it goes, or stops on its way from X_prev
};

/// The table of policies.
constexpr BoundsTraits traits_of(Bounds bounds) {
  switch (bounds) {
    case Bounds::ball: return {};
    case Bounds::planes: return {.has_planes = true};
    case Bounds::off: return {.certifies = false};
    case Bounds::dat: return {.has_planes = true, .divides = true, .slides = false};
  }
  return {};
}

}  // namespace ogc::compare
