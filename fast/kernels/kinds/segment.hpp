// Segments of rods in the sum of a vertex.
#pragma once

#include "fast/kernels/models/damping.hpp"
#include "fast/kernels/rods/segments.hpp"
#include "fast/kernels/sweep_view.hpp"
#include "fast/kernels/team.hpp"

namespace ogc::fast {

/// c of a segment: e₃ where no strain is damped.
OGC_HD inline Vec segment_direction(const RodStream& rods, int segment) {
  return rods.direction != nullptr ? rods.direction[segment] : Vec{0.0f, 0.0f, 1.0f};
}

/// Adds a segment of a vertex.
struct AddRod {
  const SweepView& view;
  OwnVertex own;
  float damping;  ///< k_d/h of the vertex's body [1]

  OGC_HD void operator()(const RodIncidence& seen, ForceAndBlock& sum) const {
    const int segment = decoded(seen.segment), end = seen.segment < 0 ? 1 : 0;
    const Vec away = view.read(seen.other) - own.position, apart = end == 0 ? away : -1.0f * away;
    const SegmentRest rest{{}, seen.length, seen.stretch, 0.0f};
    const Quat q = view.rods.orientation[segment];
    const Vec direction = segment_direction(view.rods, segment);
    if (!view.rods.is_damped_by_vertex) return add_rod(rest, damping, end, apart, q, direction, sum);
    ForceAndBlock elastic;
    add_rod(rest, 0.0f, end, apart, q, direction, elastic);
    add_damped_by_vertex(elastic, damping, own.moved, sum);
  }
};

/// Segments with whatever damping, of a scene that has some.
struct UsualSegments {
  static constexpr unsigned gives = asks_segments | asks_any_model;

  OGC_HD static Part<LoadFrom<RodIncidence>, AddRod> part_of(const SweepView& view, int slot, const SweepVertex& vertex,
                                                             const OwnVertex& own) {
    const RodRow row = view.rods.rows[slot];
    const float damping = view.rods.damping != nullptr ? view.rods.damping[vertex.body] : 0.0f;
    return {row.count, {view.rods.incidences + row.begin}, {view, own, damping}};
  }
};
/// The same of a scene that may have none.
struct Segments : UsualSegments {
  OGC_HD static Part<LoadFrom<RodIncidence>, AddRod> part_of(const SweepView& view, int slot, const SweepVertex& vertex,
                                                             const OwnVertex& own) {
    if (view.rods.rows != nullptr) return UsualSegments::part_of(view, slot, vertex, own);
    return {0, {view.rods.incidences}, {view, own, 0.0f}};
  }
};

}  // namespace ogc::fast
