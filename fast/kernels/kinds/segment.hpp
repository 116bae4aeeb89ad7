// Adds segments of rods to the sums of the sweep.
#pragma once

#include "fast/kernels/kinds/kind.hpp"
#include "fast/kernels/rods/segments.hpp"

namespace ogc::fast {

/// Holds the data of rods that the sweep reads and writes: the stream of segments by vertex, and the segments'
/// quaternions.
struct RodStream : StreamView<RodIncidence, NoData, NoData, float, true> {  // float: k_d/h of a body [1]
  const SegmentSlot* slots = nullptr;  ///< free segments, in the order of their colours
  /// by segment: direction c of rod_rest_direction; null if no segment has damping of strains
  const Vec* direction = nullptr;
  const Quat* orientation_start = nullptr;  ///< by segment: qᵗ
  Quat* orientation = nullptr;              ///< by segment: q
  bool is_damped_by_vertex = false;         ///< DampingForm::per_vertex
  bool as_published = false;  ///< true: quaternions are updated as Hsu et al. 2025 do (published_orientation)
};

template <bool is_there>
struct AnySegments;
using Segments = AnySegments<false>;

/// The kind of rod segments. fast/kernels/sums/rod_sums.hpp sums their energy, together with the largest stretch and
/// the smallest contact distance.
struct SegmentKind : ElementKind<SegmentRest, RodIncidence> {
  using Whole = Segments;
  using ByBody = float;
  /// The members of SweepView that this kind adds.
  struct View {
    RodStream rods;
  };
  static constexpr bool is_curve = true;
  /// Floating-point operations of a segment at one end, term by term (fast/kernels/models/rod.hpp): difference 3,
  /// division by the length 5, rotated director 30, strain 3, force 6, block 4.
  static constexpr double flop = 51;

  template <class AnyView>
  OGC_HD static auto& stream(AnyView& view) {
    return view.rods;
  }
  static int count(const SegmentRest&) { return 2; }
  static const int* vertices(const SegmentRest& rest) { return rest.end; }
  static RodIncidence seen(const SegmentRest& rest, int segment, int end, const ColourOrder& encoded) {
    return {encoded(rest.end[1 - end]), end == 0 ? segment : ~segment, rest.length, rest.stretch};
  }
};

/// Returns the direction c of rod_rest_direction for a segment; e₃ if no segment has damping of strains.
OGC_HD inline Vec segment_direction(const RodStream& rods, int segment) {
  return rods.direction != nullptr ? rods.direction[segment] : Vec{0.0f, 0.0f, 1.0f};
}

/// Adds the force and block of a segment on one of its ends.
struct AddRod {
  const SweepShared& view;
  const RodStream& rods;
  OwnVertex own;
  float damping;  ///< k_d/h of the vertex's body [1]

  OGC_HD void operator()(const RodIncidence& seen, ForceAndBlock& sum) const {
    const int segment = decoded(seen.segment), end = seen.segment < 0 ? 1 : 0;
    const Vec away = view.read(seen.other) - own.position, apart = end == 0 ? away : -1.0f * away;
    const SegmentRest rest{{}, seen.length, seen.stretch, 0.0f};
    const Quat q = rods.orientation[segment];
    const Vec direction = segment_direction(rods, segment);
    if (!rods.is_damped_by_vertex) return add_rod(rest, damping, end, apart, q, direction, sum);
    ForceAndBlock elastic;
    add_rod(rest, 0.0f, end, apart, q, direction, elastic);
    add_damped_by_vertex(elastic, damping, own.moved, sum);
  }
};

/// Makes the part of a vertex's sum that adds segments with any form of damping. `is_there`: the scene is known to have
/// segments.
template <bool is_there>
struct AnySegments {
  template <class All>
  static constexpr unsigned gives = All::template bit<SegmentKind> | asks_any_model;

  template <class View>
  OGC_HD static Part<LoadFrom<RodIncidence>, AddRod> part_of(const View& view, int slot, const SweepVertex& vertex,
                                                             const OwnVertex& own) {
    const Row row = row_of<SegmentKind, is_there>(view, slot, vertex);
    const float damping = view.rods.by_body != nullptr ? view.rods.by_body[vertex.body] : 0.0f;
    return {row.count, {view.rods.incidences + row.begin}, {view, view.rods, own, damping}};
  }
};
using UsualSegments = AnySegments<true>;

}  // namespace ogc::fast
