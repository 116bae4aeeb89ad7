// Rods: bodies whose loose edges, their segments, have a material and an orientation each. What they are called, which
// they are, and what makes a rod one that can be simulated.
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
  double RodMaterial::*field;            ///< where it is kept
};

/// All constants, in the order of the struct. Ranges are those of material_table.
std::span<const RodInfo> rod_table();

/// Whether a constant may have this value, and "a number from 1 to 1024 N (meaning)", as of other materials
/// (compare/problem/ranges.hpp).
bool in_range(const RodInfo& info, double value);
std::string describe_range(const RodInfo& info);

/// Numbers of the loose edges that are segments, those of bodies with a rod material, ascending: the order of every
/// list of orientations. Indices are valid, and bodies cover the scene.
std::vector<Index> rod_segments(const Scene& scene);

/// Whether a body of the scene is a rod.
bool has_rods(const Scene& scene);

/// What holds each segment: −1: nothing; 0: it is fixed; k ≥ 1: both of its ends are in the k-th prescribed motion.
std::vector<Index> segment_groups(const Scene& scene, std::span<const Index> segments);

/// Whether a motion says how what it moves turns: any that is rigid does, written as keyframes or not.
bool says_turn(const PrescribedMotion& motion);
/// How such a motion turns from one time to another [s], computed in double and rounded once.
Quaternion prescribed_turn(const PrescribedMotion& motion, double from, double to);

/// What is wrong with the scene's rods: constants out of range, a rod without segments, free vertices on loose edges of
/// a body that is no rod, segments that reverse onto their neighbour at rest, orientations that are no unit quaternions
/// or not one for each segment. Indices are valid, and bodies cover the scene.
void check_rods(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names, std::size_t limit);

/// The first that is no unit quaternion within unit_quaternion_slack, or −1.
std::ptrdiff_t find_no_unit(std::span<const Quaternion> orientations);

}  // namespace ogc::compare
