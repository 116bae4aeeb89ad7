// Selects a membrane model. The `switch` has no `default`, so a new model does not compile until it is added here.
#pragma once

#include "fast/kernels/models/st_venant_kirchhoff.hpp"
#include "fast/kernels/models/stable_neo_hookean.hpp"

namespace ogc::fast {

/// Implements MembraneModel::none, whose triangles have no energy. Rest states omit them.
struct NoMembrane {
  template <class T>
  OGC_HD static void add(const MembraneStencilOf<T>&, const SurfaceMaterial&, const Vector<T>&, const Vector<T>&,
                         const Symmetric2Of<T>&, ForceAndBlockOf<T>&) {}
  OGC_HD static void add_elastic(const MembraneStencil&, const SurfaceMaterial&, const Vec&, const Vec&,
                                 ForceAndBlock&) {}
  OGC_HD static double energy(const TriangleRest&, const SurfaceMaterial&, const Vec&, const Vec&) { return 0; }
};

/// Returns use(functor of the model).
template <class Use>
OGC_HD auto with_membrane(compare::MembraneModel model, const Use& use) {
  switch (model) {
    case compare::MembraneModel::none: return use(NoMembrane{});
    case compare::MembraneModel::st_venant_kirchhoff: return use(StVenantKirchhoff{});
    case compare::MembraneModel::stable_neo_hookean: return use(StableNeoHookean{});
  }
  __builtin_unreachable();
}

/// Adds a triangle with damping of strains; the argument is the functor of the membrane model.
template <class T>
struct AddDampedMembrane {
  /// Arguments of the model's `add`.
  const MembraneStencilOf<T>& stencil;
  const SurfaceMaterial& material;
  const Vector<T>&to_b, &to_c;
  const Symmetric2Of<T>& strain_start;
  ForceAndBlockOf<T>& sum;

  template <class Model>
  OGC_HD void operator()(Model) const {
    Model::add(stencil, material, to_b, to_c, strain_start, sum);
  }
};

/// Returns whether UsualTriangles computes the body's membrane. It computes any model with damping of strains.
OGC_HD inline bool has_default_membrane(const SurfaceModels& models) { return damps_strain(models.damping); }

}  // namespace ogc::fast
