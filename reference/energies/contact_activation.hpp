// The contact energy g(d) over any number type: Eq. 18 with Eq. 19 corrected, and the variants of the ablation
// (method.md §4.2). T is the type of the distance. P is the type of radius and stiffness: a plain number if only the
// distance is differentiated, T if derivatives by radius and stiffness are needed, too.
#pragma once

#include "compare/problem/settings.hpp"
#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// Returns the quadratic branch k/2 (r − d)² for d ≥ τ = r/2. Below τ, returns k' (ln τ − ln d) plus the value of the
/// quadratic branch at τ; k' is `log_stiffness`.
template <class T, class P>
T two_stage_energy(const T& d, const P& r, const P& k, const P& log_stiffness) {
  using std::log;
  const P tau = P(0.5) * r, depth = r - tau;
  if (plain(d) >= plain(tau)) return P(0.5) * k * (T(r) - d) * (T(r) - d);
  return log_stiffness * (T(log(tau)) - log(d)) + T(P(0.5) * k * depth * depth);
}

/// Returns g(d) [J] for 0 < d < r, with radius r [m] and stiffness k_c [N/m]. For `ogc_as_printed`, Eq. 19 is evaluated
/// with lengths in metres.
template <class T, class P>
T activation_energy(compare::ContactActivation kind, const T& d, const P& r, const P& k) {
  using std::log;
  const P tau = P(0.5) * r;
  const T depth = T(r) - d;
  T energy(0.0);
  switch (kind) {
    case compare::ContactActivation::ogc: energy = two_stage_energy(d, r, k, tau * k * (r - tau)); break;
    case compare::ContactActivation::ogc_as_printed:
      energy = two_stage_energy(d, r, k, tau * k * (tau - r) * (tau - r));
      break;
    case compare::ContactActivation::quadratic: energy = P(0.5) * k * depth * depth; break;
    case compare::ContactActivation::ipc_log: energy = -k * depth * depth * log(P(1.0) / r * d); break;
    case compare::ContactActivation::cubic: energy = P(2.0) * k / (P(3.0) * r) * depth * depth * depth; break;
  }
  return energy;
}

/// Describes where and how g is not smooth.
struct ActivationForm {
  bool has_stages = false;  ///< g has another formula below τ = r/2
  bool jumps = false;       ///< g' jumps at τ
  bool ends_flat = false;   ///< g' and g'' are 0 at r
};
/// Returns the properties of one activation.
inline ActivationForm form_of(compare::ContactActivation kind) {
  switch (kind) {
    case compare::ContactActivation::ogc: return {.has_stages = true};
    case compare::ContactActivation::ogc_as_printed: return {.has_stages = true, .jumps = true};
    case compare::ContactActivation::quadratic: break;
    case compare::ContactActivation::ipc_log:
    case compare::ContactActivation::cubic: return {.ends_flat = true};
  }
  return {};
}

/// Returns g(d); 0 for d ≥ r.
template <class T, class P>
T contact_activation(compare::ContactActivation kind, const T& d, const P& r, const P& k) {
  return plain(d) >= r ? T(0.0) : activation_energy(kind, d, r, k);
}

}  // namespace ogc::reference
