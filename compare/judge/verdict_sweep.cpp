// Verdict of a sweep: the bounds by the judge's own exact arithmetic, all else by the authority's truth about this
// answer.
#include <algorithm>
#include <array>
#include <cmath>

#include "compare/judge/exact_sum.hpp"
#include "compare/judge/units.hpp"
#include "compare/judge/verdict.hpp"

namespace ogc::compare {

namespace {

bool is_finite(const Vec3f& x) { return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z); }

/// Vertices that are cut, or may be, have a bound; fixed ones stay whatever it is.
bool judge_bounds(const SweepIn& in, const SweepOut& out, const std::vector<Index>& groups, Tally& tally) {
  for (std::size_t v = 0; v < in.old.size(); ++v) {
    if (in.colour[v] < 0 && groups[v] <= 0) continue;
    if (obeys_bound(out.position[v], in.previous[v], in.bound[v])) continue;
    const Vec3f &x = out.position[v], &p = in.previous[v];
    const double moved = std::hypot(double{x.x} - p.x, double{x.y} - p.y, double{x.z} - p.z);
    tally.mismatch("vertex " + std::to_string(v) +
                   text(": the stored position is %.17g from X_prev, bound %.9g", moved, in.bound[v]));
    return false;
  }
  return true;
}

/// Every vertex decides whether it is cut, and for each of its stencils on which side of that stencil's jumps it lies.
std::uint64_t decisions(const SweepIn& in) {
  constexpr std::array<std::uint64_t, 3> corners{1, 2, 3};
  std::uint64_t count = in.old.size() + 3 * in.rest->triangles.size() + 4 * in.rest->hinges.size();
  for (const VertexFacetContact& c : in.vertex_facet) count += 1 + corners[static_cast<std::size_t>(c.face.kind)];
  for (const EdgeEdgeContact& c : in.edge_edge)
    count += corners[static_cast<std::size_t>(c.first.kind)] + corners[static_cast<std::size_t>(c.second.kind)];
  return count;
}

double error_in_units(const SweepTruth& truth, const SweepOut& out, std::size_t v) {
  const Vec3f& x = out.position[v];
  const Vec3& exact = truth.position[v];
  const double error = std::hypot(x.x - exact.x, x.y - exact.y, x.z - exact.z);
  return error == 0 ? 0 : error / truth.accepted[v];
}

}  // namespace

bool can_judge_sweep(const TestCase& test, const SweepIn& in, const SweepOut& out, Tally& tally) {
  tally.begin(test.name);
  if (out.position.size() != in.old.size()) {
    tally.mismatch("the answer does not have one position for each vertex");
    return false;
  }
  if (std::all_of(out.position.begin(), out.position.end(), is_finite)) return true;
  tally.mismatch("a position is not finite");
  return false;
}

void judge_sweep(const TestCase& test, const SweepIn& in, const SweepTruth& truth, const SweepOut& out, Tally& tally) {
  tally.begin(test.name);
  const auto grey = static_cast<std::uint64_t>(std::count(truth.grey.begin(), truth.grey.end(), std::uint8_t{1}));
  tally.count(in.old.size(), decisions(in), grey);
  if (!judge_bounds(in, out, rigid_groups(*in.scene), tally)) return;
  for (std::size_t v = 0; v < in.old.size(); ++v) {
    tally.error(0, error_in_units(truth, out, v), [&] {
      const Vec3f& x = out.position[v];
      const Vec3& exact = truth.position[v];
      return "vertex " + std::to_string(v) + ", colour " + std::to_string(in.colour[v]) +
             text(": %.4g m from the exact position, %.4g accepted",
                  std::hypot(x.x - exact.x, x.y - exact.y, x.z - exact.z), truth.accepted[v]);
    });
  }
  if (out.cut < truth.cut || out.cut > truth.cut + truth.cut_doubtful)
    tally.mismatch("cut: " + std::to_string(out.cut) + ", exact " + std::to_string(truth.cut) + " and " +
                   std::to_string(truth.cut_doubtful) + " in doubt");
}

}  // namespace ogc::compare
