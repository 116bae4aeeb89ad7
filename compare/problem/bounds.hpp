// Lists the policies that keep vertices from passing through others between two detections (method.md §5.6), with their
// traits. Code reads traits and never compares a policy by name. So a new policy needs only a row here and a kernel.
#pragma once

#include <cstdint>

namespace ogc::compare {

/// `ball`: the paper's ball about X_prev. `planes`: planes between near pairs, and a ball for the other pairs. `off`:
/// no bounds. `dat`: planes as in *Divide and Truncate*. The underlying type is the same for all settings that are
/// choices.
enum class Bounds : std::int64_t { ball, planes, off, dat };

/// The properties of a policy, which code reads in place of its name.
struct BoundsTraits {
  bool certifies = true;    ///< whether the bounds prove that no faces touch until the next detection
  bool has_planes = false;  ///< whether near pairs have planes
  bool divides = false;  ///< whether displacements decide how a plane divides its gap; otherwise the halves are equal
  bool slides = true;    ///< whether a cut vertex slides into its region; otherwise it stops on its path from X_prev
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
