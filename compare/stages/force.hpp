// What the energies of a sweep share: a question is a stencil and the vertex asked about. Lengths are 0 or at least
// 2⁻⁵⁰ m (bending: 2⁻³⁰ m, whose fourth power is a normal number; springs and contacts: 2⁻⁶³ m, but of four vertices
// that meet the longest distance is at least 2⁻³⁰ m). The reference gives the energy's derivative and the block of
// method.md §4.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// By case: force −∂E/∂x [N] and the symmetric 3×3 block of the sweep, xx, xy, xz, yy, yz, zz [N/m], both of the vertex
/// asked about.
struct ForceOut {
  std::vector<Vec3f> force;                 ///< [N]
  std::vector<std::array<float, 6>> block;  ///< xx, xy, xz, yy, yz, zz [N/m]
};

/// One acceptable answer, and the units of its errors: Σ ‖∂f/∂q‖ ‖q‖ over the inputs q of the stencil, where
/// coordinates are vectors relative to one vertex (of a hinge: to the one that makes it largest, as a formula reads
/// them relative to a vertex of its choice). It is what a relative change u of each input does to the answer, so no
/// formula that reads single-precision differences can do much better.
struct ForceAnswer {
  Vec3 force;                               ///< [N]
  std::array<double, 6> block{};            ///< [N/m]
  double force_scale = 0, block_scale = 0;  ///< units of their errors [N], [N/m]
};

/// A force with `per_vertex` damping is known as well as the block, and the motion (1), the product of matrix and
/// vector (3) and a sum on top of it.
inline constexpr double per_vertex_additions = 5;

/// accepted[i][0] is the exact answer of case i; more than one where the case is grey: an answer on the other side of a
/// jump. near[i] is 1 where a decision of case i lies within near_factor: of contact_force and friction_force the
/// features of the closest points, d = r, and d = τ of an activation with two stages. The other energies decide nothing
/// that their answers would show.
struct ForceTruth {
  std::vector<std::vector<ForceAnswer>> accepted;  ///< by case, the exact one first
  std::vector<std::uint8_t> near;                  ///< by case
};

}  // namespace ogc::compare
