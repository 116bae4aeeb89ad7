// Every membrane model by its name. A `switch` without `default`: a new model does not compile until it stands here.
#pragma once

#include "fast/kernels/models/st_venant_kirchhoff.hpp"
#include "fast/kernels/models/stable_neo_hookean.hpp"

namespace ogc::fast {

/// MembraneModel::none: triangles without energy, which no rest state holds.
struct NoMembrane {
  /// There is no stencil to add, so GatherDefault serves.
  static constexpr bool is_default = true;
  OGC_HD static void add(const MembraneStencil&, const SurfaceMaterial&, const Vec&, const Vec&, const Symmetric2&,
                         ForceAndBlock&) {}
  OGC_HD static void add_elastic(const MembraneStencil&, const SurfaceMaterial&, const Vec&, const Vec&,
                                 ForceAndBlock&) {}
  OGC_HD static double energy(const TriangleRest&, const SurfaceMaterial&, const Vec&, const Vec&) { return 0; }
};

/// use(functor of the model).
template <class Use>
OGC_HD auto with_membrane(compare::MembraneModel model, const Use& use) {
  switch (model) {
    case compare::MembraneModel::none: return use(NoMembrane{});
    case compare::MembraneModel::st_venant_kirchhoff: return use(StVenantKirchhoff{});
    case compare::MembraneModel::stable_neo_hookean: return use(StableNeoHookean{});
  }
  __builtin_unreachable();
}

/// Whether GatherDefault has this membrane and its damping.
OGC_HD inline bool has_default_membrane(const SurfaceModels& models) {
  const auto is_default = [](auto model) { return decltype(model)::is_default; };
  return models.damping == compare::DampingForm::strain && with_membrane(models.membrane, is_default);
}

}  // namespace ogc::fast
