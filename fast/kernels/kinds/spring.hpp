// Adds springs and stitches to the sums of sweeps and reports.
#pragma once

#include "fast/kernels/kinds/kind.hpp"
#include "fast/kernels/models/spring.hpp"
#include "fast/kernels/sum_columns.hpp"

namespace ogc::fast {

/// A spring as one of its ends sees it. `index` holds all ends, encoded as in sweep_view.hpp.
struct SpringIncidence {
  int index[3] = {0, 0, 0};
  int own = 0;          ///< number of the end that sees it, 0 … 2
  SpringRest spring{};  ///< rest data, the same at each end
};

/// Describes springs as a kind of element (kind.hpp).
struct SpringKind : ElementKind<SpringRest, SpringIncidence> {
  /// The kind's part of SweepView.
  struct View {
    StreamView<SpringIncidence, NoData, NoData, NoData, true> springs;
  };
  static constexpr unsigned asked = asks_springs;
  static constexpr bool is_curve = true;
  /// Operations by term for a stitch (fast/kernels/models/spring.hpp). Now and at the start of the step: differences 9
  /// + 9, squares 5 + 5, roots 1 + 1. Once: stiffness 2, stretch 2, resistance 1, pull 6, force 1 + 6, block 4 + 3 + 4
  /// + 15.
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
  static constexpr unsigned gives = asks_springs | asks_any_model;

  template <class View>
  OGC_HD static Part<LoadFrom<SpringIncidence>, AddSpring> part_of(const View& view, int slot,
                                                                   const SweepVertex& vertex, const OwnVertex& own) {
    const Row row = row_of<SpringKind, false>(view, slot, vertex);
    return {row.count, {view.springs.incidences + row.begin}, {view, view.models[vertex.body], own}};
  }
};

}  // namespace ogc::fast
