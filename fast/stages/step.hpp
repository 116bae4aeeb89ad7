// Enqueues one step: Algorithm 3 with the guess loop of method.md §5.2. The sequence of calls is the same for every
// step, and flags on the device decide what each call does. So a graph can record the sequence once, and nothing in it
// waits for the host.
//
//   begin       sorts the trees every 16th step; sets y, Gᵗ, θᵗ, r_q; moves driven volumes to y, refits their trees
//   guess loop  repeat(guess): X_prev ← x, detect, x ← y as far as contacts allow, truncated; up to guess_rounds times.
//               Then it finds contacts with volumes and copies xᵗ and x to the buffers that the sweep gathers from
//   iterations  update prescribed vertices, then colours in order. If the number of cut vertices or of iterations
//               requires a detection: X_prev ← x, detect. With settled_move, those after the step's end do nothing
//   finish      checks the certificate; commits and adds sums only if it holds; writes one row
//   Some steps also measure forces after the guess loop and at the end (Eq. 29).
//
// If a list is too small, a number is not finite or a bound is broken, `active` is cleared. Then later launches do
// nothing or their results are discarded, and xᵗ, vᵗ stay. `when` and `repeat` cost a device as much as ten kernels. So
// they contain only sorts, detections and the iterations after a detection. All other launches always run; the arrays
// that they read are complete even after `active` has been cleared.
//
// The observer and the clock (if set) are called in between, which does not change the sequence.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "compare/stages/step.hpp"
#include "fast/kernels/initial_guess.hpp"
#include "fast/kernels/metrics.hpp"
#include "fast/kernels/sums/step_sums.hpp"
#include "fast/kernels/sums/volume_sums.hpp"
#include "fast/stages/detection.hpp"
#include "fast/stages/left_forces.hpp"
#include "fast/stages/parts.hpp"
#include "fast/stages/profile.hpp"
#include "fast/stages/reduce.hpp"
#include "fast/stages/rods.hpp"
#include "fast/stages/step_detection.hpp"
#include "fast/stages/step_settings.hpp"
#include "fast/stages/sweep.hpp"
#include "fast/stages/volumes.hpp"

namespace ogc::fast {

/// Holds the resident arrays of a simulation. The sweep gathers from `padded` (its two position buffers, one after the
/// other) and from `padded_start`. Detection and everything else read `position`, which has the same numbers without
/// padding.
template <class Backend>
struct StepState {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;
  template <class T>
  using Shared = typename Backend::template Shared<T>;

  /// vertices of the mesh; prescribed vertices of all motions
  int vertex_count = 0, prescribed_count = 0;
  Buffer<Vec> start, velocity, target, previous, position;  ///< by vertex: xᵗ [m], vᵗ [m/s], y, X_prev, x [m]
  Buffer<Vec> displacement;  ///< by vertex: displacements by which gaps are divided [m]; empty if gaps are halved
  Buffer<PaddedVec> padded_start, padded;  ///< by vertex: xᵗ; x, two buffers [m]
  Buffer<float> mass;                      ///< by vertex [kg]
  Buffer<std::uint8_t> is_driven_volume;   ///< by vertex; empty if there are no volumes
  Buffer<int> prescribed_number;           ///< by vertex: number among the prescribed ones; −1 free, −2 fixed
  Shared<Vec> prescribed_targets;          ///< [step of the frame][number]
  Buffer<StepControl> control;             ///< one item
  Shared<StepRow> rows;                    ///< by step of the frame
  Buffer<Vec> taken;                       ///< by vertex, two buffers: moves that contacts took in the guess loop [m]
  Buffer<double> sums;                     ///< in the order in which FinishStep reads them
};

/// Follows the events of a step on the host (compare::StepEventKind: detections, rounds of the guess loop, iterations).
/// fast/probes/trace.hpp and fast/stages/way.hpp implement it. Observed steps are not replayed from a recording.
class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// Called when a step begins; again if the step is repeated.
  virtual void begin() = 0;
  /// Called after the launches of an event, even if the device skipped them. StepControl counts the events that were
  /// not skipped. `position`: x after these launches, on the backend.
  virtual void after(compare::StepEventKind kind, const Vec* position) = 0;
  /// Called when contacts with volumes have been found at the positions of the guess loop's last detection.
  virtual void after_finding() = 0;
  /// Called when the guess loop has ended and the segments' frames have been rotated.
  virtual void after_guess() = 0;
};

/// Enqueues steps.
template <class Backend>
class Step {
 public:
  /// `vertices`: number of vertices of the mesh. `state` is filled later.
  Step(Backend& backend, StepState<Backend>& state, Detection<Backend>& detection, Sweep<Backend>& sweep,
       Volumes<Backend>& volumes, Rods<Backend>& rods, Parts<Backend>& parts, StageClock<Backend>& clock,
       StepSettings settings, int vertices)
      : backend_(backend),
        state_(state),
        detection_(detection),
        sweep_(sweep),
        volumes_(volumes),
        rods_(rods),
        parts_(parts),
        clock_(clock),
        settings_(settings),
        reduction_(backend, vertices),
        left_forces_(backend, vertices, sweep.slots()) {}

  /// Sets the observer; null removes it.
  void observe(StepObserver* observer) { observer_ = observer; }
  bool is_observed() const { return observer_ != nullptr; }

  /// Adds the arrays that other parts read or write.
  void publish(PartArrays& arrays) {
    arrays.position = state_.position.data(), arrays.taken = state_.taken.data(), arrays.padded = state_.padded.data();
    arrays.left = left_forces_.left();
  }

  /// Returns r plus the contact margin [m].
  float detection_radius() const { return settings_.detection_radius; }

  /// Enqueues one step. Equal arguments enqueue the same launches, until a list grows. `group`: number of iterations
  /// between two decisions whether a detection is due. `group` and `sorting` change the time only. `measures`: whether
  /// the step's row gets the forces that are left at the end of the step.
  void enqueue(int group, Sorting sorting = Sorting::asked, bool measures = false) {
    if (observer_ != nullptr) observer_->begin();
    clock_.time(StepStage::begin, [&] { begin(sorting); });
    clock_.time(StepStage::initial_guess, [&] { guess_loop(); });
    if (measures) clock_.time(StepStage::metrics, [&] { left_forces_.begin(sweep_, view(0)); });
    clock_.time(StepStage::sweep, [&] {
      clock_.end_iteration(0);
      for (int i = 0; i < settings_.iterations; i += group) iterate(i, std::min(group, settings_.iterations - i));
      share_positions();
    });
    clock_.time(StepStage::metrics, [&] {
      if (measures) measure_end();
      finish(measures);
    });
  }

  /// Enqueues a step up to its first detection, which overflows if the lists are too small.
  void enqueue_first_detection() {
    begin(Sorting::made);
    backend_.for_each(1, ChooseQueryRadius{control(), settings_.control});
    detect_surfaces(state_.target.data());
  }

  /// Finds the contacts of the vertices at `position` (on the backend) with volumes. Driven volumes stay where the
  /// step's first detection found them.
  void find_in_volumes(const Vec* position) {
    clock_.time(StepStage::volumes, [&] {
      volumes_.find(backend_,
                    {.volumes = detection_.positions(),
                     .position = position,
                     .tables = sweep_.tables(state_.previous.data()),
                     .contact_radius = settings_.contact_radius,
                     .control = control()},
                    &control()->short_rows);
    });
  }

 private:
  StepControl* control() { return state_.control.data(); }
  const int* flag(int StepControl::*member) { return &(control()->*member); }
  void observe(compare::StepEventKind kind) {
    if (observer_ != nullptr) observer_->after(kind, state_.position.data());
  }
  FeasibleRegions regions() { return detection_.regions(state_.previous.data()); }

  void begin(Sorting sorting) {
    StepState<Backend>& s = state_;
    const BeginStep begin{control(), settings_.control};
    const auto sort = [&] { detection_.rebuild(s.start.data()); };
    if (sorting == Sorting::asked) {
      backend_.when(begin, flag(&StepControl::sort), sort);
    } else {
      backend_.for_each(1, begin);
      if (sorting == Sorting::made) sort();
    }
    backend_.for_each(s.vertex_count, BeginVertex{.start = s.start.data(),
                                                  .velocity = s.velocity.data(),
                                                  .prescribed_number = s.prescribed_number.data(),
                                                  .prescribed_targets = s.prescribed_targets.data(),
                                                  .prescribed_count = s.prescribed_count,
                                                  .acceleration = settings_.acceleration,
                                                  .step = settings_.step,
                                                  .position = s.position.data(),
                                                  .target = s.target.data(),
                                                  .taken = s.taken.data(),
                                                  .control = control(),
                                                  .is_driven_volume = s.is_driven_volume.data()});
    clock_.time(StepStage::volumes, [&] { volumes_.refit(backend_, s.position.data()); });
    sweep_.begin(s.start.data());
    rods_.begin_strains(backend_, s.start.data());
  }

  /// Returns the functor that checks the certificate of the current regions and then sets X_prev ← x. `target`: y in
  /// the guess loop, later null.
  BeginRegions begin_regions(const Vec* target) {
    return {state_.position.data(),
            regions(),
            state_.previous.data(),
            control(),
            settings_.divides ? state_.displacement.data() : nullptr,
            target};
  }

  /// Enqueues body() and, at the same time, the search for contacts with volumes at `position`. body() must not write
  /// what this search reads. If a row has no room for a contact, the step's next decision on the device ends the step.
  template <class Body>
  void beside_volumes(const Vec* position, Body body) {
    if (!volumes_.is_used()) return body();
    backend_.at_once([&] { find_in_volumes(position); }, body);
  }

  /// Sets X_prev ← x; finds contacts and bounds, and makes the contact stream of the sweep. `target`: see
  /// begin_regions.
  void detect_surfaces(const Vec* target) {
    const ContactView view = detection_.view();
    const int* overflow = detection_.overflow();
    clock_.time(StepStage::detection, [&] {
      detection_.detect(state_.position.data(), settings_.detection_radius, &control()->query_radius,
                        settings_.bounds_relaxation,
                        StepLaunches{begin_regions(target),
                                     {control(), overflow},
                                     sweep_.contact_rows(view, overflow),
                                     sweep_.slots(),
                                     sweep_.resolve_contact(view, state_.previous.data())});
    });
  }

  /// Detects all contacts, including those with volumes.
  void detect() {
    beside_volumes(state_.position.data(), [&] { detect_surfaces(nullptr); });
    observe(compare::StepEventKind::detection);
  }

  /// Detects in the guess loop; contacts with volumes are found after the loop.
  void detect_in_round() {
    detect_surfaces(state_.target.data());
    observe(compare::StepEventKind::detection);
  }

  /// Sets x ← y, truncated.
  void guess() {
    StepState<Backend>& s = state_;
    const ContactView view = detection_.view();
    const GuessContacts contacts{.rows = view.rows,
                                 .offsets = view.incidence_offsets,
                                 .contacts = sweep_.contacts(),
                                 .position = s.previous.data(),
                                 .target = s.target.data(),
                                 .taken = s.taken.data(),
                                 .radius = settings_.contact_radius};
    const GuessVertex guess{.target = s.target.data(),
                            .regions = regions(),
                            .contacts = contacts,
                            .vertex_count = s.vertex_count,
                            .taken = s.taken.data(),
                            .position = s.position.data(),
                            .control = control(),
                            .prescribed_number = s.prescribed_number.data(),
                            .first = parts_.vertices().begin};
    if (guess.regions.has_planes())
      backend_.template for_each_group<most_planes>(parts_.vertices().count(), guess);
    else
      backend_.for_each(parts_.vertices().count(), guess);
    parts_.share_guess(s.position.data(), s.taken.data(), s.vertex_count, control());
  }

  void guess_loop() {
    const auto round = [&] {
      observe(compare::StepEventKind::guess);  // reports the previous round
      detect_in_round();
      guess();
    };
    backend_.repeat(ChooseQueryRadius{control(), settings_.control}, flag(&StepControl::guess), round,
                    EndRound{control(), settings_.control});
    observe(compare::StepEventKind::guess);
    beside_volumes(state_.previous.data(), [] {});
    if (observer_ != nullptr) observer_->after_finding();
    StepState<Backend>& s = state_;
    using BeginBoth = Beside<BeginSweep, TurnSegment>;
    const BeginBoth begin{s.vertex_count,
                          {s.start.data(), s.position.data(), s.padded_start.data(), s.padded.data(), s.vertex_count},
                          rods_.count(),
                          rods_.begin(s.start.data(), s.position.data(), control())};
    reduction_.template add<0, guess_columns>(vertex_sums({}), begin.count(), begin);
    parts_.meet();  // before another part's first colour writes into the position buffers
    if (observer_ != nullptr) observer_->after_guess();
  }

  /// Enqueues iterations `first` to `first` + `count` − 1, and a detection after each iteration that requires one. A
  /// conditional node (`when`, `repeat`) costs a device as much as ten launches that do nothing. So all iterations are
  /// enqueued at once. If one requires a detection, the later ones do nothing. Then `repeat` detects and runs the later
  /// ones, as long as a detection is due. If a step may settle, the first iteration of a group asks for its turn, too;
  /// only the step's very first one need not.
  void iterate(int first, int count) {
    const int last = first + count - 1, *due = flag(&StepControl::detect);
    const bool may_settle = settings_.control.may_settle();
    const auto end = [&](int i) {
      return EndIteration{control(), settings_.control, count > 1 || may_settle ? i : -1};
    };
    const auto sweeps_from = [&](int from) {
      for (int i = from; i <= last; ++i) {
        const bool asks = i > first || (may_settle && i > 0);
        sweep(i, asks ? flag(&StepControl::turn) : nullptr, i > from ? Start::overlapping : Start::after_previous);
        if (i == last) break;  // the decision about a detection ends this iteration
        backend_.for_each(1, end(i));
        observe(compare::StepEventKind::sweep);
      }
    };
    const auto detect_after_sweep = [&] {
      clock_.end_iteration(last + 1);
      observe(compare::StepEventKind::sweep);
      share_positions();
      detect();
    };
    sweeps_from(first);
    if (count > 1)
      backend_.repeat(
          end(last), due, [&] { detect_after_sweep(), sweeps_from(first + 1); }, end(last));
    else if (first + 1 < settings_.iterations)
      backend_.when(end(first), due, detect_after_sweep);
    else
      backend_.for_each(1, end(first));
    clock_.end_iteration(last + 1);
    observe(compare::StepEventKind::sweep);
  }

  /// Returns the data of an iteration. An even iteration reads x from the first buffer, an odd one from the second.
  SweepView view(int iteration) {
    StepState<Backend>& s = state_;
    SweepView view;
    sweep_.complete(view);
    view.start = {s.padded_start.data()};
    view.target = s.target.data();
    view.regions = regions();
    const bool swapped = iteration % 2 != 0;
    view.old = s.padded.data() + (swapped ? s.vertex_count : 0);
    view.to_fresh = swapped ? -s.vertex_count : s.vertex_count;
    view.position = s.position.data();
    view.control = control();
    view.iteration = iteration;
    if (volumes_.is_used()) view.volumes = volumes_.stream();
    rods_.complete(view.rods);
    view.contact_radius = settings_.contact_radius;
    view.friction_limit = settings_.friction_limit;
    view.settled_move = settings_.control.settled_move;
    return view;
  }

  /// Enqueues an iteration. If `turn` (on the backend) is not null, the iteration does nothing unless *turn equals
  /// `iteration`. `start`: see Sweep::iterate.
  void sweep(int iteration, const int* turn, Start start) {
    SweepView view = this->view(iteration);
    view.turn = turn;
    if (parts_.is_one_of_several())
      sweep_.iterate(view, parts_, state_.padded.data());
    else
      sweep_.iterate(view, start);
    if (volumes_.has_free())
      backend_.for_each(volumes_.rows(), CountDeepInside{view.volumes, view.position, settings_.contact_radius, turn,
                                                         iteration, control()});
  }

  /// Tells the other parts the positions of this part's vertices that they did not read in the sweep.
  void share_positions() { parts_.share_positions(state_.position.data(), state_.padded.data(), state_.vertex_count); }

  /// Measures the forces at the end of the step. If the step may settle, either buffer may have x: both are tried, and
  /// the turn tells which one measures (ControlSettings::turn_after_end).
  void measure_end() {
    const int past = settings_.iterations;
    SweepView last = view(past);
    if (settings_.control.may_settle()) {
      SweepView other = view(past + 1);
      last.turn = other.turn = flag(&StepControl::turn);
      left_forces_.end(sweep_, other);
    }
    left_forces_.end(sweep_, last);
    parts_.share_forces(sweep_.vertices(), left_forces_.left(), sweep_.slots());
    left_forces_.add();
  }

  void finish(bool measures) {
    StepState<Backend>& s = state_;
    const Vec* position = s.position.data();
    if (settings_.energies && volumes_.is_used())
      check_and_add(
          VolumeSums{energy_sums(), {volumes_.stream(), position, settings_.contact_radius}, volumes_.rows()});
    else if (settings_.energies)
      check_and_add(energy_sums());
    else
      check_and_add(state_sums());
    using CommitBoth = Beside<CommitVertex, CommitSegment>;
    const CommitBoth commit{s.vertex_count,
                            {position, settings_.step, control(), s.start.data(), s.velocity.data()},
                            rods_.count(),
                            rods_.commit(control())};
    reduction_.total(s.sums.data(), 1, EndCheck{control()}, commit.count(), commit);
    if (volumes_.is_used()) volumes_.count(backend_, settings_.contact_radius, control());
    backend_.for_each(1, FinishStep{.control = control(),
                                    .contacts = detection_.view(),
                                    .sums = s.sums.data(),
                                    .rows = s.rows.data(),
                                    .segments = rods_.count(),
                                    .left = measures ? left_forces_.totals() : nullptr,
                                    .free_vertices = sweep_.slots(),
                                    .room = parts_.is_one_of_several() ? ListRoom{} : detection_.room()});
  }

  /// Checks the certificate, and adds the terms of `sums` and the terms of rods.
  template <class Sums>
  void check_and_add(const Sums& sums) {
    StepState<Backend>& s = state_;
    const Vec* position = s.position.data();
    const ContactView view = detection_.view();
    const CheckVertex check{.position = position,
                            .regions = regions(),
                            .target = s.target.data(),
                            .prescribed_number = s.prescribed_number.data(),
                            .control = control(),
                            .nearest = view.d_min_vertex};
    const auto add = [&](const auto& all) {
      reduction_.template add<guess_columns, sum_columns>(all, s.vertex_count, check);
    };
    if (rods_.is_used())
      add(rods_.sums(sums, view, sweep_.tables(s.previous.data()), position, settings_.contact_radius, control()));
    else
      add(sums);
  }

  /// Returns the functor that computes the sums over vertices.
  VertexSums vertex_sums(const BeforeLastSweep& before) {
    const StepState<Backend>& s = state_;
    return {{.position = s.position.data(),
             .before = before,
             .start = s.start.data(),
             .target = s.target.data(),
             .mass = s.mass.data(),
             .prescribed_number = s.prescribed_number.data(),
             .acceleration = settings_.acceleration,
             .step = static_cast<double>(settings_.step)},
            s.vertex_count};
  }

  StateSums state_sums() {
    return {vertex_sums({state_.padded.data(), state_.vertex_count, flag(&StepControl::iterations)}),
            sweep_.elements(state_.position.data())};
  }

  EnergySums energy_sums() {
    const StepState<Backend>& s = state_;
    const Vec* position = s.position.data();
    const ContactView view = detection_.view();
    const ContactTables tables = sweep_.tables(s.previous.data());
    const AnyActivation activation{sweep_.activation()};
    return {.state = state_sums(),
            .vertex_facet = {view, tables, position, activation, settings_.contact_radius},
            .edge_edge = {view, tables, position, activation, settings_.contact_radius}};
  }

  Backend& backend_;
  StepState<Backend>& state_;
  Detection<Backend>& detection_;
  Sweep<Backend>& sweep_;
  Volumes<Backend>& volumes_;
  Rods<Backend>& rods_;
  Parts<Backend>& parts_;
  StageClock<Backend>& clock_;
  StepSettings settings_;
  Reduction<Backend, guess_columns + sum_columns> reduction_;
  LeftForces<Backend> left_forces_;
  StepObserver* observer_ = nullptr;
};

}  // namespace ogc::fast
