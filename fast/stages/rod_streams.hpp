// Segments in the order of the sweep: streams made once on the host, and the launches before the vertices' of an
// iteration. A scene without rods has none of them.
#pragma once

#include <algorithm>
#include <vector>

#include "fast/kernels/sweep/update_segment.hpp"
#include "fast/stages/backend.hpp"
#include "fast/stages/colouring.hpp"
#include "fast/stages/rest_state.hpp"

namespace ogc::fast {

/// On the host.
struct RodStreams {
  std::vector<RodRow> rows;              ///< by slot of the vertices; empty where there is no rod
  std::vector<RodIncidence> incidences;  ///< row by row
  std::vector<SegmentSlot> slots;        ///< the free segments, colour by colour
  std::vector<float> damping;            ///< by body: k_d/h [1]; empty where none damps
};

/// A rod's k_d/h by body; empty where it is 0 everywhere.
inline std::vector<float> rod_damping(const RestState& rest) {
  std::vector<float> damping(rest.materials.size(), 0.0f);
  for (std::size_t e = 0; e < rest.rods.segments.size(); ++e)
    damping[static_cast<std::size_t>(rest.rods.body[e])] = rest.rods.segments[e].damping;
  const bool any = std::any_of(damping.begin(), damping.end(), [](float k) { return k > 0; });
  return any ? damping : std::vector<float>{};
}

/// Segments within a row ascend.
inline RodStreams rod_streams(const RestState& rest, const Colouring& vertices, const Colouring& segments) {
  RodStreams streams;
  const RodsAtRest& rods = rest.rods;
  if (rods.empty()) return streams;
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  std::vector<std::vector<int>> around(rest.mass.size());
  for (int e = 0; e < static_cast<int>(rods.segments.size()); ++e)
    for (const int v : rods.segments[at(e)].end) around[at(v)].push_back(e);
  for (const int v : vertices.order) {
    streams.rows.push_back({static_cast<int>(streams.incidences.size()), static_cast<int>(around[at(v)].size())});
    for (const int e : around[at(v)]) {
      const SegmentRest& segment = rods.segments[at(e)];
      const int end = segment.end[0] == v ? 0 : 1, other = segment.end[1 - end];
      const bool is_lower = vertices.colour[at(other)] < vertices.colour[at(v)];
      streams.incidences.push_back({is_lower ? ~other : other, end == 0 ? e : ~e, segment.length, segment.stretch});
    }
  }
  for (const int e : segments.order) {
    SegmentSlot slot{rods.segments[at(e)], e, rods.neighbours[at(e)]};
    for (int& v : slot.rest.end)
      if (vertices.colour[at(v)] < 0) v = ~v;
    streams.slots.push_back(slot);
  }
  streams.damping = rod_damping(rest);
  return streams;
}

/// On the backend.
template <class Backend>
class RodSweep {
 public:
  /// `segments`: colours of the segments (colour_segments).
  RodSweep(const RestState& rest, const Colouring& vertices, const Colouring& segments,
           const compare::Settings& settings)
      : colour_begin_(segments.begin),
        is_damped_by_vertex_(!damps_strain(settings.damping)),
        as_published_(!minimises(settings.orientation)) {
    const RodStreams streams = rod_streams(rest, vertices, segments);
    rows_.upload(streams.rows.data(), streams.rows.size());
    incidences_.upload(streams.incidences.data(), streams.incidences.size());
    slots_.upload(streams.slots.data(), streams.slots.size());
    damping_.upload(streams.damping.data(), streams.damping.size());
  }

  bool is_used() const { return rows_.size() > 0; }  ///< whether there are free vertices and rods
  int colours() const { return static_cast<int>(colour_begin_.size()) - 1; }  ///< launches of an iteration

  /// The streams; quaternions and directions are the caller's.
  void complete(RodStream& rods) const {
    rods.rows = rows_.data();
    rods.incidences = incidences_.data();
    rods.slots = slots_.data();
    rods.damping = damping_.data();
    rods.is_damped_by_vertex = is_damped_by_vertex_;
    rods.as_published = as_published_;
  }

  /// All free segments, colour by colour; after the prescribed vertices, before the free ones. `is_first`: nothing of
  /// the iteration stands before them.
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
  Buffer<RodRow> rows_;
  Buffer<RodIncidence> incidences_;
  Buffer<SegmentSlot> slots_;
  Buffer<float> damping_;
};

}  // namespace ogc::fast
