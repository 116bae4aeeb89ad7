// Adds triangles of membranes to the sums of sweeps and reports.
#pragma once

#include "fast/kernels/items.hpp"
#include "fast/kernels/kinds/kind.hpp"
#include "fast/kernels/models/membrane_models.hpp"
#include "fast/kernels/sum_columns.hpp"

namespace ogc::fast {

/// A triangle as one of its corners sees it. `index` holds the other two corners in the triangle's order, encoded as in
/// sweep_view.hpp.
struct alignas(16) MembraneIncidence {
  int index[2] = {0, 0};      ///< x_b, x_c
  int triangle = -1;          ///< index in RestState::triangles
  MembraneStencil stencil{};  ///< gradients and area
};

/// Computes the energy of a triangle. The argument of operator() is the functor of the membrane model.
struct MembraneEnergy {
  const TriangleRest& rest;
  const SurfaceMaterial& material;
  Vec to_b, to_c;  ///< edges from corner 0 to corners 1 and 2 [m]

  template <class Model>
  OGC_HD double operator()(Model) const {
    return Model::energy(rest, material, to_b, to_c);
  }
};

struct Triangles;

/// The kind of triangles.
struct TriangleKind : ElementKind<TriangleRest, MembraneIncidence> {
  using Whole = Triangles;
  using Start = Symmetric2;  ///< Gᵗ
  /// The members of SweepView that this kind adds.
  struct View {
    StreamView<MembraneIncidence, NoData, Symmetric2, NoData, false> triangles;
  };
  static constexpr int row_in_vertex = 0;
  /// Floating-point operations of a triangle at one corner, term by term (fast/kernels/models/st_venant_kirchhoff.hpp):
  /// differences 6, F 18, ∇N_a 2, G 20, S 10, stress of damping 3 + 10, pulls 14, force 9 + 6, F∇N_a 9, weights 7,
  /// blocks 17 + 30, geometric 9 + 4.
  static constexpr double flop = 174;

  template <class AnyView>
  OGC_HD static auto& stream(AnyView& view) {
    return view.triangles;
  }
  static int count(const TriangleRest&) { return 3; }
  static const int* vertices(const TriangleRest& rest) { return rest.corner; }
  static MembraneIncidence seen(const TriangleRest& rest, int triangle, int corner, const ColourOrder& encoded) {
    const int b = (corner + 1) % 3, c = (corner + 2) % 3;
    return {{encoded(rest.corner[b]), encoded(rest.corner[c])},
            triangle,
            {{rest.gradient[b][0], rest.gradient[b][1]}, {rest.gradient[c][0], rest.gradient[c][1]}, rest.area}};
  }
  OGC_HD static Symmetric2 begin(const TriangleRest& rest, const Vec* start) {
    const Vec a = start[rest.corner[0]];
    return green_strain(
        deformation_gradient(start[rest.corner[1]] - a, start[rest.corner[2]] - a, rest.gradient[1], rest.gradient[2]));
  }
  OGC_HD static void add_energy(const ElementsView<TriangleKind>& all, int t, double* sum) {
    const TriangleRest& rest = all.rest[t];
    const Vec *x = all.position, a = x[rest.corner[0]], to_b = x[rest.corner[1]] - a, to_c = x[rest.corner[2]] - a;
    sum[sum_membrane] += with_membrane(all.models[rest.body].membrane,
                                       MembraneEnergy{rest, all.materials[rest.body], to_b, to_c});
  }
};

/// Holds the values of a triangle that the formulas for one of its corners read. An update loads all of them before any
/// arithmetic, because loads take most of the time of a vertex on a device.
template <class N>
struct MembraneReadsOf {
  MembraneStencilOf<N> stencil;
  Vector<N> b, c;                  ///< positions of the other corners [m]
  Symmetric2Of<N> strain_start{};  ///< Gᵗ; 0 without damping
};

/// Reads the values of triangles at the current positions. `strain_start` is Gᵗ by triangle.
template <class Items>
OGC_HD MembraneReadsOf<typename Items::Number> read_triangles(const SweepShared& view, const Symmetric2* strain_start,
                                                              const Items& items, const SurfaceMaterial& material) {
  using Seen = MembraneIncidence;
  MembraneReadsOf<typename Items::Number> reads{{{items.each([](const Seen& i) { return i.stencil.gradient_b[0]; }),
                                                  items.each([](const Seen& i) { return i.stencil.gradient_b[1]; })},
                                                 {items.each([](const Seen& i) { return i.stencil.gradient_c[0]; }),
                                                  items.each([](const Seen& i) { return i.stencil.gradient_c[1]; })},
                                                 items.each([](const Seen& i) { return i.stencil.area; })},
                                                items.position(view, [](const Seen& i) { return i.index[0]; }),
                                                items.position(view, [](const Seen& i) { return i.index[1]; })};
  if (material.membrane_damping > 0)
    reads.strain_start = {items.each([=](const Seen& i) { return strain_start[i.triangle].xx; }),
                          items.each([=](const Seen& i) { return strain_start[i.triangle].xy; }),
                          items.each([=](const Seen& i) { return strain_start[i.triangle].yy; })};
  return reads;
}

/// Adds triangles with any membrane model and damping of strains.
template <class N>
OGC_HD void add_triangles(const MembraneReadsOf<N>& reads, const SurfaceMaterial& material,
                          compare::MembraneModel model, const Vector<N>& own, ForceAndBlockOf<N>& sum) {
  const Vector<N> to_b = reads.b - own, to_c = reads.c - own;
  with_membrane(model, AddDampedMembrane<N>{reads.stencil, material, to_b, to_c, reads.strain_start, sum});
}

// The functors below branch on the form of damping first, and within this branch on the model. Code that all models
// share is outside of both branches. The order of the branches changes bits, because a device contracts products and
// sums only within a branch.

/// Adds a triangle without damping. The argument of operator() is the functor of the membrane model.
struct AddElasticMembrane {
  /// Arguments of the model's `add_elastic`; `to_b` and `to_c` are the edges to the other corners [m].
  const MembraneStencil& stencil;
  const SurfaceMaterial& material;
  Vec to_b, to_c;
  ForceAndBlock& sum;

  template <class Model>
  OGC_HD void operator()(Model) const {
    Model::add_elastic(stencil, material, to_b, to_c, sum);
  }
};

/// Adds a triangle with damping of strains.
struct AddTriangle {
  const SweepShared& view;
  const Symmetric2* strain_start;  ///< Gᵗ by triangle
  SurfaceMaterial material;
  compare::MembraneModel model;
  Vec own;  ///< x of the vertex [m]

  OGC_HD void operator()(const MembraneIncidence& triangle, ForceAndBlock& sum) const {
    add_triangles(read_triangles(view, strain_start, OneItem<MembraneIncidence>{triangle}, material), material, model,
                  own, sum);
  }
};
/// Adds a triangle with any membrane model and either form of damping.
struct AddAnyTriangle {
  const SweepShared& view;
  const Symmetric2* strain_start;  ///< Gᵗ by triangle
  SurfaceMaterial material;
  SurfaceModels models;
  OwnVertex own;

  OGC_HD void operator()(const MembraneIncidence& triangle, ForceAndBlock& sum) const {
    const auto reads = read_triangles(view, strain_start, OneItem<MembraneIncidence>{triangle}, material);
    switch (models.damping) {
      case compare::DampingForm::per_vertex: {
        ForceAndBlock elastic;
        const Vec to_b = reads.b - own.position, to_c = reads.c - own.position;
        with_membrane(models.membrane, AddElasticMembrane{reads.stencil, material, to_b, to_c, elastic});
        return add_damped_by_vertex(elastic, material.membrane_damping, own.moved, sum);
      }
      case compare::DampingForm::strain: return add_triangles(reads, material, models.membrane, own.position, sum);
    }
  }
};

/// Makes the part of a vertex's sum that adds triangles with any membrane model and damping of strains.
struct UsualTriangles {
  template <class All>
  static constexpr unsigned gives = All::template bit<TriangleKind> | asks_any_bending;

  template <class View>
  OGC_HD static Part<LoadFrom<MembraneIncidence>, AddTriangle> part_of(const View& view, int slot,
                                                                       const SweepVertex& vertex,
                                                                       const OwnVertex& own) {
    const Row row = row_of<TriangleKind, true>(view, slot, vertex);
    return {row.count,
            {view.triangles.incidences + row.begin},
            {view, view.triangles.start, view.materials[vertex.body], view.models[vertex.body].membrane, own.position}};
  }
};
/// Makes the part of a vertex's sum that adds triangles with any membrane model and either form of damping.
struct Triangles {
  template <class All>
  static constexpr unsigned gives = All::template bit<TriangleKind> | asks_any_model;

  template <class View>
  OGC_HD static Part<LoadFrom<MembraneIncidence>, AddAnyTriangle> part_of(const View& view, int slot,
                                                                          const SweepVertex& vertex,
                                                                          const OwnVertex& own) {
    const Row row = row_of<TriangleKind, true>(view, slot, vertex);
    return {row.count,
            {view.triangles.incidences + row.begin},
            {view, view.triangles.start, view.materials[vertex.body], view.models[vertex.body], own}};
  }

  /// Returns whether add_packs can add the triangles of a vertex: the body must have damping of strains.
  template <class View>
  static bool is_packed(const View& view, const SweepVertex& vertex) {
    return has_default_membrane(view.models[vertex.body]);
  }
  /// Adds the triangles of a vertex, several side by side in SIMD registers.
  template <class View, class Lanes>
  static void add_packs(const View& view, int slot, const SweepVertex& vertex, const typename Lanes::Position& own,
                        Lanes& lanes) {
    const Row row = row_of<TriangleKind, true>(view, slot, vertex);
    const SurfaceMaterial material = view.materials[vertex.body];
    const compare::MembraneModel model = view.models[vertex.body].membrane;
    lanes.add_part(view.triangles.incidences + row.begin, row.count, [&](const auto& items, auto& sum) {
      add_triangles(read_triangles(view, view.triangles.start, items, material), material, model, own, sum);
    });
  }
};

}  // namespace ogc::fast
