// Hinges in the sum of a vertex.
#pragma once

#include "fast/kernels/models/bending_models.hpp"
#include "fast/kernels/models/damping.hpp"
#include "fast/kernels/sweep_view.hpp"
#include "fast/kernels/team.hpp"

namespace ogc::fast {

/// A hinge seen from one of its vertices. At an end of the edge `index` is the other end, o0, o1 (with the own vertex
/// as x0); at an opposite vertex it is x0, x1, o1 (with the own vertex as o0).
struct alignas(8) HingeIncidence {
  int index[3] = {0, 0, 0};  ///< encoded
  int hinge = -1;            ///< number in RestState::hinges; ~number at an opposite vertex
  HingeStencil stencil{};    ///< c and θ₀
};

/// A hinge as the vertex at `own` sees it, with θᵗ where it is damped.
OGC_HD inline HingeSeen read_hinge(const SweepView& view, const HingeIncidence& incidence,
                                   const SurfaceMaterial& material, const Vec& own) {
  HingeSeen hinge{.stencil = incidence.stencil,
                  .isometric = {},
                  .opposite = incidence.hinge < 0,
                  .own = own,
                  .p = {view.read(incidence.index[0]), view.read(incidence.index[1]), view.read(incidence.index[2])},
                  .angle_start = 0};
  if (material.bending_damping > 0) hinge.angle_start = view.angle_start[decoded(incidence.hinge)];
  return hinge;
}

// Branches as in triangle.hpp.

/// Adds a hinge, given the functor of its model; `damping` is k_d/h.
struct AddHinge {
  /// Arguments of a bending model's `add` (models/bending_models.hpp): k_d/h [1], 0 for damping by vertex; `sum` takes
  /// force and block.
  const HingeSeen& hinge;
  float damping;
  ForceAndBlock& sum;

  template <class Model>
  OGC_HD void operator()(Model) const {
    Model::add(hinge, damping, sum);
  }
};
/// Adds what `add` of the model leaves out of the damping, likewise.
struct AddHingeDamper {
  const HingeSeen& hinge;
  float damping;
  ForceAndBlock& sum;

  template <class Model>
  OGC_HD void operator()(Model) const {
    Model::add_damper(hinge, damping, sum);
  }
};

/// A hinge of whatever model. `isometric` is read where the body bends so.
OGC_HD inline void add_any_hinge(const SweepView& view, const HingeIncidence& incidence,
                                 const IsometricStencil& isometric, const SurfaceMaterial& material,
                                 const SurfaceModels& models, const OwnVertex& own, ForceAndBlock& sum) {
  HingeSeen hinge = read_hinge(view, incidence, material, own.position);
  hinge.isometric = isometric;
  const float damping = material.bending_damping;
  const bool of_strain = damps_strain(models.damping);
  ForceAndBlock whole;
  with_bending(models.bending, AddHinge{hinge, of_strain ? damping : 0.0f, whole});
  switch (models.damping) {
    case compare::DampingForm::per_vertex: return add_damped_by_vertex(whole, damping, own.moved, sum);
    case compare::DampingForm::strain:
      sum += whole;
      return with_bending(models.bending, AddHingeDamper{hinge, damping, sum});
  }
}

/// Adds a discrete hinge with damping of strains.
struct AddDiscreteHinge {
  const SweepView& view;
  SurfaceMaterial material;
  Vec own;  ///< x of the vertex [m]

  OGC_HD void operator()(const HingeIncidence& hinge, ForceAndBlock& sum) const {
    DiscreteHinge::add(read_hinge(view, hinge, material, own), material.bending_damping, sum);
  }
};
/// A hinge with its weights, where it has any.
struct AnyHinge {
  HingeIncidence hinge;
  IsometricStencil isometric;  ///< 0 where no body bends isometrically
};
/// Hinge k of a vertex with its weights.
struct LoadAnyHinge {
  const HingeIncidence* first;        ///< of the vertex's row
  const IsometricStencil* isometric;  ///< likewise; null where no body bends isometrically

  OGC_HD AnyHinge operator()(int k) const {
    AnyHinge any{first[k], {}};
    if (isometric != nullptr) any.isometric = isometric[k];
    return any;
  }
};
/// Adds a hinge of any model with whatever damping.
struct AddAnyHinge {
  const SweepView& view;
  SurfaceMaterial material;
  SurfaceModels models;
  OwnVertex own;

  OGC_HD void operator()(const AnyHinge& any, ForceAndBlock& sum) const {
    add_any_hinge(view, any.hinge, any.isometric, material, models, own, sum);
  }
};

/// Discrete hinges with damping of strains.
struct UsualHinges {
  static constexpr unsigned gives = asks_hinges;

  OGC_HD static Part<LoadFrom<HingeIncidence>, AddDiscreteHinge> part_of(const SweepView& view, int,
                                                                         const SweepVertex& vertex,
                                                                         const OwnVertex& own) {
    return {vertex.hinge_count, {view.hinges + vertex.hinge_begin}, {view, view.materials[vertex.body], own.position}};
  }
};
/// Hinges of any model with whatever damping.
struct Hinges : UsualHinges {
  static constexpr unsigned gives = asks_hinges | asks_any_model;

  OGC_HD static Part<LoadAnyHinge, AddAnyHinge> part_of(const SweepView& view, int, const SweepVertex& vertex,
                                                        const OwnVertex& own) {
    const int begin = vertex.hinge_begin;
    return {vertex.hinge_count,
            {view.hinges + begin, view.isometric != nullptr ? view.isometric + begin : nullptr},
            {view, view.materials[vertex.body], view.models[vertex.body], own}};
  }
};

}  // namespace ogc::fast
