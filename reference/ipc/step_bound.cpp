#include "reference/ipc/step_bound.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "reference/ipc/additive_ccd.hpp"

namespace ogc::reference {
namespace {

struct First {
  double share;
  std::size_t pair;
};

First earlier(const First& a, const First& b) {
  return b.share < a.share || (b.share == a.share && b.pair < a.pair) ? b : a;
}

}  // namespace

/// Splits the pairs into the same ranges for any number of threads, so that the lowest pair always wins a tie.
StepBound step_bound(const PairMesh& mesh, const std::vector<PrimitivePair>& pairs, const State& x,
                     const State& direction, double thickness, double until) {
  const First none{until, pairs.size()};
  const First first = tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, pairs.size(), 128), none,
      [&](const tbb::blocked_range<std::size_t>& range, First best) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const auto vertex = vertices_of(mesh.topology, pairs[i]);
          const double share = additive_ccd(pairs[i].sides, corners_of(vertex, x), corners_of(vertex, direction),
                                            thickness, best.share);
          if (share < best.share) best = {share, i};
        }
        return best;
      },
      earlier);
  StepBound bound{first.share, {}};
  if (first.pair < pairs.size()) bound.pair = pairs[first.pair];
  return bound;
}

double largest_motion(const State& direction) {
  double squared = 0;
  for (const Triple<double>& p : direction) squared = std::max(squared, dot(p, p));
  return std::sqrt(squared);
}

}  // namespace ogc::reference
