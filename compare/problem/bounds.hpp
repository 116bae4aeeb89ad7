// Lists the policies that keep a vertex from passing through others between two detections (method.md §5.6), with their
// traits. Code reads a trait and never compares a policy by name, so a new policy is a row here and a kernel.
#pragma once

#include <cstdint>

namespace ogc::compare {

/// `ball` is the paper's ball about X_prev; `planes` puts planes between near pairs and a ball for the others; `off`
/// bounds nothing; `dat` has planes as *Divide and Truncate* has them. The enumeration is as wide as every other
/// setting.
enum class Bounds : std::int64_t { ball, planes, off, dat };

/// The traits of a policy that code reads.
struct BoundsTraits {
  bool certifies = true;    ///< whether vertices that keep their bounds meet nothing until the next detection
  bool has_planes = false;  ///< whether near pairs have planes
  bool divides = false;     ///< whether displacements decide how a plane divides its gap; otherwise into halves
  bool slides = true;       ///< whether a cut vertex slides into its region; otherwise it stops on its way from X_prev
};

/// Returns the traits of a policy.
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
