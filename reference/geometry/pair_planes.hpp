// Computes by their definition the planes between the sides of near pairs, and the balls for all other pairs (method.md
// §5.6).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/stages/plane.hpp"

namespace ogc::reference {

/// A pair within r_q, with its plane if it has one. The vertices of the second side begin at `second_from`.
struct NearPair {
  compare::PrimitivePair pair;               ///< kind, and numbers of the primitives
  std::array<compare::Index, 4> vertices{};  ///< vertices of the first side, then of the second
  std::size_t second_from = 1;
  float below = 0;          ///< the distance, rounded down [m]
  bool has_plane = false;   ///< whether a plane rounded to single precision separates the sides, decided exactly
  compare::Vec3f normal{};  ///< n, from the first side to the second
  double first_offset = 0, second_offset = 0;  ///< upper limit of n·x on the first side, lower limit on the second [m]

  /// Returns the half-space of the pair's k-th vertex, as VertexPlane.
  compare::VertexPlane as_borne(std::size_t k) const;
};

/// Returns all pairs within r_q, ascending, with their planes if they can have one (method.md §5.6). The normal is n =
/// (c_q − c_p)/d for the exact closest points c_p and c_q. Each offset lies γ_p d from its side, or 2γ_p d if the other
/// side is fixed. If displacements are given and both sides can move, the offsets divide 2γ_p d between the sides
/// (PlaneFreedom::division). If `sought` (by vertex) is not empty, only pairs with a marked vertex are returned. Runs
/// in parallel; the answer does not depend on the number of threads.
std::vector<NearPair> near_pairs_with_planes(const compare::PlaneIn& in, std::span<const std::uint8_t> sought = {});

/// Returns planes and balls. A pair has a plane if, for each of its movable vertices, it is nearer than the vertex's
/// 17th nearest pair. All other pairs limit the balls.
compare::PlaneOut pair_planes(const compare::PlaneIn& in);

}  // namespace ogc::reference
