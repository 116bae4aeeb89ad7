// Adds tetrahedra of solids (stable Neo-Hookean) to the sums of sweeps and reports, as one of their corners sees them
// (compare/stages/tetrahedron.hpp). a, b, c are the vectors to the other corners, in the order in which det(a, b, c) is
// positive at rest. N_k are the shape functions of the other corners, N is the one of this corner. With n = (b − a) ×
// (c − a), w_k = V ∇N_k·∇N and i = 1/(6V):
//
//   J = i n·a,   V ∂J/∂x = −n/6,   force −μ (w₁ a + w₂ b + w₃ c) + ((λ + μ)(J − 1) − μ) n/6,
//   block −μ (w₁ + w₂ + w₃) I + (λ + μ) i/6 n nᵀ
//
// Only damping needs F and V, so an incidence has four numbers of rest data.
#pragma once

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/scalar.hpp"
#include "fast/kernels/arithmetic/vector.hpp"
#include "fast/kernels/items.hpp"
#include "fast/kernels/kinds/kind.hpp"
#include "fast/kernels/sum_columns.hpp"

namespace ogc::fast {

/// Constants of one body. Damping is already divided by the step: k_d/h [1].
struct alignas(16) SolidMaterial {
  float lame_lambda = 0, lame_mu = 0;  ///< [Pa]
  float damping = 0;                   ///< k_d/h [1]
};

/// A tetrahedron at rest (method.md §8.4).
struct TetrahedronRest {
  int corner[4] = {-1, -1, -1, -1};  ///< vertices, in the order of a positive volume at rest
  int body = -1;
  float weight[6] = {};       ///< V ∇N_k·∇N_l of the pairs 01, 02, 03, 12, 13, 23 [m]
  float inverse = 0;          ///< i = 1/(6 V) [1/m³]
  float gradient[3][3] = {};  ///< ∇N₁, ∇N₂, ∇N₃ [1/m], for the damping
  float volume = 0;           ///< V [m³], for the damping
};

/// One tetrahedron seen from one corner.
template <class T>
struct TetrahedronStencilOf {
  T weight[3];  ///< w_k of the other corners [m]
  T inverse;    ///< i [1/m³]
};
using TetrahedronStencil = TetrahedronStencilOf<float>;

/// A symmetric 3×3 strain [1] or stress [Pa].
using SolidStrain = Symmetric3;

/// Holds the data that only damping of strains reads: V, and the gradients ∇N of the shape functions of the other three
/// corners. The gradient for this corner is minus the sum of these gradients.
struct TetrahedronGradients {
  Vec other[3];      ///< ∇N [1/m]
  float volume = 0;  ///< V [m³]
};

/// Adds the elastic force on one corner, and its block. a, b and c are the vectors from this corner to the others, in
/// the order of TetrahedronIncidence::index.
template <class T>
OGC_HD void add_tetrahedron(const TetrahedronStencilOf<T>& stencil, const SolidMaterial& material, const Vector<T>& a,
                            const Vector<T>& b, const Vector<T>& c, ForceAndBlockOf<T>& sum) {
  const float mu = material.lame_mu, bulk = material.lame_lambda + mu;
  const Vector<T> normal = cross(b - a, c - a);
  const T* w = stencil.weight;
  const T pull = bulk * (stencil.inverse * dot(normal, a) - 1.0f) - mu;
  sum.add_force(T{} - mu, w[0] * a + w[1] * b + w[2] * c);
  sum.add_force((1.0f / 6.0f) * pull, normal);
  sum.add_identity((T{} - mu) * (w[0] + w[1] + w[2]));
  sum.add_outer((bulk / 6.0f) * stencil.inverse, normal);
}

/// Holds the columns of F.
struct SolidDeformation {
  Vec column[3];  ///< ∂x along the axes of the rest shape [1]
};

/// Returns F = Σ x_k ∇N_kᵀ, with a, b and c the vectors to the other corners.
OGC_HD inline SolidDeformation solid_deformation(const TetrahedronGradients& gradients, const Vec& a, const Vec& b,
                                                 const Vec& c) {
  const Vec* g = gradients.other;
  return {{g[0].x * a + g[1].x * b + g[2].x * c, g[0].y * a + g[1].y * b + g[2].y * c,
           g[0].z * a + g[1].z * b + g[2].z * c}};
}

/// Returns G = (FᵀF − I)/2.
OGC_HD inline SolidStrain solid_strain(const SolidDeformation& f) {
  const Vec *x = &f.column[0], *y = &f.column[1], *z = &f.column[2];
  return {0.5f * (dot(*x, *x) - 1.0f), 0.5f * dot(*x, *y), 0.5f * dot(*x, *z),
          0.5f * (dot(*y, *y) - 1.0f), 0.5f * dot(*y, *z), 0.5f * (dot(*z, *z) - 1.0f)};
}

/// Returns F times a vector of the rest shape.
OGC_HD inline Vec along_columns(const SolidDeformation& f, const Vec& by) {
  return by.x * f.column[0] + by.y * f.column[1] + by.z * f.column[2];
}

/// Adds the damping force on one corner, −∂/∂x of V (k_d/h) (λ/2 tr(ΔG)² + μ ‖ΔG‖²) with ΔG = G − Gᵗ. Also adds the
/// material part of the block, V (k_d/h) ((λ + μ)(F∇N)(F∇N)ᵀ + μ ‖∇N‖² F Fᵀ), with ∇N of this corner. a, b and c are
/// the vectors from this corner to the others; `start` is Gᵗ.
OGC_HD inline void add_solid_damping(const TetrahedronGradients& gradients, const SolidMaterial& material, const Vec& a,
                                     const Vec& b, const Vec& c, const SolidStrain& start, ForceAndBlock& sum) {
  const SolidDeformation f = solid_deformation(gradients, a, b, c);
  const SolidStrain now = solid_strain(f);
  const Vec own = -(gradients.other[0] + gradients.other[1] + gradients.other[2]);
  const float mu = material.lame_mu,
              trace = material.lame_lambda * ((now.xx - start.xx) + (now.yy - start.yy) + (now.zz - start.zz));
  const float xx = trace + 2 * mu * (now.xx - start.xx), yy = trace + 2 * mu * (now.yy - start.yy),
              zz = trace + 2 * mu * (now.zz - start.zz), xy = 2 * mu * (now.xy - start.xy),
              xz = 2 * mu * (now.xz - start.xz), yz = 2 * mu * (now.yz - start.yz);
  const Vec pull{xx * own.x + xy * own.y + xz * own.z, xy * own.x + yy * own.y + yz * own.z,
                 xz * own.x + yz * own.y + zz * own.z};
  const float weight = gradients.volume * material.damping, around = weight * mu * dot(own, own);
  sum.add_force(-weight, along_columns(f, pull));
  sum.add_outer(weight * (material.lame_lambda + mu), along_columns(f, own));
  for (const Vec& column : f.column) sum.add_outer(around, column);
}

/// Returns J = i det(a, b, c) in double. J and the energy are only reported.
OGC_HD inline double volume_ratio(const TetrahedronRest& rest, const Vec& a, const Vec& b, const Vec& c) {
  const Vector<double> p{a.x, a.y, a.z}, q{b.x, b.y, b.z}, r{c.x, c.y, c.z};
  return rest.inverse * dot(p, cross(q, r));
}

/// Returns V ψ [J]. It is computed from positions, so V (‖F‖² − 3) suffers cancellation and has an error of about 2⁻²²
/// V. Displacements from rest, which give F − I, would avoid this.
OGC_HD inline double solid_energy(const TetrahedronRest& rest, const SolidMaterial& material, const Vec& a,
                                  const Vec& b, const Vec& c) {
  const auto squared = [](const Vec& p) {
    return static_cast<double>(p.x) * p.x + static_cast<double>(p.y) * p.y + static_cast<double>(p.z) * p.z;
  };
  const float* w = rest.weight;
  const double stretch = -(w[0] * squared(a) + w[1] * squared(b) + w[2] * squared(c) + w[3] * squared(b - a) +
                           w[4] * squared(c - a) + w[5] * squared(c - b));
  const double volume = 1 / (6 * static_cast<double>(rest.inverse)), grown = volume_ratio(rest, a, b, c) - 1;
  const double mu = material.lame_mu, bulk = material.lame_lambda + mu;
  return 0.5 * mu * (stretch - 3 * volume) - volume * (mu * grown - 0.5 * bulk * grown * grown);
}

/// A tetrahedron as one of its corners sees it. `index` holds the other three corners in the order in which they make a
/// positive volume at rest, encoded as in sweep_view.hpp.
struct alignas(16) TetrahedronIncidence {
  int index[3] = {0, 0, 0};      ///< a, b, c
  int tetrahedron = -1;          ///< index in RestState::tetrahedra
  TetrahedronStencil stencil{};  ///< w_k and i (head of this file)
};

struct Tetrahedra;

/// The kind of tetrahedra.
struct TetrahedronKind : ElementKind<TetrahedronRest, TetrahedronIncidence> {
  using Whole = Tetrahedra;
  using Beside = TetrahedronGradients;
  using Start = SolidStrain;  ///< Gᵗ of damping
  using ByBody = SolidMaterial;
  /// The members of SweepView that this kind adds.
  struct View {
    StreamView<TetrahedronIncidence, TetrahedronGradients, SolidStrain, SolidMaterial, true> tetrahedra;
  };
  static constexpr bool reports_state = true;  ///< reports the number of inverted tetrahedra
  /// For each corner: the other corners, in the order in which they make a positive volume.
  static constexpr int others[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  /// Index of each pair of corners in TetrahedronRest::weight.
  static constexpr int pair[4][4] = {{-1, 0, 1, 2}, {0, -1, 3, 4}, {1, 3, -1, 5}, {2, 4, 5, -1}};
  /// Floating-point operations of add_tetrahedron, term by term: differences 9 + 6, normal 9, (J − 1) 7, pull 3,
  /// weighted sum 15, forces 6 + 1 + 6, sum of weights 3, identity 3, block 2 + 15.
  static constexpr double flop = 85;
  /// Floating-point operations of damping, term by term: F 45, G 39, the corner's gradient 6, trace 6, stresses 21,
  /// pull 15, weights 1 + 7, force 15 + 6, F∇N 15, blocks 2 + 15 + 45.
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

/// Holds the values of a tetrahedron that the formulas for one of its corners read.
template <class N>
struct TetrahedronReadsOf {
  TetrahedronStencilOf<N> stencil;
  Vector<N> a, b, c;  ///< the other corners minus this corner [m]
};

/// Reads the values of tetrahedra at the current positions; `own` is the position of the corner.
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

/// A tetrahedron as one of its corners sees it, with the index of its gradients.
struct LoadedTetrahedron {
  TetrahedronIncidence incidence;
  int place;  ///< index of its gradients in view.tetrahedra.beside
};
/// Loads tetrahedron k of a vertex.
struct LoadTetrahedron {
  const TetrahedronIncidence* first;  ///< row of the vertex
  int begin;                          ///< index of the row's first incidence in the stream

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
  template <class All>
  static constexpr unsigned gives = All::template bit<TetrahedronKind> | asks_any_bending;

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
  template <class All>
  static constexpr unsigned gives = All::template bit<TetrahedronKind> | asks_any_model;

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

  /// Returns whether add_packs can add the tetrahedra of a vertex. It can if the scene has no tetrahedra, or if the
  /// body has no damping and its DampingForm is `strain`.
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
