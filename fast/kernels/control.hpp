// Controls a step on the device: counters, flags that the host does not read inside a step, and kernels of one thread
// that compute the flags from the counters.
//
//   BeginStep ─► detect, guess ─► EndRound ─► … ─► sweep ─► EndIteration ─► … ─► EndCheck ─► FinishStep
//                     ▲── detect ────┘               ▲── detect ──┘     (a detection ends in EndDetection)
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#include "compare/contestant.hpp"
#include "fast/kernels/arithmetic/atomic.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// Returns whether a number is neither NaN nor infinite.
OGC_HD inline bool is_finite(float a) { return fabsf(a) <= 3.40282347e38f; }
OGC_HD inline bool is_finite(const Vec& a) { return is_finite(a.x) && is_finite(a.y) && is_finite(a.z); }

/// Returns the bits of a non-negative float as an integer. They have the order of the floats, so atomic_max finds
/// maxima.
OGC_HD inline int float_bits(float a) {
  int bits = 0;
  memcpy(&bits, &a, sizeof bits);
  return bits;
}
OGC_HD inline float float_from_bits(int bits) {
  float a = 0;
  memcpy(&a, &bits, sizeof a);
  return a;
}

/// Holds the settings of the control; they are the same in each step.
struct ControlSettings {
  double redetect_vertices = 1;    ///< γ_e K
  int detection_every = 0;         ///< at most this number of iterations between two detections; 0: no limit
  int detection_gap = 1;           ///< at least this number of iterations between two detections
  bool deep_asks = true;           ///< whether vertices deep inside volumes cause detections
  int iterations = 1 << 30;        ///< iterations of a step; no detection follows the last one
  int guess_rounds = 16;           ///< largest number of rounds of a step's guess loop
  int sort_every = 1;              ///< steps between two sorts of the trees
  float settled_move = 0;          ///< largest move of an iteration that ends a step [m]; 0: none does
  float contact_radius = 0;        ///< r [m]
  float largest_query_radius = 0;  ///< cap of r_q [m]

  /// Returns the least number of cut vertices that causes a detection. `times` is 1 after an iteration, and the number
  /// of the round in the guess loop.
  OGC_HD int least_cut(int times = 1) const {
    const double least = ceil(times * redetect_vertices);
    return least > 1 ? static_cast<int>(least) : 1;
  }
  /// Returns whether a step may end before its last iteration.
  OGC_HD bool may_settle() const { return settled_move > 0; }
  /// Returns a turn that no iteration has, for a step that ends after `done` iterations. It is even if `done` is: then
  /// an iteration with this number would read the buffer that has x.
  OGC_HD int turn_after_end(int done) const { return iterations + ((iterations ^ done) & 1); }
};

/// Holds the state of a frame (the steps between two stored states), and of its current step, on the device.
struct StepControl {
  // State of the frame:
  int active = 0;      ///< 1: steps are computed; 0: they do nothing
  int status = 0;      ///< compare::StepStatus bits of the failure that stopped the frame
  int steps_done = 0;  ///< steps committed since the frame began; indexes the row of metrics and the row of targets
  int since_sort = 1 << 30;  ///< steps begun since the last sort of the trees; kept from frame to frame
  int short_of_room = 0;     ///< 1: a list was nearly full after the last step (ListRoom), which ended the frame
  // State of the step. The flags that Backend::when reads are 0 if the frame is not active.
  int attempted = 0;  ///< 1: the frame was active when the step began
  int sort = 0;       ///< 1: the trees are sorted in this step
  int guess = 0;      ///< 1: the guess loop has another round
  int detect = 0;     ///< 1: a detection is due before the next iteration
  /// next iteration, from 0; −1 while a detection is due; at the end ControlSettings::iterations or the number after it
  int turn = 0;
  float query_radius = 0;                 ///< r_q [m]
  int largest_move = 0, largest_lag = 0;  ///< bits of floats [m]
  float smallest_bound = 0;               ///< smallest b_v; with planes, smallest distance of any pair [m]
  /// cut: vertices cut in this round or iteration; cut_last: vertices cut or lagging in the previous one
  int cut = 0, cut_last = 0;
  int deep_inside = 0;  ///< with volumes: vertices that are deep inside a volume after this iteration
  int moved = 0;        ///< 1: this iteration moved a vertex farther than settled_move; kept up only if that is not 0
  /// With planes. lagging: number of prescribed vertices that lag behind their targets; advanced: whether one of them
  /// has moved since the last detection; lag_asked: whether one has already caused a detection in this step.
  int lagging = 0, advanced = 0, lag_asked = 0;
  int not_finite = 0, violations = 0;
  /// with volumes: 1 if a row of contacts was full; for full lists of a detection, see ListStatus::overflow
  int short_rows = 0;
  /// With volumes, at the end of the step: number of contacts, vertices inside, bits of the largest depth at the last
  /// detection [m], sheets without a path to the boundary.
  int volume_contacts = 0, vertices_inside = 0, deepest = 0, depth_unresolved = 0;
  /// With rods, at the end of the step: bits of the largest ‖D‖/l [1]; smallest distance of contacts that exert a force
  /// [m].
  int longest_segment = 0;
  float nearest_contact = 0;
  int rounds = 0, detections = 0, since_detection = 0, iterations = 0;

  /// Count atomically: sums and maxima do not depend on the order of threads.
  OGC_HD void count_cut() { atomic_add(&cut, 1); }
  OGC_HD void count_deep_inside() { atomic_add(&deep_inside, 1); }
  OGC_HD void count_lag(bool has_advanced) {
    atomic_add(&lagging, 1);
    if (has_advanced) atomic_max(&advanced, 1);
  }
  /// Reads first: in most iterations many vertices move, and only the first one has to write.
  OGC_HD void note_move() {
    if (atomic_load(&moved) == 0) atomic_max(&moved, 1);
  }
  OGC_HD void count_not_finite() { atomic_add(&not_finite, 1); }
  OGC_HD void count_violation() { atomic_add(&violations, 1); }
};

/// Returns whether a detection is due because of cuts, and resets the counts. None is due unless `may_detect`. It is
/// due if at least `least_cut` vertices were cut, or, with `deep_asks`, if any vertex was cut while one is deep inside
/// a volume. It is also due if prescribed vertices lag and one of them has moved since the last detection. If none of
/// them has moved, it is due only once in a step.
OGC_HD inline bool take_request(StepControl& c, int least_cut, bool may_detect = true, bool deep_asks = true) {
  const bool lag_asks = may_detect && c.lagging > 0 && (c.advanced > 0 || c.lag_asked == 0),
             asks = c.cut >= least_cut || (deep_asks && c.cut > 0 && c.deep_inside > 0);
  if (lag_asks) c.lag_asked = 1;
  c.cut_last = c.cut + c.lagging;
  c.cut = c.lagging = c.advanced = c.deep_inside = 0;
  return (may_detect && asks) || lag_asks;
}

/// If the step failed, stops the step and all later steps of the frame. A stopped step is not committed.
OGC_HD inline void stop_if_failed(StepControl& c) {
  if (c.not_finite > 0) c.status |= compare::step_not_finite;
  if (c.violations > 0) c.status |= compare::step_bound_violated;
  if (c.short_rows > 0) c.status |= compare::step_list_grew;
  if (c.status != 0) c.active = c.guess = c.detect = 0;
}

/// Resets the state of the step. This is the first kernel of each step.
struct BeginStep {
  StepControl* control;  ///< on the backend
  ControlSettings settings;

  OGC_HD void operator()(int) const {
    StepControl& c = *control;
    c.attempted = c.guess = c.active;
    c.sort = c.active != 0 && c.since_sort >= settings.sort_every ? 1 : 0;
    c.since_sort = c.sort != 0 ? 1 : c.since_sort + 1;
    c.detect = 0;
    c.largest_move = c.largest_lag = 0;
    c.smallest_bound = 3.40282347e38f;
    c.cut = c.cut_last = c.not_finite = c.violations = 0;
    c.lagging = c.advanced = c.lag_asked = c.deep_inside = c.moved = 0;
    c.short_rows = 0;
    c.volume_contacts = c.vertices_inside = c.deepest = c.depth_unresolved = 0;
    c.longest_segment = 0;
    c.nearest_contact = 3.40282347e38f;
    c.rounds = c.detections = c.since_detection = c.iterations = c.turn = 0;
  }
};

/// Sets r_q = min(r + largest move, cap) (method.md §5.3).
struct ChooseQueryRadius {
  StepControl* control;  ///< on the backend
  ControlSettings settings;

  OGC_HD void operator()(int) const {
    StepControl& c = *control;
    if (c.attempted == 0) return;
    stop_if_failed(c);
    const float wanted = settings.contact_radius + float_from_bits(c.largest_move);
    c.query_radius = wanted < settings.largest_query_radius ? wanted : settings.largest_query_radius;
  }
};

/// Ends a detection and counts it. If a list was too small (`overflow` is not 0), the step fails.
struct EndDetection {
  StepControl* control;  ///< on the backend
  const int* overflow;   ///< on the backend

  OGC_HD void operator()(int) const {
    StepControl& c = *control;
    if (*overflow != 0) c.status |= compare::step_list_grew;
    ++c.detections;
    c.since_detection = 0;
    c.detect = 0;
    c.turn = c.iterations;
    stop_if_failed(c);
  }
};

/// Ends a round of the guess loop. Another round follows if enough vertices were cut and rounds are left.
struct EndRound {
  StepControl* control;  ///< on the backend
  ControlSettings settings;

  OGC_HD void operator()(int) const {
    StepControl& c = *control;
    ++c.rounds;
    const bool asked = take_request(c, settings.least_cut(c.rounds));
    c.guess = c.active != 0 && asked && c.rounds < settings.guess_rounds ? 1 : 0;
  }
};

/// Ends an iteration. A detection follows if enough vertices were cut (Alg. 3 line 29) and `detection_gap` iterations
/// have passed since the last one, or if `detection_every` have passed. With `settled_move`, the step's iterations end
/// if this one neither cut a vertex nor left one lagging, no vertex moved farther, and no detection is due. `number` is
/// the index of this iteration. If it differs from `control->turn`, nothing happens; −1 omits this check.
struct EndIteration {
  StepControl* control;  ///< on the backend
  ControlSettings settings;
  int number = -1;

  OGC_HD void operator()(int) const {
    StepControl& c = *control;
    if (number >= 0 && c.turn != number) return;
    ++c.iterations;
    ++c.since_detection;
    const bool asked = take_request(c, settings.least_cut(), c.since_detection >= settings.detection_gap,
                                    settings.deep_asks);
    const bool due = settings.detection_every > 0 && c.since_detection >= settings.detection_every;
    // cut_last counts every cut and every lag, those that detection_gap or a lag's single request keep from asking, too
    const bool is_settled = settings.may_settle() && c.cut_last == 0 && c.moved == 0 && !due;
    c.moved = 0;
    c.detect = c.active != 0 && c.iterations < settings.iterations && (due || asked) ? 1 : 0;
    stop_if_failed(c);
    c.turn = c.detect != 0 ? -1 : is_settled ? settings.turn_after_end(c.iterations) : c.iterations;
  }
};

}  // namespace ogc::fast
