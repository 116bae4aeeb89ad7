#include "reference/solvers/newton/line_search.hpp"

#include <cmath>

namespace ogc::reference {
namespace {

constexpr int most_halvings = 20;

State moved(const State& x, double share, const State& delta) {
  State to = x;
  for (std::size_t v = 0; v < x.size(); ++v) to[v] = x[v] + share * delta[v];
  return to;
}

}  // namespace

double value_noise(const PotentialTerms& terms) {
  double sum = 0;
  for (const double e : terms.stencil) sum += std::abs(e);
  for (const double e : terms.inertia) sum += e;
  return 0x1p-52 * sum;
}

Accepted backtracked(const Potential& potential, const State& x, const State& delta, double share,
                     const PotentialTerms& before, double noise) {
  const double full = share;
  for (int halving = 0; halving <= most_halvings && share > 0; ++halving, share *= 0.5) {
    State trial = moved(x, share, delta);
    const double change = Potential::change(before, potential.terms(trial));
    if (change < 0 || (share == full && change <= noise)) return {std::move(trial), share, change};
  }
  return {};
}

}  // namespace ogc::reference
