// Planes between near pairs and balls for all others, by definition (method.md §5.6).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/stages/plane.hpp"

namespace ogc::reference {

/// A pair within r_q: its vertices, with those of the second side from `second_from` on; its distance, rounded down;
/// its plane, if it has one.
struct NearPair {
  compare::PrimitivePair pair;
  std::array<compare::Index, 4> vertices{};
  std::size_t second_from = 1;
  float below = 0;                             ///< [m]
  bool has_plane = false;  ///< whether it has a plane that every vertex keeps in single precision, exactly
  compare::Vec3f normal{};                     ///< n, from the first side to the second
  double first_offset = 0, second_offset = 0;  ///< upper limit of n·x on the first side, lower limit on the second [m]

  /// Returns the plane as the pair's k-th vertex bears it.
  compare::VertexPlane as_borne(std::size_t k) const;
};

/// Returns all pairs within r_q, ascending, each with the plane that it may have. With the closest points c_p, c_q,
/// found exactly, n = (c_q − c_p)/d; the two offsets lie γ_p d from the sides, or 2γ_p d from one where the other is
/// fixed. With displacements two sides that can move share 2γ_p d as in PlaneFreedom::division. `sought`: by vertex;
/// where it is not empty, only pairs with a vertex that is marked there. In parallel; the answer does not depend on the
/// number of threads.
std::vector<NearPair> near_pairs_with_planes(const compare::PlaneIn& in, std::span<const std::uint8_t> sought = {});

/// Returns the planes of pairs that are nearer than the 17th nearest pair of each of their vertices that can move; all
/// other pairs limit the balls.
compare::PlaneOut pair_planes(const compare::PlaneIn& in);

}  // namespace ogc::reference
