// Lists the constants of rods, finds rods in a scene and checks them. Rods are bodies whose loose edges, called
// segments, have a material and an orientation.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/problem/scene.hpp"
#include "compare/problem/validate.hpp"

namespace ogc::compare {

/// One row of the table of a rod's constants.
struct RodInfo {
  std::string_view name, unit, meaning;  ///< "stretch", "N", one line
  double minimum, maximum;               ///< inclusive; both are exact in single precision
  double RodMaterial::*field;            ///< the member that it sets
};

/// Returns the rows of all constants, in the order of the struct. Like the ranges of material_table, their ranges keep
/// squares and products of two constants finite and normal in single precision.
std::span<const RodInfo> rod_table();

/// in_range returns whether the constant may have the value; describe_range returns its range as text, as
/// compare/problem/ranges.hpp does for materials.
bool in_range(const RodInfo& info, double value);
std::string describe_range(const RodInfo& info);

/// Returns the indices of the loose edges that are segments (edges of bodies with a rod material), ascending. Every
/// list of orientations has this order. Indices must be valid, and bodies must cover the scene.
std::vector<Index> rod_segments(const Scene& scene);

/// Returns whether a body of the scene is a rod.
bool has_rods(const Scene& scene);

/// Returns for each segment −1 if it is free, 0 if it is fixed, and k ≥ 1 if both of its ends are in the k-th
/// prescribed motion.
std::vector<Index> segment_groups(const Scene& scene, std::span<const Index> segments);

/// Returns whether a motion determines the rotation of its segments: it is rigid. Keyframes, too, may be those of a
/// rigid motion (Keyframes::is_rigid).
bool says_turn(const PrescribedMotion& motion);
/// Returns the rotation of a rigid motion between the times `from` and `to` [s], computed in double and rounded once.
Quaternion prescribed_turn(const PrescribedMotion& motion, double from, double to);

/// Adds the problems of the scene's rods. Indices must be valid, and bodies must cover the scene. Problems are:
///
/// - constants out of range
/// - a rod without segments
/// - free vertices on loose edges of a body that is no rod
/// - segments that reverse onto their neighbour at rest
/// - orientations that are no unit quaternions, or more or fewer orientations than segments
void check_rods(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names, std::size_t limit);

/// Returns the index of the first quaternion whose length is not 1 within unit_quaternion_slack, or −1.
std::ptrdiff_t find_no_unit(std::span<const Quaternion> orientations);

}  // namespace ogc::compare
