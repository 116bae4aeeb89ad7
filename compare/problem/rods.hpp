// Lists the constants of rods, finds them in a scene and checks them. Rods are bodies whose loose edges, their
// segments, have a material and an orientation each.
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
  double minimum, maximum;               ///< inclusive; single precision holds both exactly
  double RodMaterial::*field;            ///< the member that it sets
};

/// Returns the rows of all constants, in the order of the struct; their ranges are as in material_table.
std::span<const RodInfo> rod_table();

/// Check and describe a constant as compare/problem/ranges.hpp does for materials: whether it may have this value, and
/// "a number from 1 to 1024 N (meaning)".
bool in_range(const RodInfo& info, double value);
std::string describe_range(const RodInfo& info);

/// Returns the numbers of the loose edges that are segments, that is, in bodies with a rod material, ascending. Every
/// list of orientations has this order. Indices are valid, and bodies cover the scene.
std::vector<Index> rod_segments(const Scene& scene);

/// Returns whether a body of the scene is a rod.
bool has_rods(const Scene& scene);

/// Returns what holds each segment: −1: nothing; 0: it is fixed; k ≥ 1: both of its ends are in the k-th prescribed
/// motion.
std::vector<Index> segment_groups(const Scene& scene, std::span<const Index> segments);

/// Returns whether a motion determines how its segments turn: any rigid motion does, also one written as keyframes.
bool says_turn(const PrescribedMotion& motion);
/// Returns the rotation of such a motion from one time to another [s], computed in double and rounded once.
Quaternion prescribed_turn(const PrescribedMotion& motion, double from, double to);

/// Adds what is wrong with the scene's rods: constants out of range, a rod without segments, free vertices on loose
/// edges of a body that is no rod, segments that reverse onto their neighbour at rest, orientations that are no unit
/// quaternions or not one for each segment. Indices are valid, and bodies cover the scene.
void check_rods(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names, std::size_t limit);

/// Returns the number of the first that is no unit quaternion within unit_quaternion_slack, or −1.
std::ptrdiff_t find_no_unit(std::span<const Quaternion> orientations);

}  // namespace ogc::compare
