// The step of Algorithm 3 with the guess loop of method.md §5.2, as one sequence of calls that is the same for every
// step: what happens is decided by flags on the device, so the sequence can be recorded once and nothing in it waits
// for the host.
//
//   begin       when(sort): trees sorted anew; y, Gᵗ, θᵗ, r_q
//   guess loop  repeat(guess): X_prev ← x, detect, x ← y truncated; up to guess_rounds times; then xᵗ and x as
//               places, for the sweep
//   iterations  prescribed vertices, colours in order; flag from the number of cut vertices; where a detection is due,
//               X_prev ← x, detect before the next
//   finish      certificate; commit and sums only if clean; one row
//
// A list that was too small, a number that is not finite or a broken bound clears `active`: what follows is a no-op or
// is thrown away, and xᵗ, vᵗ stay. Only detections, sorts and iterations after a detection stand inside `when` and
// `repeat`, which cost a device as much as ten kernels; all else works on arrays that are whole even then.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "compare/stages/step.hpp"
#include "fast/kernels/initial_guess.hpp"
#include "fast/kernels/metrics.hpp"
#include "fast/stages/detection.hpp"
#include "fast/stages/profile.hpp"
#include "fast/stages/reduce.hpp"
#include "fast/stages/sweep.hpp"

namespace ogc::fast {

/// Numbers of a scene that a step needs, in single precision: all are set by `step_settings`.
struct StepSettings {
  float step, contact_radius, friction_limit, bound_relaxation;  ///< h [s], r [m], ε_v h [m], γ_p
  float detection_radius;                                        ///< r and the margin of contacts [m]
  Vec acceleration;                                              ///< [m/s²]
  int iterations;
  bool energies;
  ControlSettings control;
};

/// The order of the trees changes no answer, only the time of a detection. A sort is worth two detections, and an order
/// ages slowly (fast/PERFORMANCE.md).
inline constexpr int steps_between_sorts = 16;

/// Iterations that are asked together whether a detection is due, where few are: five where they are fewer than one in
/// four iterations (counted in fast/PERFORMANCE.md). `redetections`: of `steps` steps, beside those of the guess loop.
inline int iterations_in_group(std::int64_t redetections, std::int64_t steps, int iterations) {
  return 4 * redetections < steps * iterations ? 5 : 1;
}

/// `moving`: K, as compare::bounded_count.
inline StepSettings step_settings(const compare::Scene& scene, std::size_t moving, bool energies) {
  const compare::Settings& from = scene.settings;
  StepSettings to{};
  to.step = static_cast<float>(from.time_step);
  to.contact_radius = static_cast<float>(from.contact_radius);
  to.detection_radius = static_cast<float>((1 + from.contact_margin) * from.contact_radius);
  to.friction_limit = static_cast<float>(from.friction_velocity * from.time_step);
  to.bound_relaxation = static_cast<float>(from.bound_relaxation);
  to.acceleration = {static_cast<float>(scene.gravity.x), static_cast<float>(scene.gravity.y),
                     static_cast<float>(scene.gravity.z)};
  to.iterations = static_cast<int>(from.iterations);
  to.energies = energies;
  to.control.contact_radius = to.detection_radius;
  to.control.largest_query_radius = std::max(static_cast<float>(from.query_radius_cap * from.contact_radius),
                                             to.detection_radius);
  to.control.cut_threshold = std::max(
      1, static_cast<int>(std::ceil(from.redetect_fraction * static_cast<double>(moving))));
  to.control.redetect_every = static_cast<int>(from.redetect_every);
  to.control.guess_rounds = static_cast<int>(from.guess_rounds);
  to.control.sort_every = steps_between_sorts;
  to.control.iterations = to.iterations;
  return to;
}

/// Resident arrays of a simulation. The sweep gathers from `places`, its two position buffers one after the other, and
/// from `start_places`; detection and all else read `position`, the same numbers closer together.
template <class Backend>
struct StepState {
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  int vertex_count = 0, triangle_count = 0, hinge_count = 0, spring_count = 0, prescribed_count = 0;
  int tetrahedron_count = 0;
  bool damped = false, solids_damped = false;
  Buffer<Vec> start, velocity, target, previous, position;
  Buffer<Place> start_places, places;
  Buffer<float> mass;
  Buffer<int> prescribed_number;   ///< by vertex: place among the prescribed ones; -1 free, -2 fixed
  Buffer<Vec> prescribed_targets;  ///< [step of the frame][place]
  Buffer<TriangleRest> triangles;
  Buffer<HingeRest> hinges;
  Buffer<HingeWeights> weights;
  Buffer<SpringRest> springs;
  Buffer<TetrahedronRest> tetrahedra;
  Buffer<Symmetric2> strain_start;
  Buffer<SolidStrain> solid_start;
  Buffer<float> angle_start;
  Buffer<StepControl> control;
  Buffer<StepRow> rows;
  Buffer<double> sums_guess, sums_end;
};

/// Follows a step from the host, part by part, whether or not the part took place (StepControl counts those that did).
/// For traces (fast/stages/trace.hpp): it needs a clock that is on, because a recorded step has no host between its
/// parts.
class StepObserver {
 public:
  virtual ~StepObserver() = default;
  virtual void begin() = 0;
  /// `position`: where x is now, on the backend.
  virtual void after(compare::StepEventKind part, const Vec* position) = 0;
};

template <class Backend>
class Step {
 public:
  /// For a mesh of `vertices`; `state` is filled later.
  Step(Backend& backend, StepState<Backend>& state, Detection<Backend>& detection, Sweep<Backend>& sweep,
       StageClock<Backend>& clock, StepSettings settings, int vertices)
      : backend_(backend),
        state_(state),
        detection_(detection),
        sweep_(sweep),
        clock_(clock),
        settings_(settings),
        reduction_(backend, vertices) {}

  /// Null: nobody.
  void observe(StepObserver* observer) { observer_ = observer; }

  /// Enqueues one step. The same calls with the same arguments each time, until a list or the ring grows. `group`:
  /// iterations that are asked together whether a detection is due; it changes the time alone.
  void enqueue(int group) {
    if (observer_ != nullptr) observer_->begin();
    clock_.time(StepStage::begin, [&] { begin(); });
    guess_loop();
    for (int i = 0; i < settings_.iterations; i += clock_.on() ? 1 : group) {
      if (clock_.on())
        timed_iteration(i);
      else
        iterate(i, std::min(group, settings_.iterations - i));
    }
    clock_.time(StepStage::metrics, [&] { finish(); });
  }

 private:
  StepControl* control() { return state_.control.data(); }
  const int* flag(int StepControl::*member) { return &(control()->*member); }
  void observe(compare::StepEventKind part) {
    if (observer_ != nullptr) observer_->after(part, state_.position.data());
  }

  void begin() {
    StepState<Backend>& s = state_;
    backend_.when(BeginStep{control(), settings_.control}, flag(&StepControl::sort),
                  [&] { detection_.rebuild(s.start.data()); });
    backend_.for_each(s.vertex_count,
                      BeginVertex{s.start.data(), s.velocity.data(), s.prescribed_number.data(),
                                  s.prescribed_targets.data(), s.prescribed_count, settings_.acceleration,
                                  settings_.step, s.position.data(), s.target.data(), control()});
    if (s.damped) {
      backend_.for_each(s.triangle_count, BeginTriangle{s.triangles.data(), s.start.data(), s.strain_start.data()});
      backend_.for_each(s.hinge_count, BeginHinge{s.hinges.data(), s.start.data(), s.angle_start.data()});
    }
    if (s.solids_damped)
      backend_.for_each(s.tetrahedron_count,
                        BeginTetrahedron{s.tetrahedra.data(), s.start.data(), s.solid_start.data()});
  }

  /// Bounds that end here are certified, then X_prev ← x and everything is found anew, the stream of contacts included.
  void detect() {
    const Vec* position = state_.position.data();
    const ContactView view = detection_.view();
    const BeginBounds before{position, view.bound, state_.previous.data(), control(), detection_.regions()};
    const Both after{EndDetection{control(), detection_.overflow()}, 1,
                     sweep_.contact_rows(view.incidence_offsets, detection_.loose_incidences(), detection_.overflow()),
                     sweep_.slots()};
    detection_.detect(
        position, settings_.detection_radius, &control()->query_radius, settings_.bound_relaxation,
        OnTheWay{before, std::max(1, sweep_.slots()), after, sweep_.resolve_contact(view, state_.previous.data())});
  }

  void guess() {
    const ContactView view = detection_.view();
    ActiveContacts contacts{view.incidence_offsets};
    if (settings_.detection_radius > settings_.contact_radius)
      contacts = {view.incidence_offsets, view.incidences, view.vertex_facet, view.edge_edge, settings_.contact_radius};
    backend_.for_each(state_.vertex_count, GuessVertex{state_.target.data(), state_.previous.data(), view.bound,
                                                       contacts, state_.position.data(), control(),
                                                       detection_.regions(), state_.prescribed_number.data()});
  }

  void guess_loop() {
    const int* again = flag(&StepControl::guess);
    const ChooseQueryRadius choose{control(), settings_.control};
    const EndRound end{control(), settings_.control};
    if (!clock_.on()) {
      backend_.repeat(
          choose, again, [&] { detect(), guess(); }, end);
    } else {
      backend_.for_each(1, choose);
      for (int round = 0; round < settings_.control.guess_rounds; ++round) timed_round(again, end);
    }
    clock_.time(StepStage::initial_guess, [&] {
      reduction_.sum(state_.sums_guess.data(), vertices());
      const StepState<Backend>& s = state_;
      backend_.for_each(s.vertex_count, BeginSweep{s.start.data(), s.position.data(), state_.start_places.data(),
                                                   state_.places.data(), s.vertex_count});
    });
  }

  /// A round of the guess loop for a clock and an observer, which want its parts.
  void timed_round(const int* again, const EndRound& end) {
    clock_.time(StepStage::detection, [&] { backend_.when(Decided{}, again, [&] { detect(); }); });
    observe(compare::StepEventKind::detection);
    clock_.time(StepStage::initial_guess,
                [&] { backend_.when(Decided{}, again, [&] { guess(), backend_.for_each(1, end); }); });
    observe(compare::StepEventKind::guess);
  }

  /// Iterations `first` to `first` + `count` − 1, each followed by a detection where one is due. A question costs a
  /// device ten launches (`when`), an iteration that is not its turn a tenth of one. So all of them are enqueued, and
  /// those after one that asked for a detection do nothing; then, as long as one is due, it is made and they are
  /// enqueued again.
  void iterate(int first, int count) {
    const int last = first + count - 1, *due = flag(&StepControl::detect);
    const auto end = [&](int i) { return EndIteration{control(), settings_.control, count > 1 ? i : -1}; };
    const auto up_to_last = [&](int from, Start start) {
      for (int i = from; i <= last; start = Start::overlapping, ++i) {
        sweep(i, i > first ? flag(&StepControl::turn) : nullptr, start);
        if (i < last) backend_.for_each(1, end(i));
      }
    };
    up_to_last(first, Start::after_previous);
    if (count > 1)
      backend_.repeat(
          end(last), due, [&] { detect(), up_to_last(first + 1, Start::after_previous); }, end(last));
    else if (first + 1 < settings_.iterations)
      backend_.when(end(first), due, [&] { detect(); });
    else
      backend_.for_each(1, end(first));
  }

  /// Iteration i for a clock and an observer.
  void timed_iteration(int i) {
    clock_.time(StepStage::sweep, [&] {
      sweep(i, nullptr, Start::after_previous);
      backend_.for_each(1, EndIteration{control(), settings_.control});
    });
    observe(compare::StepEventKind::sweep);
    clock_.time(StepStage::detection, [&] { backend_.when(Decided{}, flag(&StepControl::detect), [&] { detect(); }); });
    observe(compare::StepEventKind::detection);
  }

  /// `turn`: says whether it is this iteration's; null: it is. `start`: as in Sweep::iterate.
  void sweep(int iteration, const int* turn, Start start) {
    StepState<Backend>& s = state_;
    SweepView view;
    sweep_.complete(view);
    view.strain_start = s.strain_start.data();
    view.angle_start = s.angle_start.data();
    view.solid_start = s.solid_start.data();
    view.start = {s.start_places.data()};
    view.target = s.target.data();
    view.previous = s.previous.data();
    view.bound = detection_.view().bound;
    view.regions = detection_.regions();
    const bool swapped = iteration % 2 != 0;
    view.old = s.places.data() + (swapped ? s.vertex_count : 0);
    view.to_fresh = swapped ? -s.vertex_count : s.vertex_count;
    view.position = s.position.data();
    view.control = control();
    view.turn = turn;
    view.iteration = iteration;
    view.radius = settings_.contact_radius;
    view.friction_limit = settings_.friction_limit;
    sweep_.iterate(view, start);
  }

  void finish() {
    StepState<Backend>& s = state_;
    const Vec* position = s.position.data();
    const ContactView view = detection_.view();
    backend_.for_each(s.vertex_count,
                      CheckVertex{position, s.previous.data(), view.bound, s.target.data(), s.prescribed_number.data(),
                                  control(), detection_.regions(), view.d_min_vertex});
    backend_.for_each(1, EndCheck{control()});
    if (settings_.energies)
      reduction_.sum(s.sums_end.data(), vertices(energies()));
    else
      reduction_.sum(s.sums_end.data(), vertices(tetrahedra()));
    backend_.for_each(s.vertex_count,
                      CommitVertex{position, settings_.step, control(), s.start.data(), s.velocity.data()});
    backend_.for_each(1,
                      FinishStep{control(), detection_.view(), s.sums_guess.data(), s.sums_end.data(), s.rows.data()});
  }

  // What is summed up for reports.

  template <class Rest = NoItems>
  auto vertices(const Rest& rest = {}) {
    const StepState<Backend>& s = state_;
    return items(s.vertex_count,
                 VertexTerm{s.position.data(), s.start.data(), s.target.data(), s.mass.data(),
                            s.prescribed_number.data(), settings_.acceleration, static_cast<double>(settings_.step)},
                 rest);
  }

  template <class Rest = NoItems>
  auto tetrahedra(const Rest& rest = {}) {
    const StepState<Backend>& s = state_;
    return items(s.tetrahedron_count, TetrahedronTerm{s.tetrahedra.data(), sweep_.solids(), s.position.data()}, rest);
  }

  auto energies() {
    const StepState<Backend>& s = state_;
    const Vec* position = s.position.data();
    const ContactView view = detection_.view();
    const ContactTables tables = sweep_.tables(s.previous.data());
    const auto edge_edge = items(view.edge_edge_count,
                                 EdgeEdgeTerm{view, tables, position, sweep_.activation(), settings_.contact_radius});
    const auto contacts = items(view.vertex_facet_count,
                                VertexFacetTerm{view, tables, position, sweep_.activation(), settings_.contact_radius},
                                edge_edge);
    const auto springs = items(s.spring_count, SpringTerm{s.springs.data(), position}, tetrahedra(contacts));
    const auto hinges = items(s.hinge_count, HingeTerm{s.hinges.data(), s.weights.data(), sweep_.models(), position},
                              springs);
    return items(s.triangle_count, TriangleTerm{s.triangles.data(), sweep_.materials(), sweep_.models(), position},
                 hinges);
  }

  Backend& backend_;
  StepState<Backend>& state_;
  Detection<Backend>& detection_;
  Sweep<Backend>& sweep_;
  StageClock<Backend>& clock_;
  StepSettings settings_;
  Reduction<Backend, sum_columns> reduction_;
  StepObserver* observer_ = nullptr;
};

}  // namespace ogc::fast
