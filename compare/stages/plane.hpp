// Stage plane: with bounds of planes, the region that holds each vertex until the next detection (method.md §5.6):
// half-spaces of near pairs, and a ball for all pairs without one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/detect.hpp"
#include "compare/stages/truncate.hpp"
#include "compare/stages/vertex_planes.hpp"

namespace ogc::compare {

/// Returns the question of stage truncate for a vertex that bears these planes and has no forces but inertia; empty if
/// it bears none. `is_prescribed`: the vertex does not slide; with bounds=dat no vertex does, and `current` is X_prev.
inline HalfSpacesIn half_spaces_of(std::span<const VertexPlane> planes, const Vec3f& current, bool is_prescribed) {
  if (planes.empty()) return {};
  HalfSpacesIn all{.offsets = {0, static_cast<Index>(planes.size())},
                   .items = {},
                   .current = {current},
                   .block = {inertia_block},
                   .is_prescribed = {static_cast<std::uint8_t>(is_prescribed)}};
  for (const VertexPlane& plane : planes) all.items.push_back({plane.normal, plane.offset});
  return all;
}

/// A state, and what decides which pairs count.
struct PlaneIn {
  const Topology* topology = nullptr;      ///< of the whole scene
  ExclusionView exclusions;                ///< excluded pairs
  std::span<const Vec3f> positions;        ///< X of the detection [m]
  std::span<const std::uint8_t> is_fixed;  ///< by vertex: 1 if it never moves; it then bears no plane
  float query_radius = 0;                  ///< r_q [m]
  float bounds_relaxation = 0.45f;         ///< γ_p
  /// w by vertex [m], 0 for fixed ones: divides the gap of each pair (bounds=dat); empty: gaps are halved
  std::span<const Vec3f> displacement{};
};

/// Returns the displacements that divide the gaps (method.md §5.6): `to` − `from` by vertex, rounded once to single
/// precision. In the guess loop they lead from X to the target, later from X_prev of the previous detection to X.
inline std::vector<Vec3f> displacements(std::span<const Vec3f> from, std::span<const Vec3f> to) {
  std::vector<Vec3f> all;
  all.reserve(from.size());
  for (std::size_t v = 0; v < from.size(); ++v)
    all.push_back({to[v].x - from[v].x, to[v].y - from[v].y, to[v].z - from[v].z});
  return all;
}

/// Least share of 2γ_p d of each side of a pair, if both can move, with bounds=dat. A side without room could not go
/// back until the next detection, and rounding could hide that it keeps its half-space at X.
inline constexpr double least_division = 0x1p-4;

/// Returns PlaneIn::is_fixed of a scene: 1 for each vertex of rigid group 0.
inline std::vector<std::uint8_t> fixed_flags(std::span<const Index> groups) {
  std::vector<std::uint8_t> flags;
  flags.reserve(groups.size());
  for (const Index group : groups) flags.push_back(group == 0 ? 1 : 0);
  return flags;
}

/// The answer: K_v, the region of each vertex until the next detection, is its ball and its half-spaces (method.md
/// §5.6).
struct PlaneOut {
  VertexPlanes planes;  ///< by vertex, ascending by pair
  /// Radius of each vertex's ball [m]. The largest finite number for a vertex inside a solid, which nothing bounds;
  /// arbitrary for fixed ones.
  std::vector<float> bound;
};

/// Number of planes that the method gives a vertex: those of its nearest pairs. An answer may have more.
inline constexpr std::size_t planes_of_vertex = 16;

/// Holds whether the answer keeps every pair apart, decided exactly. A pair is *separated* if one plane of it divides
/// its sides: each of its vertices that can move bears the plane and keeps it at X, and there is room between the two
/// offsets (for a fixed vertex: its position). Every other pair within r_q must be *covered*: b_v ≤ γ_p d for each of
/// its vertices that can move. Normals and offsets are free otherwise.
struct PlaneGuarantee {
  std::size_t separated = 0;  ///< pairs within r_q
  std::size_t uncovered = 0;  ///< pairs that are neither separated nor covered
  PrimitivePair worst;        ///< the first uncovered pair by kind, first and second
  std::size_t broken = 0;     ///< half-spaces that their vertex does not keep at X
  std::size_t too_large = 0;  ///< vertices of the surface with b_v > γ_p r_q
  /// Returns whether the answer keeps the guarantee.
  bool kept() const { return uncovered == 0 && broken == 0 && too_large == 0; }
};

/// Holds how far the vertices may still move. Planes exist to give back the freedom that balls take; so a pair that is
/// nearer than the 17th of each of its vertices that can move must have one (*due*), as far as single precision holds
/// it: d ≥ 2⁻¹⁸ Σ|δ|, δ the coordinates relative to the pair's first vertex, and γ_p d, (1 − 2γ_p) d ≥ 2⁻⁴⁵ of the
/// largest modulus of a coordinate. (n rounded turns by u, which moves a shadow of the pair by u Σ|δ| at most, and of a
/// gap 64 times that leaves nearly all. Heights n·x and offsets err by a few 2⁻⁵³ of the coordinates.) Rounding may
/// decide which distance is the 17th; so a pair is due only if it is nearer by `detect_below_tolerance`.
struct PlaneFreedom {
  std::size_t pairs = 0;        ///< within r_q
  std::size_t due = 0;          ///< pairs that must have a plane
  std::size_t missing = 0;      ///< pairs that are due and that no plane separates
  PrimitivePair first_missing;  ///< the first missing pair by kind, first and second
  /// Both sides of a separated pair together may come 2γ_p d closer, as with balls. This is the largest shortfall from
  /// that, in units of u · max(d, Σ|δ|).
  double narrowing = 0;
  PrimitivePair narrowest;  ///< the pair of `narrowing`
  /// With displacements: largest difference between the room of a separated pair's side, its offset minus its farthest
  /// vertex along n, and 2γ_p s d, in units of u · (max(d, Σ|δ|) + d W/(a + b)). With the answer's n,
  ///
  ///   a = max(0, largest n·w of the first side),  b = max(0, largest −n·w of the second),
  ///   s = a/(a + b) of the first side, b/(a + b) of the second, at least `least_division`; 1/2 where a = b = 0,
  ///
  /// and W = max ‖w‖ of the pair. Pairs with a side that cannot move are left out.
  double division = 0;
  PrimitivePair worst_divided;  ///< the pair of `division`
  /// By vertex: how much smaller b_v is than γ_p min(r_q, smallest d of its pairs that no plane separates), in units of
  /// u γ_p · max(d, Σ|δ|) of the pair that excuses it best; 0 for vertices that cannot move and inside solids.
  std::vector<double> ball_shortfall;
  std::size_t needless = 0;        ///< half-spaces of pairs that are not within r_q
  std::size_t bounded_inside = 0;  ///< vertices inside solids whose ball is not the largest finite number
};

/// The truth depends on the answer: planes are judged by what they hold apart, not by how they were chosen.
struct PlaneTruth {
  PlaneGuarantee guarantee;  ///< do the regions exclude every meeting?
  PlaneFreedom freedom;      ///< do they leave the vertices their freedom?
};

/// Largest narrowing in units of u · max(d, Σ|δ|), twice γ_p < 1/2 of: n rounded (1), which turns it, so that other
/// points than the closest ones face each other; its length (1); the arithmetic of the offsets and of the judge in
/// double (less than 1 together). A direction computed in single precision exceeds this.
inline constexpr double plane_narrowing_tolerance = 3;
/// Largest division in units of u · (max(d, Σ|δ|) + d W/(a + b)): the room's own error (3, as above) and that of s < 1:
/// a and b of three products in single precision are off by 4 u W, so s by 4 u W/(a + b), of 2γ_p d < d.
inline constexpr double plane_division_tolerance = 4;
/// Largest ball shortfall in units of u γ_p · max(d, Σ|δ|): a smallest distance (`detect_below_tolerance`), one
/// product, rounded down (2), in a kernel that may round to nearest and step down once more (4).
inline constexpr double plane_ball_tolerance = detect_below_tolerance + 4;

}  // namespace ogc::compare
