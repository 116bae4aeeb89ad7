// Stage plane: the region of each vertex until the next detection if bounds are planes (method.md §5.6). The region is
// the intersection of half-spaces for near pairs and a ball for all pairs without a half-space.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/detect.hpp"
#include "compare/stages/truncate.hpp"
#include "compare/stages/vertex_planes.hpp"

namespace ogc::compare {

/// Returns these planes of one vertex as input of stage truncate; empty if `planes` is empty. H is `inertia_block`. If
/// `is_prescribed`, the vertex does not slide. With bounds=dat (planes of *Divide and Truncate*) no vertex slides, and
/// `current` is X_prev.
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

/// Input of the stage: a state, its excluded pairs, r_q and γ_p.
struct PlaneIn {
  const Topology* topology = nullptr;      ///< of the whole scene
  ExclusionView exclusions;                ///< excluded pairs
  std::span<const Vec3f> positions;        ///< X of the detection [m]
  std::span<const std::uint8_t> is_fixed;  ///< by vertex: 1 if it never moves, so that it has no plane
  float query_radius = 0;                  ///< r_q [m]
  float bounds_relaxation = 0.45f;         ///< γ_p
  /// w by vertex [m], 0 for fixed vertices; it divides the gap of each pair (bounds=dat). If empty, gaps are halved
  std::span<const Vec3f> displacement{};
};

/// Returns the displacements that divide the gaps (method.md §5.6): `to` − `from` by vertex, rounded once to single
/// precision. In the guess loop they lead from X, the positions of the detection, to the target. After the guess loop
/// they lead from the previous detection's X_prev to X.
inline std::vector<Vec3f> displacements(std::span<const Vec3f> from, std::span<const Vec3f> to) {
  std::vector<Vec3f> all;
  all.reserve(from.size());
  for (std::size_t v = 0; v < from.size(); ++v)
    all.push_back({to[v].x - from[v].x, to[v].y - from[v].y, to[v].z - from[v].z});
  return all;
}

/// Least share of 2γ_p d that each side of a pair gets with bounds=dat, if both sides can move. A side with a share of
/// 0 could not move back until the next detection, and rounding could put it outside of its half-space at X.
inline constexpr double least_division = 0x1p-4;

/// Returns PlaneIn::is_fixed of a scene: 1 for each vertex of rigid group 0.
inline std::vector<std::uint8_t> fixed_flags(std::span<const Index> groups) {
  std::vector<std::uint8_t> flags;
  flags.reserve(groups.size());
  for (const Index group : groups) flags.push_back(group == 0 ? 1 : 0);
  return flags;
}

/// The answer: the ball and the half-spaces of each vertex, whose intersection is its region K_v until the next
/// detection (method.md §5.6).
struct PlaneOut {
  VertexPlanes planes;  ///< by vertex, ascending by pair
  /// Radius of each vertex's ball [m]. The largest finite number for a vertex inside a solid, which needs no bound;
  /// arbitrary for fixed vertices.
  std::vector<float> bound;
};

/// Number of planes that the method gives a vertex: those of its nearest pairs. An answer may contain more.
inline constexpr std::size_t planes_of_vertex = 16;

/// Counts exactly where the answer fails to keep pairs apart. A pair is *separated* if one of its planes lies between
/// its sides. That means that each movable vertex of the pair has the plane and is on its own side of the plane at X,
/// and that the two offsets leave a gap. A fixed vertex has no offset; its height n·x counts instead. Every other pair
/// within r_q must be *covered*: b_v ≤ γ_p d for each of its movable vertices. Nothing else is required of normals and
/// offsets.
struct PlaneGuarantee {
  std::size_t separated = 0;  ///< separated pairs within r_q
  std::size_t uncovered = 0;  ///< pairs that are neither separated nor covered
  PrimitivePair worst;        ///< the first uncovered pair by kind, first and second
  std::size_t broken = 0;     ///< half-spaces that do not contain their vertex at X
  std::size_t too_large = 0;  ///< vertices of the surface with b_v > γ_p r_q
  /// Returns whether the answer keeps the guarantee.
  bool kept() const { return uncovered == 0 && broken == 0 && too_large == 0; }
};

/// Measures how far the vertices may still move, since planes should leave vertices more freedom than balls do. A pair
/// must have a plane (it is *due*) if both conditions hold:
///
/// - For each movable vertex of the pair, the pair is nearer than the 17th nearest pair of this vertex by more than
///   `detect_below_tolerance`, since rounding may decide which pair is the 17th.
/// - Single precision can represent the pair's plane: d ≥ 2⁻¹⁸ Σ|δ|, and γ_p d and (1 − 2γ_p) d are at least 2⁻⁴⁵ of
///   the largest modulus of a coordinate. δ are the coordinates relative to the pair's first vertex.
///
/// Rounding rotates n by u = 2⁻²⁴, which changes the pair's projection on n by at most u Σ|δ| ≤ d/64. Heights n·x and
/// offsets err by a few 2⁻⁵³ of the coordinates.
struct PlaneFreedom {
  std::size_t pairs = 0;        ///< pairs within r_q
  std::size_t due = 0;          ///< pairs that must have a plane
  std::size_t missing = 0;      ///< due pairs that no plane separates
  PrimitivePair first_missing;  ///< the first missing pair by kind, first and second
  /// Balls allow the two sides of a pair to approach each other by 2γ_p d in all. The half-spaces of a separated pair
  /// may allow less. `narrowing` is the largest difference, in units of u · max(d, Σ|δ|).
  double narrowing = 0;
  PrimitivePair narrowest;  ///< the pair of `narrowing`
  /// Only with displacements. The room of a side is the side's offset minus the height n·x of its farthest vertex. It
  /// should be 2γ_p s d, where s is the side's share. `division` is the largest deviation for a separated pair, in
  /// units of u · (max(d, Σ|δ|) + d W/(a + b)). With the answer's n,
  ///
  ///   a = max(0, largest n·w of the first side),  b = max(0, largest −n·w of the second),
  ///   s = a/(a + b) of the first side, b/(a + b) of the second, at least `least_division`; 1/2 if a = b = 0,
  ///
  /// and W is the largest ‖w‖ of the pair's vertices. Two kinds of pairs are not measured: pairs with an immovable
  /// side, and pairs for which rounding may decide whether the sides approach.
  double division = 0;
  PrimitivePair worst_divided;  ///< the pair of `division`
  /// By vertex: how much b_v is too small, in units of u γ_p max(d, Σ|δ|). This is the smallest γ_p d − b_v, in its
  /// units, of the vertex's unseparated pairs and of d = r_q; at least 0, and 0 for immovable vertices and inside
  /// solids.
  std::vector<double> ball_shortfall;
  std::size_t needless = 0;        ///< half-spaces of pairs that are not within r_q
  std::size_t bounded_inside = 0;  ///< vertices inside solids whose ball is not the largest finite number
};

/// The truth depends on the answer: planes are judged by the pairs that they separate, not by how they were chosen.
struct PlaneTruth {
  PlaneGuarantee guarantee;  ///< whether the regions keep all faces apart
  PlaneFreedom freedom;      ///< whether they leave the vertices their freedom
};

/// Largest `narrowing`, in units of u · max(d, Σ|δ|): the sum of three errors, each at most 1, times 2γ_p < 1. The
/// first is the rounding of n's direction, which changes the pair's projection on n by at most u Σ|δ|. The second is
/// the error of n's length. The third comes from the offsets and from the judge's arithmetic in double. A kernel that
/// computes n's direction in single precision exceeds this limit.
inline constexpr double plane_narrowing_tolerance = 3;
/// Largest `division`, in units of u · (max(d, Σ|δ|) + d W/(a + b)): the larger of two numbers, because each belongs to
/// one term of the unit. The whole room errs by 3 u max(d, Σ|δ|) (plane_narrowing_tolerance). s errs by 5 u W/(a + b)
/// if a kernel computes it in single precision: a and b are sums of three products, each within 3 u W; their sum and
/// the quotient round s ≤ W/(a + b) twice more. s is multiplied by 2γ_p d < d.
inline constexpr double plane_division_tolerance = 5;
/// Largest `ball_shortfall`, in units of u γ_p · max(d, Σ|δ|): the error of a smallest distance
/// (`detect_below_tolerance`), of a product rounded down (2), and of a kernel that rounds to nearest and then steps
/// down once more (2).
inline constexpr double plane_ball_tolerance = detect_below_tolerance + 4;

}  // namespace ogc::compare
