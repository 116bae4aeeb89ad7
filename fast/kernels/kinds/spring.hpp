// Adds springs to the sums of sweeps and reports. The energy is k_s/2 (l − l₀)², the energy of damping is (k_d/h) k_s/2
// (l − lᵗ)², with l = ‖x₀ − (1 − s) x₁ − s x₂‖ (compare/stages/spring.hpp).
#pragma once

#include <cmath>

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/vector.hpp"
#include "fast/kernels/kinds/kind.hpp"
#include "fast/kernels/sum_columns.hpp"

namespace ogc::fast {

/// A spring or stitch at rest.
struct SpringRest {
  int end[3] = {-1, -1, -1};             ///< vertices; the third equals the second if s = 0
  float stiffness = 0, rest_length = 0;  ///< k_s [N/m], l₀ [m]
  float damping = 0;                     ///< k_d/h [1]
  float ratio = 0;                       ///< s [1]
};

/// Returns the number of vertices on which the spring acts.
inline int end_count(const SpringRest& spring) { return spring.ratio > 0 ? 3 : 2; }

/// Returns x₀ − (1 − s) x₁ − s x₂.
OGC_HD inline Vec spring_apart(const SpringRest& spring, const Vec* end) {
  const Vec apart = end[0] - end[1];
  return spring.ratio > 0 ? apart - spring.ratio * (end[2] - end[1]) : apart;
}

/// Returns the weight of an end in x₀ − (1 − s) x₁ − s x₂: 1, s − 1 or −s.
OGC_HD inline float spring_weight(const SpringRest& spring, int end) {
  return end == 0 ? 1.0f : end == 1 ? spring.ratio - 1.0f : -spring.ratio;
}

/// Returns l [m]; 0 if the squared length is not a normal number.
OGC_HD inline float spring_length(const Vec& apart) {
  const float squared = dot(apart, apart);
  return squared >= 0x1p-126f ? sqrtf(squared) : 0.0f;
}

/// Adds force and block of the end with weight w. `apart`: the result of spring_apart; `length_start`: lᵗ.
OGC_HD inline void add_spring(const SpringRest& spring, float weight, float damping, const Vec& apart,
                              float length_start, ForceAndBlock& sum) {
  const float length = spring_length(apart), stiffness = weight * weight * spring.stiffness;
  // A spring of length 0 has no direction. Its block is then w² k_s I, which majorises the energy for every l₀. A
  // stitch (l₀ = 0) needs this block, too: its true length may exceed 0 when the computed length is 0.
  if (!(length > 0)) {
    sum.add_identity(stiffness);
    return;
  }
  const float stretched = 1.0f - spring.rest_length / length, across = stretched > 0 ? stretched : 0.0f,
              resistance = damping * stiffness;
  const float pull = spring.stiffness * stretched + damping * spring.stiffness * ((length - length_start) / length);
  sum.add_force(-(weight * pull), apart);
  sum.add_identity(stiffness * across);
  sum.add_outer(stiffness * (1.0f - across) + resistance, (1.0f / length) * apart);
}

/// Returns the energy [J], in double: energies are only reported.
OGC_HD inline double spring_energy(const SpringRest& spring, float length) {
  const double change = static_cast<double>(length) - spring.rest_length;
  return 0.5 * spring.stiffness * change * change;
}

/// A spring as its end `own` sees it. `index` holds all ends, encoded as in sweep_view.hpp.
struct SpringIncidence {
  int index[3] = {0, 0, 0};
  int own = 0;          ///< number of the end that sees it, 0 … 2
  SpringRest spring{};  ///< rest data, the same at each end
};

struct Springs;

/// The kind of springs.
struct SpringKind : ElementKind<SpringRest, SpringIncidence> {
  using Whole = Springs;
  /// The members of SweepView that this kind adds.
  struct View {
    StreamView<SpringIncidence, NoData, NoData, NoData, true> springs;
  };
  static constexpr bool is_curve = true;
  /// Floating-point operations of a stitch, term by term. At present and at the start of the step: differences 9 + 9,
  /// squares 5 + 5, roots 1 + 1. Then: stiffness 2, stretch 2, resistance 1, pull 6, force 1 + 6, block 4 + 3 + 4 + 15.
  static constexpr double flop = 74;

  template <class AnyView>
  OGC_HD static auto& stream(AnyView& view) {
    return view.springs;
  }
  static int count(const SpringRest& rest) { return end_count(rest); }
  static const int* vertices(const SpringRest& rest) { return rest.end; }
  static SpringIncidence seen(const SpringRest& rest, int, int end, const ColourOrder& encoded) {
    return {{encoded(rest.end[0]), encoded(rest.end[1]), encoded(rest.end[2])}, end, rest};
  }
  OGC_HD static void add_energy(const ElementsView<SpringKind>& all, int i, double* sum) {
    const SpringRest& rest = all.rest[i];
    const Vec end[3] = {all.position[rest.end[0]], all.position[rest.end[1]], all.position[rest.end[2]]};
    sum[sum_bending] += spring_energy(rest, spring_length(spring_apart(rest, end)));
  }
};

/// Adds a spring with any form of damping.
struct AddSpring {
  const SweepShared& view;
  SurfaceModels models;
  OwnVertex own;

  OGC_HD void operator()(const SpringIncidence& incidence, ForceAndBlock& sum) const {
    const SpringRest& spring = incidence.spring;
    Vec end[3];
    for (int k = 0; k < 3; ++k) end[k] = k == incidence.own ? own.position : view.read(incidence.index[k]);
    const Vec apart = spring_apart(spring, end);
    const float weight = spring_weight(spring, incidence.own);
    switch (models.damping) {
      case compare::DampingForm::per_vertex: {
        ForceAndBlock elastic;
        add_spring(spring, weight, 0.0f, apart, 0.0f, elastic);
        return add_damped_by_vertex(elastic, spring.damping, own.moved, sum);
      }
      case compare::DampingForm::strain: {
        float length_start = 0;
        if (spring.damping > 0) {
          for (int k = 0; k < 3; ++k) end[k] = view.start[decoded(incidence.index[k])];
          length_start = spring_length(spring_apart(spring, end));
        }
        return add_spring(spring, weight, spring.damping, apart, length_start, sum);
      }
    }
  }
};

/// Makes the part of a vertex's sum that adds springs with any form of damping; empty if the scene has no springs.
struct Springs {
  template <class All>
  static constexpr unsigned gives = All::template bit<SpringKind> | asks_any_model;

  template <class View>
  OGC_HD static Part<LoadFrom<SpringIncidence>, AddSpring> part_of(const View& view, int slot,
                                                                   const SweepVertex& vertex, const OwnVertex& own) {
    const Row row = row_of<SpringKind, false>(view, slot, vertex);
    return {row.count, {view.springs.incidences + row.begin}, {view, view.models[vertex.body], own}};
  }
};

}  // namespace ogc::fast
