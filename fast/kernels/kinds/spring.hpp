// Springs in the sum of a vertex.
#pragma once

#include "fast/kernels/models/damping.hpp"
#include "fast/kernels/models/spring.hpp"
#include "fast/kernels/sweep_view.hpp"
#include "fast/kernels/team.hpp"

namespace ogc::fast {

/// A spring as its end `own` sees it. `index` names all ends, encoded as sweep_view.hpp says.
struct SpringIncidence {
  int index[3] = {0, 0, 0};
  int own = 0;          ///< number of the end, 0 … 2
  SpringRest spring{};  ///< rest data, the same at each end
};

/// The springs of a vertex in their stream.
struct SpringRow {
  int begin = 0, count = 0;  ///< first place in SweepView::springs, and how many
};

/// A spring with whatever damping.
OGC_HD inline void add_any_spring(const SweepView& view, const SpringIncidence& incidence, const SurfaceModels& models,
                                  const OwnVertex& own, ForceAndBlock& sum) {
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

/// Adds a spring of a vertex.
struct AddSpring {
  const SweepView& view;
  SurfaceModels models;
  OwnVertex own;

  OGC_HD void operator()(const SpringIncidence& spring, ForceAndBlock& sum) const {
    add_any_spring(view, spring, models, own, sum);
  }
};

/// Springs with whatever damping, of a scene that may have none.
struct Springs {
  static constexpr unsigned gives = asks_springs | asks_any_model;

  OGC_HD static Part<LoadFrom<SpringIncidence>, AddSpring> part_of(const SweepView& view, int slot,
                                                                   const SweepVertex& vertex, const OwnVertex& own) {
    SpringRow row;
    if (view.spring_rows != nullptr) row = view.spring_rows[slot];
    return {row.count, {view.springs + row.begin}, {view, view.models[vertex.body], own}};
  }
};

}  // namespace ogc::fast
