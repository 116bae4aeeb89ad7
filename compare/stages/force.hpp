// Defines the answers of the stages of energies. Each of these stages returns force and block of one vertex of a
// stencil. The reference returns the derivative of the energy and the block of method.md §4.
//
// Lengths are 0 or at least 2⁻⁵⁰ m, with these exceptions:
//
// - bending: 2⁻³⁰ m, whose fourth power is a normal number
// - springs and contacts: 2⁻⁶³ m, but the longest distance of the four vertices of a contact is at least 2⁻³⁰ m
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

/// Holds one accepted answer and its error scales. A scale is Σ ‖∂f/∂q‖ ‖q‖ over the inputs q of the stencil.
/// Coordinates count as vectors relative to one vertex. For a hinge this is the vertex that makes the sum largest,
/// since a formula may choose any vertex. A relative change u of each input changes the answer by up to u · scale, so
/// no formula that reads single-precision differences can be much more exact.
struct ForceAnswer {
  Vec3 force;                               ///< [N]
  std::array<double, 6> block{};            ///< [N/m]
  double force_scale = 0, block_scale = 0;  ///< error scales [N], [N/m]
};

/// Rounding errors that `per_vertex` damping adds to those of the block: the motion (1), the product of matrix and
/// vector (3) and a sum (1).
inline constexpr double per_vertex_additions = 5;

/// accepted[i][0] is the exact answer of case i. If decisions of the case are grey, the answers for their other
/// outcomes are accepted, too. near[i] is 1 if a decision of case i lies within near_factor; without contacts it is 0.
/// The decisions are
///
/// - which features hold the closest points,
/// - whether d < r,
/// - whether d < τ, if the activation has two branches,
/// - whether a slip is below its limit.
struct ForceTruth {
  std::vector<std::vector<ForceAnswer>> accepted;  ///< by case, the exact one first
  std::vector<std::uint8_t> near;                  ///< by case
};

}  // namespace ogc::compare
