// Adds tetrahedra of solids to the sums of sweeps and reports.
#pragma once

#include "fast/kernels/items.hpp"
#include "fast/kernels/kinds/kind.hpp"
#include "fast/kernels/models/tetrahedron.hpp"
#include "fast/kernels/sum_columns.hpp"

namespace ogc::fast {

/// A tetrahedron as one of its corners sees it. `index` holds the other three corners, encoded as in sweep_view.hpp.
/// Their order is such that this corner, followed by them, has a positive volume at rest.
struct alignas(16) TetrahedronIncidence {
  int index[3] = {0, 0, 0};      ///< a, b, c of models/tetrahedron.hpp
  int tetrahedron = -1;          ///< number in RestState::tetrahedra
  TetrahedronStencil stencil{};  ///< w_k and i of models/tetrahedron.hpp
};

/// Describes tetrahedra as a kind of element (kind.hpp).
struct TetrahedronKind : ElementKind<TetrahedronRest, TetrahedronIncidence> {
  using Beside = TetrahedronGradients;
  using Start = SolidStrain;  ///< Gᵗ of damping
  using ByBody = SolidMaterial;
  /// The kind's part of SweepView.
  struct View {
    StreamView<TetrahedronIncidence, TetrahedronGradients, SolidStrain, SolidMaterial, true> tetrahedra;
  };
  static constexpr unsigned asked = asks_tetrahedra;
  static constexpr bool reports_state = true;  ///< each step reports the number of inverted tetrahedra
  /// For each corner: the other corners, in the order of TetrahedronIncidence::index.
  static constexpr int others[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  /// Index of each pair of corners in TetrahedronRest::weight.
  static constexpr int pair[4][4] = {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}};
  /// Operations by term (fast/kernels/models/tetrahedron.hpp): differences 9 + 6, normal 9, J − 1 7, pull 3, weighted
  /// sum 15, forces 6 + 1 + 6, sum of weights 3, identity 3, block 2 + 15.
  static constexpr double flop = 85;
  /// Operations of damping by term: F 45, G 39, the corner's gradient 6, trace 6, stresses 21, pull 15, weights 1 + 7,
  /// force 15 + 6, F∇N 15, blocks 2 + 15 + 45.
  static constexpr double damping_flop = 238;

  template <class AnyView>
  OGC_HD static auto& stream(AnyView& view) {
    return view.tetrahedra;
  }
  static int count(const TetrahedronRest&) { return 4; }
  static const int* vertices(const TetrahedronRest& rest) { return rest.corner; }
  static TetrahedronIncidence seen(const TetrahedronRest& rest, int tetrahedron, int corner,
                                   const ColourOrder& encoded) {
    TetrahedronIncidence incidence;
    for (int k = 0; k < 3; ++k) {
      const int other = others[corner][k];
      incidence.index[k] = encoded(rest.corner[other]);
      incidence.stencil.weight[k] = rest.weight[pair[corner][other]];
    }
    incidence.stencil.inverse = rest.inverse;
    incidence.tetrahedron = tetrahedron;
    return incidence;
  }
  /// Returns the gradients of the other corners, in the order of the incidence. ∇N₀ is minus the sum of the stored
  /// gradients, rounded once.
  static TetrahedronGradients beside(const TetrahedronRest& rest, const NoData&, int corner) {
    float gradient[4][3];
    for (int axis = 0; axis < 3; ++axis) {
      gradient[0][axis] = static_cast<float>(-static_cast<double>(rest.gradient[0][axis]) - rest.gradient[1][axis] -
                                             rest.gradient[2][axis]);
      for (int k = 1; k < 4; ++k) gradient[k][axis] = rest.gradient[k - 1][axis];
    }
    TetrahedronGradients seen;
    for (int k = 0; k < 3; ++k) {
      const float* of_other = gradient[others[corner][k]];
      seen.other[k] = {of_other[0], of_other[1], of_other[2]};
    }
    seen.volume = rest.volume;
    return seen;
  }
  OGC_HD static SolidStrain begin(const TetrahedronRest& rest, const Vec* start) {
    TetrahedronGradients gradients;
    for (int k = 0; k < 3; ++k) gradients.other[k] = {rest.gradient[k][0], rest.gradient[k][1], rest.gradient[k][2]};
    const Vec own = start[rest.corner[0]];
    return solid_strain(solid_deformation(gradients, start[rest.corner[1]] - own, start[rest.corner[2]] - own,
                                          start[rest.corner[3]] - own));
  }
  /// Adds the energy of tetrahedron t, and counts the tetrahedron if it is inverted.
  OGC_HD static void add_energy(const ElementsView<TetrahedronKind>& all, int t, double* sum) {
    const TetrahedronRest& rest = all.rest[t];
    const Vec *x = all.position, own = x[rest.corner[0]], a = x[rest.corner[1]] - own, b = x[rest.corner[2]] - own,
              c = x[rest.corner[3]] - own;
    sum[sum_solid] += solid_energy(rest, all.by_body[rest.body], a, b, c);
    if (!(volume_ratio(rest, a, b, c) > 0)) sum[sum_inverted] += 1;
  }
};

/// Holds the numbers that tetrahedra need as one of their corners sees them.
template <class N>
struct TetrahedronReadsOf {
  TetrahedronStencilOf<N> stencil;
  Vector<N> a, b, c;  ///< the other corners minus this corner [m]
};

/// Returns the numbers that tetrahedra need at the current positions; `own` is the position of the corner.
template <class Items>
OGC_HD TetrahedronReadsOf<typename Items::Number> read_tetrahedra(const SweepShared& view, const Items& items,
                                                                  const Vector<typename Items::Number>& own) {
  using Seen = TetrahedronIncidence;
  return {{{items.each([](const Seen& i) { return i.stencil.weight[0]; }),
            items.each([](const Seen& i) { return i.stencil.weight[1]; }),
            items.each([](const Seen& i) { return i.stencil.weight[2]; })},
           items.each([](const Seen& i) { return i.stencil.inverse; })},
          items.position(view, [](const Seen& i) { return i.index[0]; }) - own,
          items.position(view, [](const Seen& i) { return i.index[1]; }) - own,
          items.position(view, [](const Seen& i) { return i.index[2]; }) - own};
}
/// Adds tetrahedra without damping.
template <class N>
OGC_HD void add_tetrahedra(const TetrahedronReadsOf<N>& reads, const SolidMaterial& material, ForceAndBlockOf<N>& sum) {
  add_tetrahedron(reads.stencil, material, reads.a, reads.b, reads.c, sum);
}

/// A tetrahedron as one of its corners sees it, with its place in the stream.
struct LoadedTetrahedron {
  TetrahedronIncidence incidence;
  int place;  ///< index of its gradients in view.tetrahedra.beside
};
/// Loads tetrahedron k of a vertex.
struct LoadTetrahedron {
  const TetrahedronIncidence* first;  ///< row of the vertex
  int begin;                          ///< place of the row in the stream

  OGC_HD LoadedTetrahedron operator()(int k) const { return {first[k], begin + k}; }
};

/// Adds a tetrahedron with damping of strains.
struct AddTetrahedron {
  const SweepShared& view;
  const TetrahedronGradients* gradients;  ///< by incidence; read if the body is damped
  const SolidStrain* strain_start;        ///< Gᵗ by tetrahedron
  SolidMaterial material;
  Vec own;  ///< x of the vertex [m]

  OGC_HD void operator()(const LoadedTetrahedron& loaded, ForceAndBlock& sum) const {
    const auto reads = read_tetrahedra(view, OneItem<TetrahedronIncidence>{loaded.incidence}, own);
    add_tetrahedra(reads, material, sum);
    if (material.damping > 0)
      add_solid_damping(gradients[loaded.place], material, reads.a, reads.b, reads.c,
                        strain_start[loaded.incidence.tetrahedron], sum);
  }
};
/// Adds a tetrahedron with either form of damping.
struct AddAnyTetrahedron {
  AddTetrahedron add;
  compare::DampingForm form;
  Vec moved;  ///< x − xᵗ of the vertex [m]

  OGC_HD void operator()(const LoadedTetrahedron& loaded, ForceAndBlock& sum) const {
    switch (form) {
      case compare::DampingForm::strain: return add(loaded, sum);
      case compare::DampingForm::per_vertex: {
        AddTetrahedron undamped = add;
        undamped.material.damping = 0;
        ForceAndBlock elastic;
        undamped(loaded, elastic);
        return add_damped_by_vertex(elastic, add.material.damping, moved, sum);
      }
    }
  }
};

/// Makes the part of a vertex's sum that adds tetrahedra with damping of strains. The scene must have tetrahedra.
struct UsualTetrahedra {
  static constexpr unsigned gives = asks_tetrahedra;

  template <class View>
  OGC_HD static Part<LoadTetrahedron, AddTetrahedron> part_of(const View& view, int slot, const SweepVertex& vertex,
                                                              const OwnVertex& own) {
    const auto& stream = view.tetrahedra;
    const Row row = row_of<TetrahedronKind, true>(view, slot, vertex);
    return {row.count,
            {stream.incidences + row.begin, row.begin},
            {view, stream.beside, stream.start, stream.by_body[vertex.body], own.position}};
  }
};
/// Makes the part of a vertex's sum that adds tetrahedra with either form of damping; empty if the scene has no
/// tetrahedra.
struct Tetrahedra {
  static constexpr unsigned gives = asks_tetrahedra | asks_any_model;

  template <class View>
  OGC_HD static Part<LoadTetrahedron, AddAnyTetrahedron> part_of(const View& view, int slot, const SweepVertex& vertex,
                                                                 const OwnVertex& own) {
    const auto& stream = view.tetrahedra;
    const Row row = row_of<TetrahedronKind, false>(view, slot, vertex);
    return {row.count,
            {stream.incidences + row.begin, row.begin},
            {{view, stream.beside, stream.start, stream.by_body[vertex.body], own.position},
             view.models[vertex.body].damping,
             own.moved}};
  }

  /// Returns whether add_packs can add the tetrahedra of a vertex: the scene has none, or they are undamped and their
  /// form of damping is that of strains.
  template <class View>
  static bool is_packed(const View& view, const SweepVertex& vertex) {
    return view.tetrahedra.rows == nullptr ||
           (!(view.tetrahedra.by_body[vertex.body].damping > 0) && damps_strain(view.models[vertex.body].damping));
  }
  /// Adds the tetrahedra of a vertex, several side by side in SIMD registers.
  template <class View, class Lanes>
  static void add_packs(const View& view, int slot, const SweepVertex& vertex, const typename Lanes::Position& own,
                        Lanes& lanes) {
    const Row row = row_of<TetrahedronKind, false>(view, slot, vertex);
    if (row.count == 0) return;
    const SolidMaterial material = view.tetrahedra.by_body[vertex.body];
    lanes.add_part(view.tetrahedra.incidences + row.begin, row.count, [&](const auto& items, auto& sum) {
      add_tetrahedra(read_tetrahedra(view, items, own), material, sum);
    });
  }
};

}  // namespace ogc::fast
