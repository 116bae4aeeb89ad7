// Rods in a sweep: the sum over the stencils of a vertex of scenes that have nothing else (GatherRods), springs as well
// (GatherTiedRods) or anything (GatherAnythingWithRods); and the update of a segment's quaternion. Segments are set
// colour by colour before the vertices; neighbours never share a colour, so one array is read and written.
#pragma once

#include "fast/kernels/models/damping.hpp"
#include "fast/kernels/rods/segments.hpp"
#include "fast/kernels/sweep.hpp"
#include "fast/kernels/sweep_models.hpp"
#include "fast/kernels/sweep_solids.hpp"
#include "fast/kernels/volumes/stream.hpp"

namespace ogc::fast {

/// c of a segment: e₃ where no strain is damped.
OGC_HD inline Vec segment_direction(const RodStream& rods, int segment) {
  return rods.direction != nullptr ? rods.direction[segment] : Vec{0.0f, 0.0f, 1.0f};
}

/// Segment k of a vertex.
struct LoadRod {
  const RodIncidence* first;  ///< of the vertex's row

  OGC_HD RodIncidence operator()(int k) const { return first[k]; }
};
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

/// The segments of a vertex as a part of its sum.
OGC_HD inline Part<LoadRod, AddRod> rod_part(const SweepView& view, int slot, const SweepVertex& vertex,
                                             const OwnVertex& own) {
  const RodRow row = view.rods.rows[slot];
  const float damping = view.rods.damping != nullptr ? view.rods.damping[vertex.body] : 0.0f;
  return part(row.count, LoadRod{view.rods.incidences + row.begin}, AddRod{view, own, damping});
}

/// The sum over `before`, segments, vertex–facet contacts and edge–edge contacts, with the activation `ogc`.
template <class Team, class... Parts>
OGC_HD ForceAndBlock rod_sum(const SweepView& view, int slot, const SweepVertex& vertex, const OwnVertex& at,
                             const Team& team, const Parts&... before) {
  const ContactParts<OgcActivation, WeightsOfUpdate> contacts{view, view.contact_rows[slot], {}};
  team.prefetch(view.contacts + contacts.row.begin, contacts.row.count * static_cast<int>(sizeof(ContactIncidence)));
  return team.template sum<ForceAndBlock>(before..., rod_part(view, slot, vertex, at), contacts.vertex_facet(),
                                          contacts.edge_edge());
}

/// Of scenes whose free vertices are all on segments alone, with the activation `ogc`.
struct GatherRods {
  static constexpr int parts = 3;  ///< of the sum

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    return rod_sum(view, slot, vertex, {own, own - view.start[vertex.vertex]}, team);
  }
};

/// As GatherRods, with springs before the segments.
struct GatherTiedRods {
  static constexpr int parts = GatherRods::parts + 1;  ///< of the sum

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    const OwnVertex at{own, own - view.start[vertex.vertex]};
    return rod_sum(view, slot, vertex, at, team, spring_part(view, slot, view.models[vertex.body], at));
  }
};

/// As tetrahedron_part, of a scene that may have none.
template <class Add>
OGC_HD Part<LoadTetrahedron, Add> tetrahedra_if_any(const SweepView& view, int slot, const Add& add) {
  TetrahedronRow row;
  if (view.tetrahedron_rows != nullptr) row = view.tetrahedron_rows[slot];
  return part(row.count, LoadTetrahedron{view.tetrahedra + row.begin, row.begin}, add);
}

/// As rod_part, likewise.
OGC_HD inline Part<LoadRod, AddRod> rods_if_any(const SweepView& view, int slot, const SweepVertex& vertex,
                                                const OwnVertex& own) {
  if (view.rods.rows != nullptr) return rod_part(view, slot, vertex, own);
  return part(0, LoadRod{view.rods.incidences}, AddRod{view, own, 0.0f});
}

/// As GatherEveryModel, with tetrahedra, volumes and segments, where there are any, as parts between springs and
/// contacts. `Weights`: of contacts, as ContactParts has them.
template <class Weights>
struct GatherAnything : KnowsVolumes {
  static constexpr int parts = GatherEveryModel::parts + 3;  ///< of the sum

  template <class Team>
  OGC_HD ForceAndBlock operator()(const SweepView& view, int slot, const SweepVertex& vertex, const Vec& own,
                                  const Team& team) const {
    const OwnVertex at{own, own - view.start[vertex.vertex]};
    const AddAnyTetrahedron add{view, view.solids[vertex.body], view.models[vertex.body], at};
    return every_model_sum<Weights>(view, slot, vertex, at, team, tetrahedra_if_any(view, slot, add),
                                    volume_part(view, slot, vertex.vertex, own), rods_if_any(view, slot, vertex, at));
  }
};
using GatherAnythingWithRods = GatherAnything<WeightsOfUpdate>;

/// μ = σ + ‖b‖, as Hsu et al. 2025 have it: q ∝ (μ + M) b.
OGC_HD inline Quat published_orientation(float stretch, const Vec& apart, const Vec& direction, const Quat& b,
                                         const Quat& old) {
  const float length = sqrtf(dot(apart, apart)), size = sqrtf(dot(direction, direction)), pull = sqrtf(dot(b, b));
  const float sigma = 2.0f * stretch * length * size;
  if (!(sigma > 0 && pull > 0)) return rod_orientation(stretch, apart, direction, b, old);
  const ReflectedFrame frame{pure((1.0f / length) * apart), pure((1.0f / size) * direction)};
  const Quat q = (sigma + pull) * b + sigma * frame(b);
  return dot(q, q) > 0 ? unit(q) : nearest_upper(frame, old);
}

/// for_each over the free segments of a colour.
struct UpdateSegment {
  /// What no launch before this one writes.
  struct Ahead {
    SegmentSlot slot;
    bool is_off = false;  ///< it is another iteration's turn
  };

  SweepView view;
  int first_slot = 0;      ///< of the colour
  bool asks_late = false;  ///< the launch before may decide whose turn it is

  OGC_HD Ahead ahead(int i) const { return {view.rods.slots[first_slot + i], !asks_late && view.is_off()}; }
  OGC_HD void operator()(int i) const { (*this)(i, ahead(i)); }
  OGC_HD void operator()(int, const Ahead& read) const {
    if (asks_late ? view.is_off() : read.is_off) return;
    const RodStream& rods = view.rods;
    const SegmentSlot& slot = read.slot;
    const SegmentRest& rest = slot.rest;
    const int e = slot.segment;
    const Vec apart = view.read(rest.end[1]) - view.read(rest.end[0]), direction = segment_direction(rods, e);
    const Quat old = rods.orientation[e];
    const float damping = rods.is_damped_by_vertex ? 0.0f : rest.damping;
    Quat own_start, b{0.0f, 0.0f, 0.0f, 0.0f};
    if (damping > 0) own_start = rods.orientation_start[e];
    for (int k = 0; k < 2; ++k) {
      const int f = slot.neighbours.number[k];
      Quat start;
      if (damping > 0) start = rods.orientation_start[f];
      add_neighbour(slot.neighbours.rest[k], k == 1, damping, rods.orientation[f], start, own_start, old, b);
    }
    const Quat found = rods.as_published ? published_orientation(rest.stretch, apart, direction, b, old)
                                         : rod_orientation(rest.stretch, apart, direction, b, old);
    if (is_finite(found.x + found.y + found.z + found.w))
      rods.orientation[e] = found;
    else
      view.control->count_not_finite();
  }
};

}  // namespace ogc::fast
