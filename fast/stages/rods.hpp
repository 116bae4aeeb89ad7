// Holds the orientations qᵗ and q of a simulation's segments. Rotates them at the start of a step, commits them at its
// end, and sums what the step's row reports on rods. Without rods, the arrays are empty and nothing is launched.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "compare/problem/scene.hpp"
#include "fast/kernels/rods/turn.hpp"
#include "fast/kernels/sums/rod_sums.hpp"
#include "fast/stages/backend.hpp"
#include "fast/stages/rest_state.hpp"
#include "fast/stages/rod_streams.hpp"

namespace ogc::fast {

/// Returns the scene's orientations at the start. If the scene gives none, each orientation at rest is rotated from its
/// segment's direction at rest to the direction at the start.
std::vector<Quat> start_orientations(const compare::Scene& scene, const RodsAtRest& rods);

/// Returns rotations indexed [step][motion] for `steps` steps from step number `first`, counted from 0. A quaternion
/// with w = 2 marks a motion that defines no rotation.
std::vector<Quat> motion_turns(const compare::Scene& scene, std::int64_t first, int steps);

/// Holds the resident rods of one scene.
template <class Backend>
class Rods {
 public:
  /// `longest_frame`: number of steps for which motions' rotations are uploaded ahead.
  Rods(const compare::Scene& scene, const RestState& rest, int longest_frame)
      : scene_(scene),
        count_(static_cast<int>(rest.rods.segments.size())),
        motions_(static_cast<int>(scene.motions.size())),
        turns_(turns(scene.settings.rod_start)) {
    if (!is_used()) return;
    segments_.upload(rest.rods.segments.data(), rest.rods.segments.size());
    neighbours_.upload(rest.rods.neighbours.data(), rest.rods.neighbours.size());
    motion_.upload(rest.rods.motion.data(), rest.rods.motion.size());
    orientation_.resize(segments_.size());
    motion_turns_.resize(static_cast<std::size_t>(std::max(1, longest_frame * motions_)));
    if (!at_rest<SegmentKind>(rest).by_body(rest).empty() && damps_strain(scene.settings.damping))
      direction_.resize(segments_.size());
    put(start_orientations(scene, rest.rods));
  }

  bool is_used() const { return count_ > 0; }  ///< whether the scene has rods
  int count() const { return count_; }         ///< number of segments

  /// Host only: sets qᵗ.
  void put(const std::vector<Quat>& orientations) {
    if (is_used()) orientation_start_.upload(orientations.data(), orientations.size());
  }
  /// Host only: return qᵗ, and q of the step.
  std::vector<compare::Quaternion> start() const { return downloaded(orientation_start_); }
  std::vector<compare::Quaternion> now() const { return downloaded(orientation_); }

  /// Host only: uploads the motions' rotations in `steps` steps from step `first` on, counted from 0.
  void upload_turns(std::int64_t first, int steps) {
    if (!is_used() || motions_ == 0) return;
    const std::vector<Quat> turns = motion_turns(scene_, first, steps);
    motion_turns_.upload(turns.data(), turns.size());
  }

  /// Returns the functor, over segments, that runs after the guess loop. It sets q to qᵗ, rotated as the segment
  /// rotates from xᵗ to x.
  TurnSegment begin(const Vec* start, const Vec* position, const StepControl* control) {
    return {.segments = segments_.data(),
            .motion = motion_.data(),
            .motion_turns = motion_turns_.data(),
            .motions = motions_,
            .start = start,
            .position = position,
            .orientation_start = orientation_start_.data(),
            .orientation = orientation_.data(),
            .turns = turns_,
            .control = control};
  }

  /// Computes the vector c of rod_rest_direction for each segment at the start of a step, if strains are damped.
  void begin_strains(Backend& backend, const Vec* start) {
    if (direction_.size() == 0) return;
    backend.for_each(count_, SetDirection{segments_.data(), start, orientation_start_.data(), direction_.data()});
  }

  /// Puts orientations and directions into the sweep's view.
  void complete(RodStream& rods) {
    rods.orientation = orientation_.data();
    rods.orientation_start = orientation_start_.data();
    rods.direction = direction_.data();
  }

  /// Returns the functor that computes the sums at the end of a step: `others`, and the sums over rods for the step's
  /// row.
  template <class Others>
  RodSums<Others> sums(const Others& others, const ContactView& contacts, const ContactTables& tables,
                       const Vec* position, float contact_radius, StepControl* control) {
    return {.others = others,
            .segment = {segments_.data(), neighbours_.data(), position, orientation_.data()},
            .segments = count_,
            .vertex_facet = {contacts.vertex_facet, tables, position, contact_radius},
            .edge_edge = {contacts.edge_edge, tables, position, contact_radius},
            .vertex_facet_count = contacts.vertex_facet_count,
            .edge_edge_count = contacts.edge_edge_count,
            .control = control};
  }

  /// Returns the functor, over segments, that sets qᵗ = q if the step is clean.
  CommitSegment commit(const StepControl* control) { return {orientation_.data(), control, orientation_start_.data()}; }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  std::vector<compare::Quaternion> downloaded(const Buffer<Quat>& buffer) const {
    std::vector<Quat> from(static_cast<std::size_t>(count_));
    if (is_used()) buffer.download(from.data(), from.size());
    return quaternions(from);
  }

  const compare::Scene& scene_;
  int count_, motions_;
  bool turns_;
  Buffer<SegmentRest> segments_;
  Buffer<SegmentNeighbours> neighbours_;
  Buffer<int> motion_;
  Buffer<Quat> orientation_start_, orientation_;
  typename Backend::template Shared<Quat> motion_turns_;
  Buffer<Vec> direction_;
};

}  // namespace ogc::fast
