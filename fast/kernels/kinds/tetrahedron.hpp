// Tetrahedra in the sum of a vertex.
#pragma once

#include "fast/kernels/models/damping.hpp"
#include "fast/kernels/models/tetrahedron.hpp"
#include "fast/kernels/sweep_view.hpp"
#include "fast/kernels/team.hpp"

namespace ogc::fast {

/// A tetrahedron as one of its corners sees it. `index` names the other three in the order in which they make a
/// positive volume at rest, encoded as sweep_view.hpp says.
struct alignas(16) TetrahedronIncidence {
  int index[3] = {0, 0, 0};      ///< a, b, c of models/tetrahedron.hpp
  int tetrahedron = -1;          ///< number in RestState::tetrahedra
  TetrahedronStencil stencil{};  ///< w and i
};

/// The tetrahedra of a vertex in their stream.
struct TetrahedronRow {
  int begin = 0, count = 0;  ///< first place in SweepView::tetrahedra, and how many
};

/// What a tetrahedron of a vertex reads beside its incidence: place in the stream, for the damping.
struct LoadedTetrahedron {
  TetrahedronIncidence incidence;
  int place;  ///< where view.gradients has what the damping needs
};

/// The elastic part alone, or with damping of strain.
OGC_HD inline void add_tetrahedron_incidence(const SweepView& view, const LoadedTetrahedron& loaded,
                                             const SolidMaterial& material, const Vec& own, ForceAndBlock& sum) {
  const TetrahedronIncidence& seen = loaded.incidence;
  const Vec a = view.read(seen.index[0]) - own, b = view.read(seen.index[1]) - own, c = view.read(seen.index[2]) - own;
  add_tetrahedron(seen.stencil, material, a, b, c, sum);
  if (material.damping > 0)
    add_solid_damping(view.gradients[loaded.place], material, a, b, c, view.solid_start[seen.tetrahedron], sum);
}

/// A tetrahedron with whatever damping.
OGC_HD inline void add_any_tetrahedron(const SweepView& view, const LoadedTetrahedron& loaded, SolidMaterial material,
                                       const SurfaceModels& models, const OwnVertex& own, ForceAndBlock& sum) {
  switch (models.damping) {
    case compare::DampingForm::strain: return add_tetrahedron_incidence(view, loaded, material, own.position, sum);
    case compare::DampingForm::per_vertex: {
      const float damping = material.damping;
      material.damping = 0;
      ForceAndBlock elastic;
      add_tetrahedron_incidence(view, loaded, material, own.position, elastic);
      return add_damped_by_vertex(elastic, damping, own.moved, sum);
    }
  }
}

/// Tetrahedron k of a vertex.
struct LoadTetrahedron {
  const TetrahedronIncidence* first;  ///< of the vertex's row
  int begin;                          ///< its place in the stream

  OGC_HD LoadedTetrahedron operator()(int k) const { return {first[k], begin + k}; }
};
/// Adds a tetrahedron with damping of strains.
struct AddTetrahedron {
  const SweepView& view;
  SolidMaterial material;
  Vec own;  ///< x of the vertex [m]

  OGC_HD void operator()(const LoadedTetrahedron& tetrahedron, ForceAndBlock& sum) const {
    add_tetrahedron_incidence(view, tetrahedron, material, own, sum);
  }
};
/// Adds a tetrahedron with whatever damping.
struct AddAnyTetrahedron {
  const SweepView& view;
  SolidMaterial material;
  SurfaceModels models;
  OwnVertex own;

  OGC_HD void operator()(const LoadedTetrahedron& tetrahedron, ForceAndBlock& sum) const {
    add_any_tetrahedron(view, tetrahedron, material, models, own, sum);
  }
};

/// Tetrahedra with damping of strains, of a scene that has some.
struct UsualTetrahedra {
  static constexpr unsigned gives = asks_tetrahedra;

  OGC_HD static Part<LoadTetrahedron, AddTetrahedron> part_of(const SweepView& view, int slot,
                                                              const SweepVertex& vertex, const OwnVertex& own) {
    const TetrahedronRow row = view.tetrahedron_rows[slot];
    return {row.count, {view.tetrahedra + row.begin, row.begin}, {view, view.solids[vertex.body], own.position}};
  }
};
/// Tetrahedra with whatever damping, of a scene that may have none.
struct Tetrahedra : UsualTetrahedra {
  static constexpr unsigned gives = asks_tetrahedra | asks_any_model;

  OGC_HD static Part<LoadTetrahedron, AddAnyTetrahedron> part_of(const SweepView& view, int slot,
                                                                 const SweepVertex& vertex, const OwnVertex& own) {
    TetrahedronRow row;
    if (view.tetrahedron_rows != nullptr) row = view.tetrahedron_rows[slot];
    return {row.count,
            {view.tetrahedra + row.begin, row.begin},
            {view, view.solids[vertex.body], view.models[vertex.body], own}};
  }
};

}  // namespace ogc::fast
