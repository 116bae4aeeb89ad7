// Selects a bending model. The `switch` has no `default`, so a new model does not compile until it is added here.
#pragma once

#include "fast/kernels/models/discrete_hinge.hpp"
#include "fast/kernels/models/isometric_quadratic.hpp"

namespace ogc::fast {

/// Implements BendingModel::none, whose hinges have no energy. Rest states omit them.
struct NoBending {
  /// There is nothing to add, so UsualHinges may be used, and no HingeWeights are needed.
  static constexpr bool is_default = true, reads_weights = false;
  OGC_HD static void add(const HingeSeen&, float, ForceAndBlock&) {}
  OGC_HD static void add_damper(const HingeSeen&, float, ForceAndBlock&) {}
  OGC_HD static double energy(const HingeRest&, const HingeWeights&, const Vec*) { return 0; }
};

/// Returns use(functor of the model).
template <class Use>
OGC_HD auto with_bending(compare::BendingModel model, const Use& use) {
  switch (model) {
    case compare::BendingModel::none: return use(NoBending{});
    case compare::BendingModel::discrete_hinge: return use(DiscreteHinge{});
    case compare::BendingModel::isometric_quadratic: return use(IsometricQuadratic{});
  }
  __builtin_unreachable();
}

/// Returns whether UsualHinges computes the body's bending and damping.
OGC_HD inline bool has_default_bending(const SurfaceModels& models) {
  const auto is_default = [](auto model) { return decltype(model)::is_default; };
  return damps_strain(models.damping) && with_bending(models.bending, is_default);
}

/// Returns whether the model needs HingeWeights.
OGC_HD inline bool reads_weights(compare::BendingModel model) {
  return with_bending(model, [](auto functor) { return decltype(functor)::reads_weights; });
}

}  // namespace ogc::fast
