// Contact energy over distance, over any number type: Eq. 18 with Eq. 19 corrected, and the variants of the ablation (method.md §4).
#pragma once

#include "compare/problem/settings.hpp"
#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// Quadratic stage from τ = r/2 on, below it k' (ln τ − ln d) + the quadratic value at τ.
template <class T>
T two_stage_energy(const T& d, double r, double k, double log_stiffness) {
  using std::log;
  const double tau = 0.5 * r;
  if (plain(d) >= tau) return 0.5 * k * (T(r) - d) * (T(r) - d);
  return log_stiffness * (T(std::log(tau)) - log(d)) + T(0.5 * k * (r - tau) * (r - tau));
}

/// g(d) [J] for 0 < d < r, 0 from r on: radius r [m], stiffness k_c [N/m]. `ogc_as_printed` takes Eq. 19's numbers in metres.
template <class T>
T contact_activation(compare::ContactActivation kind, const T& d, double r, double k) {
  using std::log;
  if (plain(d) >= r) return T(0.0);
  const double tau = 0.5 * r;
  const T depth = T(r) - d;
  switch (kind) {
    case compare::ContactActivation::ogc_as_printed: return two_stage_energy(d, r, k, tau * k * (tau - r) * (tau - r));
    case compare::ContactActivation::quadratic: return 0.5 * k * depth * depth;
    case compare::ContactActivation::ipc_log: return -k * depth * depth * log(1 / r * d);
    case compare::ContactActivation::cubic: return 2 * k / (3 * r) * depth * depth * depth;
    default: return two_stage_energy(d, r, k, tau * k * (r - tau));
  }
}

}  // namespace ogc::reference
