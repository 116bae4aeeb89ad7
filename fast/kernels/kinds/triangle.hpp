// Triangles of membranes in the sum of a vertex.
#pragma once

#include "fast/kernels/models/damping.hpp"
#include "fast/kernels/models/membrane_models.hpp"
#include "fast/kernels/sweep_view.hpp"
#include "fast/kernels/team.hpp"

namespace ogc::fast {

/// A triangle as one of its corners sees it. `index` names the other two in the triangle's order, encoded as
/// sweep_view.hpp says.
struct alignas(16) MembraneIncidence {
  int index[2] = {0, 0};      ///< x_b, x_c
  int triangle = -1;          ///< number in RestState::triangles
  MembraneStencil stencil{};  ///< gradients and area
};

/// What a triangle reads beside its incidence: the other corners, and Gᵗ where it is damped. It reads all at once: on a
/// device a vertex waits for reads, not for arithmetic.
struct MembraneReads {
  Vec b, c;                   ///< positions [m]
  Symmetric2 strain_start{};  ///< Gᵗ; 0 without damping
};

/// Reads it.
OGC_HD inline MembraneReads read_membrane(const SweepView& view, const MembraneIncidence& incidence,
                                          const SurfaceMaterial& material) {
  MembraneReads reads{view.read(incidence.index[0]), view.read(incidence.index[1])};
  if (material.membrane_damping > 0) reads.strain_start = view.strain_start[incidence.triangle];
  return reads;
}

/// Adds a triangle whose strain is damped.
OGC_HD inline void add_membrane_incidence(const MembraneIncidence& incidence, const MembraneReads& reads,
                                          const SurfaceMaterial& material, compare::MembraneModel model, const Vec& own,
                                          ForceAndBlock& sum) {
  const Vec to_b = reads.b - own, to_c = reads.c - own;
  with_membrane(model, AddDampedMembrane<float>{incidence.stencil, material, to_b, to_c, reads.strain_start, sum});
}

// Models are chosen inside of the form of damping, and what a model shares with others stands outside of its choice:
// a device contracts products and sums within a branch, so where a branch ends decides a bit.

/// Adds a triangle without damping, given the functor of its model.
struct AddElasticMembrane {
  /// Arguments of a membrane model's `add_elastic`: edges to the other corners [m]; `sum` takes force and block.
  const MembraneStencil& stencil;
  const SurfaceMaterial& material;
  Vec to_b, to_c;
  ForceAndBlock& sum;

  template <class Model>
  OGC_HD void operator()(Model) const {
    Model::add_elastic(stencil, material, to_b, to_c, sum);
  }
};

/// Adds a triangle of any model with any damping.
OGC_HD inline void add_any_membrane(const SweepView& view, const MembraneIncidence& incidence,
                                    const SurfaceMaterial& material, const SurfaceModels& models, const OwnVertex& own,
                                    ForceAndBlock& sum) {
  const MembraneReads reads = read_membrane(view, incidence, material);
  const Vec to_b = reads.b - own.position, to_c = reads.c - own.position;
  switch (models.damping) {
    case compare::DampingForm::per_vertex: {
      ForceAndBlock elastic;
      with_membrane(models.membrane, AddElasticMembrane{incidence.stencil, material, to_b, to_c, elastic});
      return add_damped_by_vertex(elastic, material.membrane_damping, own.moved, sum);
    }
    case compare::DampingForm::strain:
      return with_membrane(models.membrane,
                           AddDampedMembrane<float>{incidence.stencil, material, to_b, to_c, reads.strain_start, sum});
  }
}

/// Adds a triangle with damping of strains.
struct AddTriangle {
  const SweepView& view;
  SurfaceMaterial material;
  compare::MembraneModel model;
  Vec own;  ///< x of the vertex [m]

  OGC_HD void operator()(const MembraneIncidence& triangle, ForceAndBlock& sum) const {
    add_membrane_incidence(triangle, read_membrane(view, triangle, material), material, model, own, sum);
  }
};
/// Adds a triangle with whatever damping.
struct AddAnyTriangle {
  const SweepView& view;
  SurfaceMaterial material;
  SurfaceModels models;
  OwnVertex own;

  OGC_HD void operator()(const MembraneIncidence& triangle, ForceAndBlock& sum) const {
    add_any_membrane(view, triangle, material, models, own, sum);
  }
};

/// Triangles of any membrane, with damping of strains.
struct UsualTriangles {
  static constexpr unsigned gives = asks_triangles;

  OGC_HD static Part<LoadFrom<MembraneIncidence>, AddTriangle> part_of(const SweepView& view, int,
                                                                       const SweepVertex& vertex,
                                                                       const OwnVertex& own) {
    return {vertex.membrane_count,
            {view.membrane + vertex.membrane_begin},
            {view, view.materials[vertex.body], view.models[vertex.body].membrane, own.position}};
  }
};
/// Triangles of any membrane with whatever damping.
struct Triangles : UsualTriangles {
  static constexpr unsigned gives = asks_triangles | asks_any_model;

  OGC_HD static Part<LoadFrom<MembraneIncidence>, AddAnyTriangle> part_of(const SweepView& view, int,
                                                                          const SweepVertex& vertex,
                                                                          const OwnVertex& own) {
    return {vertex.membrane_count,
            {view.membrane + vertex.membrane_begin},
            {view, view.materials[vertex.body], view.models[vertex.body], own}};
  }
};

}  // namespace ogc::fast
