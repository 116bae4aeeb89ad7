// Runs a guard on one backend: detections about the state X_prev, and steps within the regions that they leave.
//
//   detect         X_prev ← state; sorts trees, detects, and repeats this with larger lists until all pairs have room
//   step_resident  detects if it is due, then
//                    Propose      p ← positions + moves, from the caller's memory
//                    KeepInside   next ← p, truncated; a copy goes to the caller's memory
//                    GuardSums    adds the vertices' terms, in an order that depends on the number of vertices only
//                  and reads the row of the report, for which the host waits
//
// `positions` and `moves` are read by Propose alone, and `out` is written later, so that `out` may be either of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "fast/guard.hpp"
#include "fast/kernels/guard.hpp"
#include "fast/probes/download.hpp"
#include "fast/stages/detection.hpp"
#include "fast/stages/reduce.hpp"

namespace ogc::fast {

/// Runs a guard on one backend.
template <class Backend>
class BackendGuardEngine : public GuardEngine {
 public:
  /// The mesh and the options are read here only; `backend` must outlive the engine. Nothing else may be called before
  /// `reset` or `reset_resident`.
  BackendGuardEngine(Backend& backend, const Mesh& mesh, const GuardOptions& options)
      : backend_(backend),
        options_(options),
        vertices_(mesh.vertex_count()),
        detection_(backend, mesh.topology(), mesh.exclusions(), 0, options.bounds,
                   std::vector<std::uint8_t>(count(), 0)),
        sums_(backend, vertices_) {
    for (Buffer<Vec>* by_vertex : {&state_, &next_, &previous_, &proposal_}) by_vertex->resize(count());
    terms_.resize(count());
    row_.resize(1);
    query_radius_.upload(&options.query_radius, 1);
  }

  void reset(std::span<const compare::Vec3f> positions) override {
    state_.upload(as_vec(positions.data()), count());
    detect();
  }

  void reset_resident(const compare::Vec3f* positions) override {
    copy(as_vec(positions), state_.data());
    detect();
  }

  void detect() override {
    cut_ = due;
    copy(state_.data(), previous_.data());
    detection_.rebuild(previous_.data());
    do {
      // Limits of searches never fall below the square of the contact radius, so it must not underflow.
      detection_.detect(previous_.data(), std::max(options_.contact_radius, least_radius), query_radius_.data(),
                        options_.bounds_relaxation);
      backend_.synchronize();
    } while (detection_.grow());
    cut_ = 0;
  }

  GuardReport step(std::span<const compare::Vec3f> positions, std::span<const compare::Vec3f> moves,
                   std::span<compare::Vec3f> out) override {
    positions_.upload(as_vec(positions.data()), count());
    moves_.upload(as_vec(moves.data()), count());
    // KeepInside writes the caller's copy over the positions, which have been read by then.
    const GuardReport report = move(positions_.data(), moves_.data(), positions_.data());
    state_.download(reinterpret_cast<Vec*>(out.data()), count());
    return report;
  }

  GuardReport step_resident(const compare::Vec3f* positions, const compare::Vec3f* moves,
                            compare::Vec3f* out) override {
    return move(as_vec(positions), as_vec(moves), reinterpret_cast<Vec*>(out));
  }

  std::vector<compare::Vec3f> positions() override { return download_positions(backend_, state_.data(), count()); }
  const compare::Vec3f* positions_resident() const override {
    return reinterpret_cast<const compare::Vec3f*>(state_.data());
  }
  int device_number() const override { return backend_.device(); }
  void wait_for_device() override { backend_.synchronize_device(); }
  ContactView contacts() override { return detection_.view(); }
  const compare::Vec3f* detected_at_resident() const override {
    return reinterpret_cast<const compare::Vec3f*>(previous_.data());
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;
  /// Value of cut_ while no detection is complete: if one throws, the next step begins with another one.
  static constexpr std::int64_t due = std::numeric_limits<std::int64_t>::max();

  static const Vec* as_vec(const compare::Vec3f* a) { return reinterpret_cast<const Vec*>(a); }
  std::size_t count() const { return static_cast<std::size_t>(vertices_); }
  void copy(const Vec* from, Vec* to) { backend_.for_each(vertices_, CopyItems<Vec>{from, to}); }

  /// Returns whether the steps since the last detection cut so many vertices that another one is due.
  bool is_due() const {
    return cut_ > 0 && static_cast<double>(cut_) >= options_.detection_fraction * static_cast<double>(vertices_);
  }

  GuardReport move(const Vec* positions, const Vec* moves, Vec* out) {
    GuardReport report;
    report.detected = is_due();
    if (report.detected) detect();
    if (vertices_ == 0) return report;
    backend_.for_each(vertices_, Propose{positions, moves, proposal_.data(), row_.data()});
    const KeepInside keep{.proposal = proposal_.data(),
                          .current = state_.data(),
                          .regions = detection_.regions(previous_.data()),
                          .next = next_.data(),
                          .out = out,
                          .terms = terms_.data(),
                          .row = row_.data()};
    if (keep.regions.has_planes())
      backend_.template for_each_group<most_planes>(vertices_, keep);
    else
      backend_.for_each(vertices_, keep);
    sums_.template add<0, guard_columns>(GuardSums{terms_.data(), vertices_}, 0, Nothing{});
    sums_.total(row_.data()->sums, 0, Nothing{}, 0, Nothing{});
    backend_.synchronize();
    std::swap(state_, next_);
    GuardRow row;
    row_.download(&row, 1);
    fill(report, row);
    cut_ += report.cut;
    return report;
  }

  static void fill(GuardReport& report, const GuardRow& row) {
    const double asked = row.sums[guard_asked];
    report.cut = static_cast<compare::Index>(row.sums[guard_cut]);
    report.not_finite = static_cast<compare::Index>(row.sums[guard_not_finite]);
    report.asked = asked;
    if (asked > 0) {
      report.lost = row.sums[guard_lost] / asked;
      report.lost_normal = row.sums[guard_normal] / asked;
      report.lost_tangential = row.sums[guard_tangential] / asked;
    }
    if (row.most_restricted == 0) return;
    report.most_restricted = static_cast<compare::Index>(~static_cast<std::uint32_t>(row.most_restricted));
    report.most_lost = float_from_bits(static_cast<int>(row.most_restricted >> 32));
  }

  Backend& backend_;
  GuardOptions options_;
  int vertices_;
  Detection<Backend> detection_;
  Reduction<Backend, guard_columns> sums_;
  Buffer<Vec> state_, next_, previous_;       ///< by vertex [m]; previous_: X_prev
  Buffer<Vec> proposal_, positions_, moves_;  ///< by vertex [m]; the last two: the caller's, from the host
  Buffer<GuardTerm> terms_;                   ///< by vertex
  Buffer<GuardRow> row_;                      ///< one item
  Buffer<float> query_radius_;                ///< one item [m]
  std::int64_t cut_ = due;                    ///< vertices that the steps since the last detection cut
};

}  // namespace ogc::fast
