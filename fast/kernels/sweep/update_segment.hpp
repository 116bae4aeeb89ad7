// Updates a segment's quaternion. Segments are updated colour by colour before the vertices. Neighbouring segments
// never share a colour, so a launch may read and write the same array.
#pragma once

#include "fast/kernels/kinds/kinds.hpp"

namespace ogc::fast {

/// Returns the quaternion as Hsu et al. 2025 compute it: the unit vector along (μ + M) b with μ = σ + ‖b‖.
/// compare/rods.md defines M and σ.
OGC_HD inline Quat published_orientation(float stretch, const Vec& apart, const Vec& direction, const Quat& b,
                                         const Quat& old) {
  const float length = sqrtf(dot(apart, apart)), size = sqrtf(dot(direction, direction)), pull = sqrtf(dot(b, b));
  const float sigma = 2.0f * stretch * length * size;
  if (!(sigma > 0 && pull > 0)) return rod_orientation(stretch, apart, direction, b, old);
  const ReflectedFrame frame{pure((1.0f / length) * apart), pure((1.0f / size) * direction)};
  const Quat q = (sigma + pull) * b + sigma * frame(b);
  return dot(q, q) > 0 ? unit(q) : nearest_upper(frame, old);
}

/// Updates the free segments of a colour. Runs once for each of these segments.
struct UpdateSegment {
  /// Holds data that a thread may read before the preceding launch has ended, because that launch does not write them.
  struct Ahead {
    SegmentSlot slot;
    bool is_off = false;  ///< whether this iteration must do nothing, because another one is next
  };

  SweepView view;
  int first_slot = 0;      ///< first slot of the colour
  bool asks_late = false;  ///< true: the preceding launch may still change the turn

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
