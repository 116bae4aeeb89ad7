// Fifty decimal digits: after the worst cancellation of the printed form (d close to τ, logarithms of metres) more than thirty are left.
#include "reference/geometry/activation.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

namespace ogc::reference {
namespace {

using Real = boost::multiprecision::cpp_bin_float_50;

double rounded(const Real& x) { return x.convert_to<double>(); }

ActivationValue quadratic_stage(const Real& d, const Real& r, const Real& k) {
  const Real gap = r - d;
  ActivationValue value;
  value.energy = rounded(k * gap * gap / 2);
  value.slope = rounded(-k * gap);
  value.curvature = rounded(k);
  value.energy_scale = value.energy;
  value.slope_scale = -value.slope;
  value.curvature_scale = value.curvature;
  return value;
}

ActivationValue logarithmic_stage(const Real& d, const Real& r, const Real& k) {
  const Real tau = r / 2, k_log = tau * k * (r - tau);
  const Real constant = k * (r - tau) * (r - tau) / 2, log_d = k_log * log(d), log_tau = k_log * log(tau);
  ActivationValue value;
  value.energy = rounded(-log_d + (constant + log_tau));
  value.slope = rounded(-k_log / d);
  value.curvature = rounded(k_log / (d * d));
  value.energy_scale = rounded(abs(log_d) + constant + abs(log_tau));
  value.slope_scale = -value.slope;
  value.curvature_scale = value.curvature;
  return value;
}

}  // namespace

ActivationValue activation_at(double distance, double contact_radius, double stiffness) {
  if (distance >= contact_radius) return {};
  if (2 * distance >= contact_radius) return quadratic_stage(distance, contact_radius, stiffness);
  return logarithmic_stage(distance, contact_radius, stiffness);
}

compare::ActivationTruth activation(const compare::ActivationIn& in) {
  compare::ActivationTruth truth;
  for (std::size_t i = 0; i < in.distance.size(); ++i) {
    const ActivationValue value = activation_at(in.distance[i], in.contact_radius[i], in.stiffness[i]);
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
