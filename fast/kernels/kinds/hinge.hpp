// Adds hinges of bending surfaces to the sums of sweeps and reports.
#pragma once

#include "fast/kernels/items.hpp"
#include "fast/kernels/kinds/kind.hpp"
#include "fast/kernels/models/bending_models.hpp"
#include "fast/kernels/sum_columns.hpp"

namespace ogc::fast {

/// A hinge as one of its vertices sees it. If this vertex is an end of the edge it counts as x0, and `index` holds x1,
/// o0, o1. If it is an opposite vertex it counts as o0, and `index` holds x0, x1, o1.
struct alignas(8) HingeIncidence {
  int index[3] = {0, 0, 0};  ///< encoded as in sweep_view.hpp
  int hinge = -1;            ///< index in RestState::hinges; ~index if the vertex is an opposite one
  HingeStencil stencil{};    ///< c and θ₀
};

/// Computes the energy of hinge i. The argument of operator() is the functor of the bending model.
struct HingeEnergy {
  const HingeRest& rest;
  const HingeWeights* weights;  ///< by hinge; read only if the model `reads_weights`
  int i;
  const Vec* to;  ///< x1, o0 and o1 minus x0 [m]

  template <class Model>
  OGC_HD double operator()(Model) const {
    HingeWeights own;
    if constexpr (Model::reads_weights) own = weights[i];
    return Model::energy(rest, own, to);
  }
};

struct Hinges;

/// The kind of hinges. Roles 0 and 1 are the ends of the edge, 2 and 3 the opposite vertices.
struct HingeKind : ElementKind<HingeRest, HingeIncidence> {
  using Whole = Hinges;
  using Beside = IsometricStencil;
  using RestBeside = HingeWeights;
  using Start = float;  ///< θᵗ [rad]; 0 for a collapsed hinge
  /// The members of SweepView that this kind adds.
  struct View {
    StreamView<HingeIncidence, IsometricStencil, float, NoData, false> hinges;
  };
  static constexpr int row_in_vertex = 1;
  /// For each role of a vertex: the roles of the other vertices, in the order of HingeIncidence::index. For roles 1 and
  /// 3, x0 is exchanged with x1, and o0 with o1. The exchange does not change the angle
  /// (fast/kernels/models/hinge.hpp).
  static constexpr int others[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {1, 0, 2}};
  /// Floating-point operations of a hinge at one vertex, term by term (fast/kernels/models/discrete_hinge.hpp):
  /// differences 9, normals 18, squares 25, their limits 4, length 1, projections 12, the angle's arguments 11,
  /// arctangent2 13, feet 7, divisors 2, gradient 11, moment 5, force 6, block 17.
  static constexpr double flop = 141;

  template <class AnyView>
  OGC_HD static auto& stream(AnyView& view) {
    return view.hinges;
  }
  static int count(const HingeRest&) { return 4; }
  static const int* vertices(const HingeRest& rest) { return rest.vertex; }
  static HingeIncidence seen(const HingeRest& rest, int hinge, int role, const ColourOrder& encoded) {
    HingeIncidence incidence;
    for (int k = 0; k < 3; ++k) incidence.index[k] = encoded(rest.vertex[others[role][k]]);
    incidence.hinge = role < 2 ? hinge : ~hinge;
    incidence.stencil = {rest.stiffness, rest.angle};
    return incidence;
  }
  /// Returns the weight of the vertex, and the weights of the other vertices in the order of the incidence. The weight
  /// of x0 is minus the sum of the stored weights, rounded once.
  static IsometricStencil beside(const HingeRest&, const HingeWeights& rest, int role) {
    const float* w = rest.weight;
    const float all[4] = {
        static_cast<float>(-static_cast<double>(w[0]) - static_cast<double>(w[1]) - static_cast<double>(w[2])), w[0],
        w[1], w[2]};
    IsometricStencil stencil;
    stencil.own = all[role];
    for (int k = 0; k < 3; ++k) stencil.other[k] = all[others[role][k]];
    return stencil;
  }
  OGC_HD static float begin(const HingeRest& rest, const Vec* start) {
    const int* v = rest.vertex;
    const Vec base = start[v[0]];
    return hinge_shape(start[v[1]] - base, start[v[2]] - base, start[v[3]] - base).angle;
  }
  OGC_HD static void add_energy(const ElementsView<HingeKind>& all, int i, double* sum) {
    const HingeRest& rest = all.rest[i];
    const Vec *x = all.position, base = x[rest.vertex[0]];
    const Vec to[3] = {x[rest.vertex[1]] - base, x[rest.vertex[2]] - base, x[rest.vertex[3]] - base};
    sum[sum_bending] += with_bending(all.models[rest.body].bending, HingeEnergy{rest, all.beside, i, to});
  }
};

/// Reads the values of hinges at the current positions. `angle_start` is θᵗ by hinge.
template <class Items>
OGC_HD HingeReadsOf<typename Items::Number> read_hinges(const SweepShared& view, const float* angle_start,
                                                        const Items& items, const SurfaceMaterial& material) {
  using Seen = HingeIncidence;
  HingeReadsOf<typename Items::Number> reads{{items.each([](const Seen& i) { return i.stencil.stiffness; }),
                                              items.each([](const Seen& i) { return i.stencil.rest_angle; })},
                                             items.which([](const Seen& i) { return i.hinge < 0; }),
                                             {items.position(view, [](const Seen& i) { return i.index[0]; }),
                                              items.position(view, [](const Seen& i) { return i.index[1]; }),
                                              items.position(view, [](const Seen& i) { return i.index[2]; })}};
  if (material.bending_damping > 0)
    reads.angle_start = items.each([=](const Seen& i) { return angle_start[decoded(i.hinge)]; });
  return reads;
}

// The nesting of the branches below changes bits; see triangle.hpp.

/// Adds a hinge. The argument of operator() is the functor of its bending model.
struct AddHinge {
  /// Arguments of the model's `add` (models/bending_models.hpp). `damping` is k_d/h [1], or 0 for damping by vertex.
  const HingeSeen& hinge;
  float damping;
  ForceAndBlock& sum;

  template <class Model>
  OGC_HD void operator()(Model) const {
    Model::add(hinge, damping, sum);
  }
};
/// Adds the damping that the model's `add` does not include. AddHinge explains the members.
struct AddHingeDamper {
  const HingeSeen& hinge;
  float damping;
  ForceAndBlock& sum;

  template <class Model>
  OGC_HD void operator()(Model) const {
    Model::add_damper(hinge, damping, sum);
  }
};

/// Adds a discrete hinge with damping of strains.
struct AddDiscreteHinge {
  const SweepShared& view;
  const float* angle_start;  ///< θᵗ by hinge [rad]
  SurfaceMaterial material;
  Vec own;  ///< x of the vertex [m]

  OGC_HD void operator()(const HingeIncidence& hinge, ForceAndBlock& sum) const {
    DiscreteHinge::add(read_hinges(view, angle_start, OneItem<HingeIncidence>{hinge}, material),
                       material.bending_damping, own, sum);
  }
};
/// A hinge as one of its vertices sees it, with its isometric weights.
struct AnyHinge {
  HingeIncidence hinge;
  IsometricStencil isometric;  ///< 0 if no body bends isometrically
};
/// Loads hinge k of a vertex, with its isometric weights.
struct LoadAnyHinge {
  const HingeIncidence* first;        ///< row of the vertex
  const IsometricStencil* isometric;  ///< the same row; null if no body bends isometrically

  OGC_HD AnyHinge operator()(int k) const {
    AnyHinge any{first[k], {}};
    if (isometric != nullptr) any.isometric = isometric[k];
    return any;
  }
};
/// Adds a hinge with any bending model and any form of damping.
struct AddAnyHinge {
  const SweepShared& view;
  const float* angle_start;  ///< θᵗ by hinge [rad]
  SurfaceMaterial material;
  SurfaceModels models;
  OwnVertex own;

  OGC_HD void operator()(const AnyHinge& any, ForceAndBlock& sum) const {
    const auto reads = read_hinges(view, angle_start, OneItem<HingeIncidence>{any.hinge}, material);
    const HingeSeen hinge{reads, own.position, any.isometric};
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
};

/// Makes the part of a vertex's sum that adds discrete hinges with damping of strains.
struct UsualHinges {
  template <class All>
  static constexpr unsigned gives = All::template bit<HingeKind> | asks_any_stretch;

  template <class View>
  OGC_HD static Part<LoadFrom<HingeIncidence>, AddDiscreteHinge> part_of(const View& view, int slot,
                                                                         const SweepVertex& vertex,
                                                                         const OwnVertex& own) {
    const Row row = row_of<HingeKind, true>(view, slot, vertex);
    return {row.count,
            {view.hinges.incidences + row.begin},
            {view, view.hinges.start, view.materials[vertex.body], own.position}};
  }
};
/// Makes the part of a vertex's sum that adds hinges with any bending model and any form of damping.
struct Hinges {
  template <class All>
  static constexpr unsigned gives = All::template bit<HingeKind> | asks_any_model;

  template <class View>
  OGC_HD static Part<LoadAnyHinge, AddAnyHinge> part_of(const View& view, int slot, const SweepVertex& vertex,
                                                        const OwnVertex& own) {
    const Row row = row_of<HingeKind, true>(view, slot, vertex);
    const IsometricStencil* beside = view.hinges.beside;
    return {row.count,
            {view.hinges.incidences + row.begin, beside != nullptr ? beside + row.begin : nullptr},
            {view, view.hinges.start, view.materials[vertex.body], view.models[vertex.body], own}};
  }

  /// Returns whether add_packs can add the hinges of a vertex: they must be discrete hinges with damping of strains.
  template <class View>
  static bool is_packed(const View& view, const SweepVertex& vertex) {
    return has_default_bending(view.models[vertex.body]);
  }
  /// Adds the hinges of a vertex, several side by side in SIMD registers.
  template <class View, class Lanes>
  static void add_packs(const View& view, int slot, const SweepVertex& vertex, const typename Lanes::Position& own,
                        Lanes& lanes) {
    const Row row = row_of<HingeKind, true>(view, slot, vertex);
    const SurfaceMaterial material = view.materials[vertex.body];
    lanes.add_part(view.hinges.incidences + row.begin, row.count, [&](const auto& items, auto& sum) {
      DiscreteHinge::add(read_hinges(view, view.hinges.start, items, material), material.bending_damping, own, sum);
    });
  }
};

}  // namespace ogc::fast
