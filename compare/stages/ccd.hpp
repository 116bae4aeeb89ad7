// Stage ccd: the time of impact of a vertex and a triangle, or of two edges, whose vertices move straight, as line
// searches of IPC solvers and any continuous detection need it. Plug-ins may answer it; the fast path lacks it.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// Kinds of faces that may meet.
enum class CcdKind : std::uint8_t { vertex_triangle, edge_edge };

/// A vertex 0 and a triangle 1 2 3, or edges 0 1 and 2 3. Vertex k is at from + t (to − from) at time t in [0, 1],
/// without any rounding. Any coordinates are legal: faces may be collapsed, touch, or lie in one plane.
struct CcdCase {
  CcdKind kind = CcdKind::vertex_triangle;  ///< kind of the faces
  std::array<Vec3f, 4> from{}, to{};        ///< [m]
};

/// The question: independent cases.
struct CcdIn {
  std::vector<CcdCase> cases;  ///< independent of each other
};

/// The answer: a time t in [0, 1] such that the closed faces share no point at any time before t; 1 where no limit is
/// needed. 0 where they touch at the start.
struct CcdOut {
  std::vector<float> time;  ///< share of the motion
};

/// The limits of a right answer.
struct CcdTruth {
  /// the largest double that is not above the first time at which the faces share a point, exactly; infinite if they
  /// never do
  std::vector<double> impact;
  /// a time until which the faces are farther apart than ccd_gap_left of their distance at the start, plus
  /// ccd_resolution · u S, as far as ccd_fewest_steps of conservative advancement show
  std::vector<double> early;
};

/// An answer is never above `impact`, and never below `early` by more than the share below. The published additive CCD
/// (Li et al. 2021, Algorithm 1) satisfies this: with d₀ the distance at the start, e ≤ ccd_resolution u S/4 the
/// rounding error of a distance and ℓ a speed that no distance changes faster than, it takes a first step of 0.9 (d₀ −
/// e)/ℓ, where d₀ − e ≥ 0.72 d₀ unless `early` is 0, and returns a t from which another step of 0.9 d(t)/ℓ ends beyond
/// `early`. Since d(t) ≤ d₀ + ℓ t and d₀/ℓ ≤ t/0.65, early ≤ t + 0.9 (t + t/0.65) < 3.3 t.
inline constexpr double ccd_early_share = 0.75;
/// Share of the first distance below which advancement may stop.
inline constexpr double ccd_gap_left = 0.1;
/// A contestant may give up after this many steps: faces that turn and are a million times as large as their gap take
/// more.
inline constexpr int ccd_fewest_steps = 1000;
/// A distance of this times u S need not be told from 0 by any contestant; S is the largest coordinate relative to
/// vertex 0 at the start plus the largest displacement relative to the mean one. The grey zone has the same factor
/// (compare/stages/numbers.hpp).
inline constexpr double ccd_resolution = 16;

}  // namespace ogc::compare
