// Defines the activations g(d), one functor each (method.md §4.2). The default has two stages, Eq. 18 and Eq. 20. Its
// stiffness k'_c is τ k_c (r − τ) instead of the printed Eq. 19; for τ = r/2 this is k_c r²/4 (method.md §1.1). The
// other activations are variants for the ablation.
#pragma once

#include <cmath>

#include "compare/problem/settings.hpp"
#include "fast/kernels/arithmetic/logarithm.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/scalar.hpp"

namespace ogc::fast {

using compare::ContactActivation;

/// Holds g' [N] and g'' [N/m] at a distance. They are computed without library functions, because positions depend on
/// them.
template <class T>
struct ActivationSlopeOf {
  T slope{}, curvature{};
};
using ActivationSlope = ActivationSlopeOf<float>;

/// Extends formulas for 0 < d < r to all distances d > 0: g and its derivatives are 0 for d ≥ r. Distance d and radius
/// r are in m, stiffness k = k_c in N/m.
template <class Formulas>
struct ActivationOf {
  /// Returns g' and g''.
  OGC_HD static ActivationSlope slope(float d, float r, float k) {
    return d < r ? Formulas::slope_within(d, r, k) : ActivationSlope{};
  }
  /// Returns g [J].
  OGC_HD static float energy(float d, float r, float k) { return d < r ? Formulas::energy_within(d, r, k) : 0.0F; }
};

/// Computes an activation that is quadratic for d ≥ τ = r/2 and logarithmic below, with the stiffness k'_c from
/// `Stage`. The constant b of Eq. 20 is included: for d < τ, g = k'_c (log τ − log d) + k_c/2 (r − τ)².
template <class Stage>
struct TwoStages : ActivationOf<TwoStages<Stage>> {
  /// Returns g' and g'' for 0 < d ≤ r.
  template <class T>
  OGC_HD static ActivationSlopeOf<T> slope_within(const T& d, float r, const T& k) {
    const Mask<T> is_logarithmic = d < T(0.5F * r);
    if (is_false(is_logarithmic)) return {-k * (r - d), k};
    const T slope = Stage::logarithmic_stiffness(r, k) / d;
    return {select(is_logarithmic, -slope, -k * (r - d)), select(is_logarithmic, slope / d, k)};
  }
  /// Returns g for 0 < d < r.
  OGC_HD static float energy_within(float d, float r, float k) {
    if (d >= 0.5F * r) {
      const float depth = r - d;
      return 0.5F * k * depth * depth;
    }
    return Stage::logarithmic_stiffness(r, k) * log_ratio(0.5F * r, d) + 0.125F * k * r * r;
  }
};

/// Computes ContactActivation::ogc, the default.
struct OgcActivation : TwoStages<OgcActivation> {
  /// Returns k'_c [J].
  template <class T>
  OGC_HD static T logarithmic_stiffness(float r, const T& k) {
    return 0.25F * k * r * r;
  }
};

/// Computes ContactActivation::ogc_as_printed, with k'_c of Eq. 19 as printed, k_c r³/8.
struct OgcAsPrinted : TwoStages<OgcAsPrinted> {
  /// Returns k'_c of Eq. 19 as printed, in J m instead of J (method.md §1.1).
  OGC_HD static float logarithmic_stiffness(float r, float k) {
    const float stiffness = 0.25F * k * r * r;
    return 0.5F * r * stiffness;
  }
};

/// Computes ContactActivation::quadratic: k_c/2 (r − d)².
struct QuadraticActivation : ActivationOf<QuadraticActivation> {
  /// Returns g' = −k_c (r − d) and g'' = k_c; energy_within returns g.
  OGC_HD static ActivationSlope slope_within(float d, float r, float k) { return {-k * (r - d), k}; }
  OGC_HD static float energy_within(float d, float r, float k) {
    const float depth = r - d;
    return 0.5F * k * depth * depth;
  }
};

/// Computes ContactActivation::ipc_log: k_c (r − d)² log(r/d).
struct IpcLogActivation : ActivationOf<IpcLogActivation> {
  /// Returns, with s = (r − d)/d, g' = −k_c (r − d) (2 ln(r/d) + s) and g'' = k_c (2 ln(r/d) + s (4 + s));
  /// energy_within returns g.
  OGC_HD static ActivationSlope slope_within(float d, float r, float k) {
    const float depth = r - d, share = depth / d, log = 2.0F * log_ratio(r, d);
    return {-k * (depth * (log + share)), k * (log + share * (4.0F + share))};
  }
  OGC_HD static float energy_within(float d, float r, float k) {
    const float depth = r - d;
    return k * depth * depth * log_ratio(r, d);
  }
};

/// Computes ContactActivation::cubic: 2 k_c/(3 r) (r − d)³.
struct CubicActivation : ActivationOf<CubicActivation> {
  /// Returns g' = −2 k_c/r (r − d)² and g'' = 4 k_c/r (r − d); energy_within returns g.
  OGC_HD static ActivationSlope slope_within(float d, float r, float k) {
    const float depth = r - d, slope = 2.0F * k / r * depth;
    return {-slope * depth, 2.0F * slope};
  }
  OGC_HD static float energy_within(float d, float r, float k) {
    const float depth = r - d;
    return 2.0F * k / (3.0F * r) * depth * depth * depth;
  }
};

/// Returns use(functor of the activation). The `switch` has no `default`, so a new activation does not compile until it
/// is added here.
template <class Use>
OGC_HD auto with_activation(ContactActivation activation, const Use& use) {
  switch (activation) {
    case ContactActivation::ogc: return use(OgcActivation{});
    case ContactActivation::ogc_as_printed: return use(OgcAsPrinted{});
    case ContactActivation::quadratic: return use(QuadraticActivation{});
    case ContactActivation::ipc_log: return use(IpcLogActivation{});
    case ContactActivation::cubic: return use(CubicActivation{});
  }
  __builtin_unreachable();
}

/// An activation that is chosen at run time.
struct AnyActivation {
  ContactActivation activation = ContactActivation::ogc;

  /// Returns g' and g''; 0 for d ≥ r.
  OGC_HD ActivationSlope slope(float d, float r, float k) const {
    return d < r ? slope_within(d, r, k) : ActivationSlope{};
  }
  /// Returns g' and g'' for 0 < d ≤ r. At d = r they are the limits from below. The block of a contact with d > r uses
  /// this g'' (contact_force.hpp).
  OGC_HD ActivationSlope slope_within(float d, float r, float k) const {
    return with_activation(activation, SlopeWithin{d, r, k});
  }
  /// Returns g [J]; 0 for d ≥ r.
  OGC_HD float energy(float d, float r, float k) const { return with_activation(activation, EnergyAt{d, r, k}); }

 private:
  struct SlopeWithin {
    float d, r, k;
    template <class Activation>
    OGC_HD ActivationSlope operator()(Activation) const {
      return Activation::slope_within(d, r, k);
    }
  };
  struct EnergyAt {
    float d, r, k;
    template <class Activation>
    OGC_HD float operator()(Activation) const {
      return Activation::energy(d, r, k);
    }
  };
};

}  // namespace ogc::fast
