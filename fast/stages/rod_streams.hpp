// Holds segments in the order of the sweep, which the host makes once. Launches the updates of segments, which precede
// the updates of vertices in an iteration. Without rods, there is no segment and no launch.
#pragma once

#include <vector>

#include "fast/kernels/sweep/update_segment.hpp"
#include "fast/stages/backend.hpp"
#include "fast/stages/colouring.hpp"
#include "fast/stages/rest_state.hpp"

namespace ogc::fast {

/// Returns the free segments in the order of their colours. If an end is not a free vertex, its index v is stored as
/// ~v, so that the sweep reads the new position of this end.
inline std::vector<SegmentSlot> segment_slots(const RodsAtRest& rods, const Colouring& vertices,
                                              const Colouring& segments) {
  std::vector<SegmentSlot> slots;
  for (const int e : segments.order) {
    SegmentSlot slot{rods.segments[as_index(e)], e, rods.neighbours[as_index(e)]};
    for (int& v : slot.rest.end)
      if (vertices.colour[as_index(v)] < 0) v = ~v;
    slots.push_back(slot);
  }
  return slots;
}

/// Holds the free segments on the backend and launches their updates.
template <class Backend>
class RodSweep {
 public:
  /// `segments`: colours of the segments (colour_segments).
  RodSweep(const RestState& rest, const Colouring& vertices, const Colouring& segments,
           const compare::Settings& settings)
      : colour_begin_(segments.begin),
        is_damped_by_vertex_(!damps_strain(settings.damping)),
        as_published_(!minimises(settings.rod_orientation)) {
    const std::vector<SegmentSlot> slots = segment_slots(rest.rods, vertices, segments);
    slots_.upload(slots.data(), slots.size());
  }

  int colours() const { return static_cast<int>(colour_begin_.size()) - 1; }  ///< number of launches of an iteration

  /// Puts the free segments into a view; the caller sets quaternions and directions.
  void complete(RodStream& rods) const {
    rods.slots = slots_.data();
    rods.is_damped_by_vertex = is_damped_by_vertex_;
    rods.as_published = as_published_;
  }

  /// Updates all free segments, colour by colour, after the prescribed and before the free vertices. `is_first`: no
  /// launch of the iteration precedes these updates.
  void enqueue(Backend& backend, const SweepView& view, bool is_first) const {
    for (std::size_t c = 0; c + 1 < colour_begin_.size(); ++c)
      backend.for_each(colour_begin_[c + 1] - colour_begin_[c],
                       UpdateSegment{view, colour_begin_[c], is_first && c == 0});
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  std::vector<int> colour_begin_;
  bool is_damped_by_vertex_, as_published_;
  Buffer<SegmentSlot> slots_;
};

}  // namespace ogc::fast
