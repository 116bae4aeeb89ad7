// Computes the activation with fifty decimal digits. The printed form of Eq. 18 and 20 loses fewer than twenty of them
// by cancellation, even if d is close to τ and all lengths are in metres.
#include "reference/energies/activation.hpp"

#include <algorithm>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "reference/energies/contact_activation.hpp"

namespace ogc::reference {
namespace {

using compare::ContactActivation;

/// A multiprecision number with the operations that energies and their derivatives need.
struct Precise {
  boost::multiprecision::cpp_bin_float_50 value;
  Precise(double x = 0) : value(x) {}
  friend Precise operator+(Precise a, const Precise& b) { return a.value += b.value, a; }
  friend Precise operator-(Precise a, const Precise& b) { return a.value -= b.value, a; }
  friend Precise operator*(Precise a, const Precise& b) { return a.value *= b.value, a; }
  friend Precise operator/(Precise a, const Precise& b) { return a.value /= b.value, a; }
  friend Precise operator-(Precise a) { return a.value = -a.value, a; }
  friend Precise log(Precise a) { return a.value = log(a.value), a; }
  friend double plain(const Precise& a) { return a.value.convert_to<double>(); }
};

/// Returns the sum of the moduli of the terms of the two-stage energy, as printed in Eq. 18 and 20.
double printed_terms(bool as_printed, const Precise& d, const Precise& r, const Precise& k) {
  const Precise tau = 0.5 * r, depth = r - tau, k_log = tau * k * (as_printed ? depth * depth : depth);
  return std::abs(plain(k_log * log(d))) + plain(0.5 * k * depth * depth) + std::abs(plain(k_log * log(tau)));
}

}  // namespace

ActivationValue activation_at(ContactActivation kind, double distance, double contact_radius, double stiffness) {
  if (distance >= contact_radius) return {};
  using Once = Derivative<Precise, 1>;
  using Twice = Derivative<Once, 1>;
  const Twice g = activation_energy(kind, Twice(Once(Precise(distance), 0), 0), Twice(Once(Precise(contact_radius))),
                                    Twice(Once(Precise(stiffness))));
  ActivationValue value{plain(g.value.value), plain(g.value.slope[0]), plain(g.slope[0].slope[0])};
  const bool logarithmic = form_of(kind).has_stages && 2 * distance < contact_radius;
  const double terms = logarithmic ? printed_terms(kind == ContactActivation::ogc_as_printed, distance, contact_radius,
                                                   stiffness)
                                   : value.energy;
  constexpr double least = 0x1p-102;
  value.energy_scale = std::max(terms, least);
  value.slope_scale = std::max(-value.slope, least);
  value.curvature_scale = std::max(value.curvature, least);
  return value;
}

compare::ActivationTruth activation(const compare::ActivationIn& in) {
  compare::ActivationTruth truth;
  for (std::size_t i = 0; i < in.distance.size(); ++i) {
    const ActivationValue value = activation_at(in.activation[i], in.distance[i], in.contact_radius[i],
                                                in.stiffness[i]);
    truth.energy.push_back(value.energy);
    truth.slope.push_back(value.slope);
    truth.curvature.push_back(value.curvature);
    truth.energy_scale.push_back(value.energy_scale);
    truth.slope_scale.push_back(value.slope_scale);
    truth.curvature_scale.push_back(value.curvature_scale);
  }
  return truth;
}

}  // namespace ogc::reference
