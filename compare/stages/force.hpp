// Defines what the stages of energies share; each returns force and block of one vertex of a stencil. Lengths are 0 or
// at least 2⁻⁵⁰ m. Exceptions: 2⁻³⁰ m for bending, whose fourth power is a normal number; 2⁻⁶³ m for springs and
// contacts, but the longest distance of four vertices that meet is at least 2⁻³⁰ m. The reference returns the energy's
// derivative and the block of method.md §4.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// The answer by case: force −∂E/∂x [N] and the symmetric 3×3 block of the sweep [N/m], both of the vertex `own`.
struct ForceOut {
  std::vector<Vec3f> force;                 ///< [N]
  std::vector<std::array<float, 6>> block;  ///< xx, xy, xz, yy, yz, zz [N/m]
};

/// Holds one accepted answer and the units of its errors. A unit is Σ ‖∂f/∂q‖ ‖q‖ over the inputs q of the stencil.
/// Coordinates count as vectors relative to one vertex; for a hinge to the vertex that makes the sum largest, since a
/// formula may choose any. A relative change u of each input changes the answer by up to u units, so no formula that
/// reads single-precision differences can do much better.
struct ForceAnswer {
  Vec3 force;                               ///< [N]
  std::array<double, 6> block{};            ///< [N/m]
  double force_scale = 0, block_scale = 0;  ///< units of their errors [N], [N/m]
};

/// Roundings that `per_vertex` damping adds to those of the block: the motion (1), the product of matrix and vector (3)
/// and a sum (1).
inline constexpr double per_vertex_additions = 5;

/// accepted[i][0] is the exact answer of case i; a grey case has more: answers on the other side of a jump. near[i] is
/// 1 if a decision of case i lies within near_factor. contact_force and friction_force decide the features of the
/// closest points, d = r, and d = τ of an activation with two stages. Decisions of other energies do not show in their
/// answers.
struct ForceTruth {
  std::vector<std::vector<ForceAnswer>> accepted;  ///< by case, the exact one first
  std::vector<std::uint8_t> near;                  ///< by case
};

}  // namespace ogc::compare
