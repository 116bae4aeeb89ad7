// Keeps a simulation's state on the backend. The host enqueues a frame of steps at once and reads the frame's rows
// once. It acts between frames only: if a step found a list too small, the host grows the lists and repeats that step.
// Two rules make that rare. Before the first step a detection counts what it needs, until the lists have room. And a
// step after which a list is nearly full ends its frame, so that the host makes room. Both depend on the state alone,
// not on the frames, so a resumed run has the same rows.
#pragma once

#include <algorithm>
#include <chrono>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/way.hpp"
#include "fast/kernels/frame.hpp"
#include "fast/resident_state.hpp"
#include "fast/stages/parts.hpp"
#include "fast/stages/step.hpp"
#include "fast/stages/way.hpp"

namespace ogc::fast {

/// Whether the simulations of several backends share launches. Then no simulation counts its contacts first.
template <class Backend>
constexpr bool shares_launches() {
  if constexpr (requires { Backend::shares_launches; }) return Backend::shares_launches;
  return false;
}

/// The simulation of one scene.
template <class Backend>
class ResidentSimulation : public compare::Simulation, public compare::WayTeller, public ResidentState {
 public:
  /// `device` is the result of device(). `list_capacity`: number of contacts for which the lists have room at first; 0:
  /// what the first detection needs. Lists grow by themselves. `hall`, `part`: see Parts.
  ResidentSimulation(Backend backend, const compare::Scene& scene, const compare::SimulationOptions& options,
                     std::string device, int list_capacity = 0, std::shared_ptr<Hall> hall = nullptr, int part = 0)
      : backend_(std::move(backend)),
        device_(std::move(device)),
        scene_(rounded(scene)),
        topology_(compare::build_topology(scene_)),
        rest_(build_rest_state(scene_, topology_)),
        colouring_(colour_vertices(rest_)),
        exclusions_(compare::exclusions(scene_)),
        detection_(backend_, topology_, exclusions_, list_capacity, scene_.settings.bounds, fixed_vertices()),
        segment_colouring_(colour_segments(rest_.rods)),
        sweep_(backend_, rest_, colouring_, topology_, scene_, segment_colouring_),
        volumes_(detection_.surface(), volume_parts(scene_, topology_),
                 solid_tables(topology_, volume_tetrahedra(scene_)), asker_rows(scene_, topology_, colouring_.order),
                 sweep_.slots(), sweep_.colour()),
        rods_(scene_, rest_, longest_frame),
        parts_(backend_, std::move(hall), part, colouring_, rest_),
        clock_(backend_, options.profile, options.iterations),
        moving_(static_cast<std::size_t>(compare::bounded_count(topology_, exclusions_.groups))),
        step_(backend_, state_, detection_, sweep_, volumes_, rods_, parts_, clock_,
              step_settings(scene_, moving_, options.energies), static_cast<int>(rest_.mass.size())),
        energies_(options.energies),
        counts_first_(list_capacity == 0) {
    detection_.number_rows(sweep_.row_places());
    detection_.divide(parts_);
    fill_state();
    reserve();
    const std::vector<compare::Vec3f> positions = compare::to_single(scene_.mesh.positions),
                                      velocities = compare::to_single(scene_.velocities);
    begin_at(positions, velocities);
  }

  std::vector<compare::StepMetrics> advance(std::int64_t steps) override {
    std::vector<compare::StepMetrics> rows;
    if (steps <= 0) return rows;
    do {
      begin_frame(steps - static_cast<std::int64_t>(rows.size()));
    } while (end_frame(rows) && static_cast<std::int64_t>(rows.size()) < steps);
    return rows;
  }

  /// Enqueues a frame of up to `steps` steps; end_frame must follow.
  void begin_frame(std::int64_t steps) {
    const int count = static_cast<int>(std::min<std::int64_t>(steps, longest_frame));
    upload_targets(count);
    backend_.for_each(1, BeginFrame{state_.control.data(), since_sort_});
    enqueue(count);
    backend_.for_each(1, EndFrame{state_.control.data(), report_.data()});
  }
  /// Waits for the frame. Appends a row for each completed step and for a step that failed. Grows lists that were too
  /// small, so that the next frame repeats a step. Returns false if a step failed for another reason, after which no
  /// step follows until restore().
  bool end_frame(std::vector<compare::StepMetrics>& rows) {
    const StepControl control = collect(rows);
    if ((control.status & (compare::step_not_finite | compare::step_bound_violated)) != 0) return false;
    if (control.status == 0) {
      if (control.short_of_room == 0) return true;
      parts_.wait();  // another part may still read this one's lists
      if (detection_.make_room()) lists_moved();
      publish();
      return true;
    }
    parts_.wait();
    grow();
    publish();
    ++repeats_;
    return true;
  }

  std::vector<compare::StepMetrics> advance_telling(std::vector<std::vector<compare::Vec3f>>& states) override {
    WayRecorder<Backend> recorder(backend_, state_);
    observe(&recorder);
    std::vector<compare::StepMetrics> rows = advance(1);
    observe(nullptr);
    states = recorder.take();
    return rows;
  }

  compare::Snapshot snapshot() override {
    compare::Snapshot result;
    result.step = step_number_;
    result.positions = positions();
    result.velocities = velocities();
    result.previous = downloaded(state_.previous);
    result.bounds = last_bounds();
    result.query_radius = query_radius_;
    result.capacities = detection_.capacities();
    for (const std::int64_t capacity : volumes_.capacities()) result.capacities.push_back(capacity);
    result.planes = detection_.download_planes();
    result.orientations = rods_.start();
    result.search_limits = detection_.search_limits(state_.start.data());
    return result;
  }

  void restore(const compare::Snapshot& snapshot) override {
    step_number_ = snapshot.step;
    rods_.put(orientations_of(snapshot));
    if (snapshot.capacities.empty()) return begin_at(snapshot.positions, snapshot.velocities);
    upload_motion(snapshot.positions, snapshot.velocities);
    std::vector<std::int64_t> capacities = snapshot.capacities;
    const std::size_t of_volumes = volumes_.capacities().size();
    if (capacities.size() < of_volumes) throw std::invalid_argument("capacities of other lists");
    volumes_.reserve(std::span(capacities).last(of_volumes));
    capacities.resize(capacities.size() - of_volumes);
    detection_.reserve(capacities);
    detection_.put_search_limits(snapshot.search_limits);
    lists_moved();
    publish();
  }

  const compare::Vec3f* positions_resident() const override { return rows_of(state_.start); }
  const compare::Vec3f* velocities_resident() const override { return rows_of(state_.velocity); }
  std::vector<compare::Vec3f> positions() const override { return downloaded(state_.start); }
  std::vector<compare::Vec3f> velocities() const override { return downloaded(state_.velocity); }
  int device_number() const override { return backend_.device(); }
  void wait_for_device() override { backend_.synchronize_device(); }

  std::vector<std::string> stage_names() const override {
    return clock_.on() ? step_stage_names() : std::vector<std::string>{};
  }
  std::string device() const override { return device_; }

  /// Return data that the host computed at the start from the scene rounded to single precision.
  const Colouring& colouring() const { return colouring_; }
  const Colouring& segment_colouring() const { return segment_colouring_; }
  const RestState& rest_state() const { return rest_; }
  /// Returns W, the width of the sweep's sums.
  int lanes() const { return sweep_.lanes(); }

  /// Sets the observer of the following steps; null removes it. It changes no bit of the results. An observed step is
  /// enqueued launch by launch, not replayed from a recording.
  void observe(StepObserver* observer) { step_.observe(observer); }
  float query_radius() const { return query_radius_; }  ///< r_q of the last step [m]
  /// Return objects for the observer, to be used between launches only. Any change to these objects changes the run.
  Backend& backend() { return backend_; }
  StepState<Backend>& state() { return state_; }
  Detection<Backend>& detection() { return detection_; }
  Volumes<Backend>& volumes() { return volumes_; }
  Rods<Backend>& rods() { return rods_; }
  Sweep<Backend>& sweep() { return sweep_; }
  const compare::Scene& scene() const { return scene_; }
  const compare::Topology& topology() const { return topology_; }
  Step<Backend>& step() { return step_; }

 private:
  static constexpr int longest_frame = 64;  // keeps rows and targets of a frame small; longer requests are split

  static compare::Scene rounded(compare::Scene scene) {
    compare::round_to_single(scene);
    return scene;
  }

  template <class T>
  static void upload(typename Backend::template Buffer<T>& buffer, const std::vector<T>& items) {
    buffer.resize(items.size());
    buffer.upload(items.data(), items.size());
  }
  static std::vector<Vec> vectors(const std::vector<compare::Vec3f>& from) {
    std::vector<Vec> to;
    to.reserve(from.size());
    for (const compare::Vec3f& a : from) to.push_back({a.x, a.y, a.z});
    return to;
  }
  static_assert(sizeof(Vec) == sizeof(compare::Vec3f) && std::is_standard_layout_v<Vec>, "read as each other");
  static const compare::Vec3f* rows_of(const typename Backend::template Buffer<Vec>& buffer) {
    return reinterpret_cast<const compare::Vec3f*>(buffer.data());
  }
  static std::vector<compare::Vec3f> downloaded(const typename Backend::template Buffer<Vec>& buffer) {
    std::vector<compare::Vec3f> to(buffer.size());
    buffer.download(reinterpret_cast<Vec*>(to.data()), to.size());
    return to;
  }

  std::vector<std::uint8_t> fixed_vertices() const {
    std::vector<std::uint8_t> fixed;
    for (const Mobility m : rest_.mobility) fixed.push_back(m == Mobility::fixed ? 1 : 0);
    return fixed;
  }

  void fill_state() {
    StepState<Backend>& s = state_;
    const std::size_t n = rest_.mass.size();
    s.vertex_count = static_cast<int>(n);
    for (auto* buffer : {&s.target, &s.previous, &s.position}) buffer->resize(n);
    s.taken.resize(2 * n);
    if (traits_of(scene_.settings.bounds).divides) {
      s.displacement.resize(n);
      detection_.divide_planes_by(s.displacement.data());
    }
    s.padded_start.resize(n);
    s.padded.resize(2 * n);
    s.sums.resize(guess_columns + sum_columns);
    s.control.resize(1);
    report_.resize(1);
    s.rows.resize(longest_frame);
    upload(s.mass, rest_.mass);
    std::vector<int> number(n);
    for (std::size_t v = 0; v < n; ++v) number[v] = rest_.mobility[v] == Mobility::fixed ? -2 : -1;
    for (const compare::PrescribedMotion& motion : scene_.motions) {
      for (const compare::Index v : motion.vertices) number[static_cast<std::size_t>(v)] = s.prescribed_count++;
    }
    upload(s.prescribed_number, number);
    if (volumes_.is_used()) {
      std::vector<std::uint8_t> is_driven(n);
      for (std::size_t v = 0; v < n; ++v)
        is_driven[v] = number[v] >= 0 && scene_.bodies[static_cast<std::size_t>(rest_.body[v])].is_volume() ? 1 : 0;
      upload(s.is_driven_volume, is_driven);
    }
    s.prescribed_targets.resize(static_cast<std::size_t>(longest_frame) * static_cast<std::size_t>(s.prescribed_count));
  }

  void upload_motion(const std::vector<compare::Vec3f>& positions, const std::vector<compare::Vec3f>& velocities) {
    const std::vector<Vec> x = vectors(positions);
    for (auto* buffer : {&state_.start, &state_.position, &state_.previous}) upload(*buffer, x);
    upload(state_.velocity, vectors(velocities));
    backend_.synchronize_device();  // a copy to a device may return before its end, which other streams do not wait for
  }

  /// Uploads a state from which no step was computed yet, and sizes the lists for its first step.
  void begin_at(const std::vector<compare::Vec3f>& positions, const std::vector<compare::Vec3f>& velocities) {
    upload_motion(positions, velocities);
    if constexpr (!shares_launches<Backend>()) {
      if (!counts_first_) return publish();
      count_contacts();
      upload_motion(positions, velocities);
    }
  }

  /// Repeats the first detection of the next step until it finds room. Then forgets what it found.
  void count_contacts() {
    upload_targets(1);
    do {
      lists_moved();
      publish();
      backend_.for_each(1, BeginFrame{state_.control.data(), since_sort_});
      step_.enqueue_first_detection();
      backend_.synchronize();
      parts_.wait();  // another part may still read this one's lists
    } while (detection_.grow());
    lists_moved();
    publish();
    detection_.forget();
    clock_.take();
  }

  void upload_targets(int count) {
    std::vector<Vec> targets;
    for (int k = 1; k <= count; ++k) {
      const double t = static_cast<double>(step_number_ + k) * scene_.settings.time_step;
      for (const compare::PrescribedMotion& motion : scene_.motions) {
        for (const compare::Vec3f& x : compare::prescribed_targets(scene_, motion, t))
          targets.push_back({x.x, x.y, x.z});
      }
    }
    if (!targets.empty()) state_.prescribed_targets.upload(targets.data(), targets.size());
    rods_.upload_turns(step_number_, count);
  }

  /// Tells the other parts where this part's arrays are.
  void publish() {
    PartArrays arrays;
    step_.publish(arrays);
    detection_.publish(arrays);
    parts_.publish(arrays);
  }

  /// Waits for a frame and adds its rows. Returns the control at its end.
  StepControl collect(std::vector<compare::StepMetrics>& rows) {
    backend_.synchronize();
    const std::vector<double> wall_ms = is_replayed() ? backend_.replay_milliseconds() : std::exchange(wall_ms_, {});
    const std::vector<std::vector<double>> stage_ms = std::exchange(stage_ms_, {});
    std::vector<EventEnds> ends = std::exchange(ends_, {});
    StepControl control;
    report_.download(&control, 1);
    since_sort_ = control.since_sort;
    const bool failed = (control.status & (compare::step_not_finite | compare::step_bound_violated)) != 0;
    std::vector<StepRow> device_rows(static_cast<std::size_t>(control.steps_done + (failed ? 1 : 0)));
    state_.rows.download(device_rows.data(), device_rows.size());
    for (int k = 0; k < control.steps_done + (failed ? 1 : 0); ++k) {
      const auto i = static_cast<std::size_t>(k);
      compare::StepMetrics row = metrics(device_rows[i], step_number_ + k + 1);
      row.wall_ms = wall_ms[i];
      if (clock_.on()) row.stage_ms = stage_ms[i];
      if (clock_.by_iteration()) {
        row.detection_ends_ms = std::move(ends[i].detections);
        row.iteration_ends_ms = std::move(ends[i].iterations);
      }
      row.repeats = std::exchange(repeats_, 0);
      if (row.repeats > 0) row.status |= compare::step_list_grew;
      rows.push_back(std::move(row));
    }
    std::int64_t redetections = 0, iterations = 0;
    for (int k = 0; k < control.steps_done; ++k) {
      const StepRow& row = device_rows[static_cast<std::size_t>(k)];
      redetections += row.detections - row.rounds;
      iterations += row.iterations;
    }
    if (control.steps_done > 0) group_ = iterations_in_group(redetections, iterations);
    step_number_ += control.steps_done;
    query_radius_ = control.query_radius;
    return control;
  }

  /// Enqueues steps. If the clock measures stages or an observer is set, steps are not replayed from a
  /// recording, so that the host can act between launches.
  void enqueue(int count) {
    if (is_replayed()) return replay(count);
    using Clock = std::chrono::steady_clock;
    for (int k = 0; k < count; ++k) {
      const Clock::time_point start = Clock::now();
      clock_.begin_step();
      step_.enqueue(clock_.by_iteration() ? 1 : group_, Sorting::asked, is_measured(step_number_ + k + 1));
      if (!clock_.on()) backend_.synchronize();
      wall_ms_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
      stage_ms_.push_back(clock_.take());
      ends_.push_back(clock_.take_ends());
    }
  }
  bool is_replayed() const { return !clock_.on() && !step_.is_observed(); }

  /// Returns whether the row of a step contains the forces that are left at the end of the step. This depends on the
  /// step's number alone, so a resumed run has the same rows.
  bool is_measured(std::int64_t step) const { return step % steps_between_measures(scene_.settings.iterations) == 0; }

  /// Replays steps. Each kind of step (sorts trees or not, measures forces or not) has a recording. The host counts the
  /// steps between sorts, as BeginStep does, because a decision on the device would cost each step the time of ten
  /// launches.
  void replay(int count) {
    for (int since = since_sort_, done = 0; done < count;) {
      const std::int64_t next = step_number_ + done + 1;
      const bool asks = Backend::has_free_branches, sorts = !asks && since >= steps_between_sorts,
                 measures = is_measured(next);
      const int group = asks ? 1 : group_;
      const Sorting sorting = asks ? Sorting::asked : sorts ? Sorting::made : Sorting::left_out;
      int times = 1;
      if (!sorts && !measures)
        while (done + times < count && (asks || since + times < steps_between_sorts) && !is_measured(next + times))
          ++times;
      backend_.replay(
          recordings_[sorts ? 1 : 0][measures ? 1 : 0][group > 1 ? 1 : 0], times,
          [=, this] { step_.enqueue(group, sorting, measures); }, &state_.control.data()->active);
      since = sorts ? 1 : since + times;
      done += times;
    }
  }

  compare::StepMetrics metrics(const StepRow& row, std::int64_t step) const {
    constexpr double not_asked = std::numeric_limits<double>::quiet_NaN();
    compare::StepMetrics result;
    result.step = step;
    result.vertex_facet_contacts = row.vertex_facet_contacts;
    result.edge_edge_contacts = row.edge_edge_contacts;
    result.broad_phases = result.discrete_detections = row.detections;
    result.guess_rounds = row.rounds;
    result.iterations = row.iterations;
    result.vertices_cut = row.cut_last;
    result.share_cut = moving_ > 0 ? static_cast<double>(row.cut_last) / static_cast<double>(moving_) : 0;
    result.momentum_lost_guess = row.lost_guess;
    result.momentum_lost_end = row.lost_end;
    result.largest_lag = row.largest_lag;
    result.query_radius = row.query_radius;
    result.residual = not_asked;
    result.kinetic_energy = energies_ ? row.kinetic : not_asked;
    result.elastic_energy = energies_ ? row.elastic : not_asked;
    result.contact_energy = energies_ ? row.contact : not_asked;
    result.gravity_energy = energies_ ? row.gravity : not_asked;
    result.last_motion = row.last_motion;
    const bool has_left = is_measured(step);
    result.left_residual = has_left ? row.left_residual : not_asked;
    result.left_rounding = has_left ? row.left_rounding : not_asked;
    result.left_held = has_left ? row.left_held : not_asked;
    result.inverted_tetrahedra = row.inverted;
    result.volume_contacts = row.volume_contacts;
    result.vertices_inside = row.vertices_inside;
    result.deepest = static_cast<double>(row.deepest);
    result.depth_unresolved = row.depth_unresolved;
    result.smallest_distance = traits_of(scene_.settings.bounds).has_planes
                                   ? row.smallest_bound
                                   : row.smallest_bound / scene_.settings.bounds_relaxation;
    if (rods_.is_used()) {
      const bool is_any = static_cast<double>(row.smallest_contact) < scene_.settings.contact_radius;
      result.smallest_contact_distance = is_any ? row.smallest_contact : not_asked;
      result.mean_stretch = row.mean_stretch;
      result.largest_stretch = row.largest_stretch;
    }
    result.status = static_cast<std::uint32_t>(row.status);
    return result;
  }

  /// Returns the orientations of a snapshot. If the snapshot has none, returns the scene's orientations at the start.
  /// Throws std::invalid_argument if the number of orientations is not that of the segments.
  std::vector<Quat> orientations_of(const compare::Snapshot& snapshot) const {
    if (snapshot.orientations.empty()) return start_orientations(scene_, rest_.rods);
    if (snapshot.orientations.size() != rest_.rods.segments.size())
      throw std::invalid_argument("orientations of other rods");
    return quats(snapshot.orientations);
  }

  void grow() {
    volumes_.grow();
    detection_.grow();
    lists_moved();
  }

  void reserve() {
    sweep_.reserve_contacts(detection_.capacity());
    parts_.reserve(detection_.capacity());
  }

  void lists_moved() {
    reserve();
    for (auto& of_sorts : recordings_)
      for (auto& of_measures : of_sorts)
        for (auto& recording : of_measures) recording.clear();
  }

  std::vector<float> last_bounds() {
    bounds_.resize(rest_.mass.size());
    backend_.for_each(state_.vertex_count, CopyBound{detection_.view().bound, bounds_.data()});
    backend_.synchronize();
    std::vector<float> result(rest_.mass.size());
    bounds_.download(result.data(), result.size());
    return result;
  }

  Backend backend_;
  std::string device_;
  compare::Scene scene_;
  compare::Topology topology_;
  RestState rest_;
  Colouring colouring_;
  compare::Exclusions exclusions_;
  Detection<Backend> detection_;
  Colouring segment_colouring_;
  Sweep<Backend> sweep_;
  Volumes<Backend> volumes_;
  Rods<Backend> rods_;
  Parts<Backend> parts_;
  StageClock<Backend> clock_;
  StepState<Backend> state_;
  std::size_t moving_;
  Step<Backend> step_;
  bool energies_;
  bool counts_first_;  ///< whether a detection before the first step sizes the lists
  /// [sorts trees][measures forces][groups iterations]
  typename Backend::Recording recordings_[2][2][2];
  typename Backend::template Buffer<float> bounds_;
  std::int64_t step_number_ = 0;
  float query_radius_ = 0;
  int since_sort_ = StepControl{}.since_sort;
  int group_ = iterations_in_group(0, 1);
  typename Backend::template Shared<StepControl> report_;  ///< the control at the end of a frame
  std::int64_t repeats_ = 0;                               ///< of the next step
  std::vector<double> wall_ms_;                            ///< of the frame's steps, if they are not replayed
  std::vector<std::vector<double>> stage_ms_;
  std::vector<EventEnds> ends_;
};

}  // namespace ogc::fast
