// Tetrahedra in the sum over the stencils of a vertex: of scenes that have nothing else (GatherSolids), and beside
// surfaces of any model (GatherEverything).
#pragma once

#include "fast/kernels/models/tetrahedron.hpp"
#include "fast/kernels/sweep.hpp"
#include "fast/kernels/sweep_models.hpp"

namespace ogc::fast {

/// A tetrahedron seen from one of its corners. `index`: the others, in the order in which they have a positive volume
/// at rest, encoded as in sweep.hpp.
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

// Named functors, as those of the springs (sweep_models.hpp).

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

/// The tetrahedra of a vertex as a part of its sum.
template <class Add>
OGC_HD Part<LoadTetrahedron, Add> tetrahedron_part(const SweepView& view, int slot, const Add& add) {
  const TetrahedronRow row = view.tetrahedron_rows[slot];
  return part(row.count, LoadTetrahedron{view.tetrahedra + row.begin, row.begin}, add);
}

/// Of scenes whose free vertices all belong to solids, with damping of strains and the activation `ogc`, in three
/// parts: tetrahedra, vertex–facet contacts, edge–edge contacts.
struct GatherSolids {
  static constexpr int parts = 3;  ///< of the sum

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    const ContactParts<OgcActivation, WeightsOfUpdate> contacts{view, view.contact_rows[slot], {}};
    const auto tetrahedra = tetrahedron_part(view, slot, AddTetrahedron{view, view.solids[vertex.body], own});
    team.prefetch(tetrahedra.load.first, tetrahedra.count * static_cast<int>(sizeof(TetrahedronIncidence)));
    team.prefetch(view.contacts + contacts.row.begin, contacts.row.count * static_cast<int>(sizeof(ContactIncidence)));
    return team.template sum<ForceAndBlock>(tetrahedra, contacts.vertex_facet(), contacts.edge_edge());
  }
};

/// As GatherEveryModel, with tetrahedra as a part between springs and contacts.
struct GatherEverything {
  static constexpr int parts = GatherEveryModel::parts + 1;  ///< of the sum

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    const OwnVertex at{own, own - view.start[vertex.vertex]};
    const AddAnyTetrahedron add{view, view.solids[vertex.body], view.models[vertex.body], at};
    return every_model_sum(view, slot, vertex, at, team, tetrahedron_part(view, slot, add));
  }
};

}  // namespace ogc::fast
