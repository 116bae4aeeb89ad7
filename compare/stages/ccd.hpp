// Stage ccd: the time of impact of a vertex and a triangle, or of two edges, whose vertices move along straight lines.
// Line searches of IPC solvers and continuous detections need it. Plug-ins may implement it; the fast path does not.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/problem/vector.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare {

/// Kinds of pairs of faces.
enum class CcdKind : std::uint8_t { vertex_triangle, edge_edge };

/// Vertex 0 and triangle 1 2 3, or edges 0 1 and 2 3. At time t in [0, 1] vertex k is at from + t (to − from), without
/// rounding. All coordinates are legal: faces may be collapsed, touch, or lie in one plane.
struct CcdCase {
  CcdKind kind = CcdKind::vertex_triangle;  ///< kind of the faces
  std::array<Vec3f, 4> from{}, to{};        ///< [m]
};

/// Input of the stage.
struct CcdIn {
  std::vector<CcdCase> cases;  ///< independent of each other
};

/// The answer: a time t in [0, 1] before which the closed faces share no point; 1 if they never meet, 0 if they touch
/// at the start.
struct CcdOut {
  std::vector<float> time;  ///< share of the motion
};

/// The right answers: times up to `impact` that are not much earlier than `early`.
struct CcdTruth {
  /// the largest double that is not above the exact first time at which the faces share a point; infinite if they never
  /// share one
  std::vector<double> impact;
  /// a time until which the distance of the faces stays above ccd_gap_left · d₀ + ccd_resolution · u S. d₀ is the
  /// distance at the start; ccd_resolution defines S. Conservative advancement of at most ccd_fewest_steps steps
  /// reaches this time
  std::vector<double> early;
};

/// Largest (`early` − t)/`early` of a right answer t; no answer may be above `impact`. The published additive CCD (Li
/// et al. 2021, Algorithm 1) satisfies this. Let d₀ be the distance at the start, e ≤ ccd_resolution u S/4 the rounding
/// error of a distance, and ℓ a bound on the rate of change of distances.
///
/// - The algorithm's first step is 0.9 (d₀ − e)/ℓ, where d₀ − e ≥ 0.72 d₀ unless `early` is 0. So d₀/ℓ ≤ t/0.65.
/// - At the returned time t another step of 0.9 d(t)/ℓ would end beyond `early`, and d(t) ≤ d₀ + ℓ t.
/// - So early ≤ t + 0.9 (t + t/0.65) < 3.3 t, and (early − t)/early < 0.7.
inline constexpr double ccd_early_share = 0.75;
/// Share of the distance at the start below which a contestant may stop its advancement.
inline constexpr double ccd_gap_left = 0.1;
/// Number of steps of its advancement after which a contestant may stop. Only rotating faces that are a million times
/// as large as their gap need more.
inline constexpr int ccd_fewest_steps = 1000;
/// A contestant may treat distances below ccd_resolution · u S as 0, u = 2⁻²⁴. S is the largest coordinate relative to
/// vertex 0 at the start plus the largest displacement relative to the mean displacement. The grey zone has the same
/// factor (compare/stages/numbers.hpp).
inline constexpr double ccd_resolution = 16;

}  // namespace ogc::compare
