// Holds the settings of a step in single precision, and the intervals of work that not every step does.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "compare/problem/scene.hpp"
#include "compare/problem/volumes.hpp"
#include "fast/kernels/control.hpp"

namespace ogc::fast {

/// Numbers of a scene that a step reads, in single precision; set by `step_settings`.
struct StepSettings {
  float step = 0, contact_radius = 0, friction_limit = 0, bounds_relaxation = 0;  ///< h [s], r [m], ε_v h [m], γ_p
  float detection_radius = 0;                                                     ///< r plus the contact margin [m]
  Vec acceleration;                                                               ///< [m/s²]
  int iterations = 0;
  bool divides = false;     ///< whether displacements divide the gaps of pairs (bounds=dat)
  bool energies = false;    ///< whether a row has the energies of elements and contacts
  ControlSettings control;  ///< settings of the decisions on the device
};

/// Number of steps between two sorts of the trees. The order of the trees changes no result, only the time of a
/// detection. A sort takes as long as two detections, and an order stays good for many steps (fast/PERFORMANCE.md).
inline constexpr int steps_between_sorts = 16;

/// Tells whether a step sorts its trees. `asked`: the device decides; `made`, `left_out`: the host has decided.
enum class Sorting { asked, made, left_out };

/// Returns the number of steps from one measurement of forces to the next. A measurement takes as long as at most six
/// sweeps (compare/method.md §6). The interval limits its time to 2 % of the time of all sweeps, unless steps end early
/// (settled_move).
inline std::int64_t steps_between_measures(std::int64_t iterations) {
  return (300 + iterations - 1) / std::max<std::int64_t>(1, iterations);
}

/// Returns the number of iterations between two decisions whether a detection is due: five if fewer than one in four
/// iterations needed a detection, otherwise one (counted in fast/PERFORMANCE.md). `redetections`: number of detections
/// after the guess loop in steps with `iterations` iterations in all.
inline int iterations_in_group(std::int64_t redetections, std::int64_t iterations) {
  return 4 * redetections < iterations ? 5 : 1;
}

/// Returns the settings of a step. `moving`: K, the number of vertices that may move and have a bound
/// (compare::bounded_count).
inline StepSettings step_settings(const compare::Scene& scene, std::size_t moving, bool energies) {
  const compare::Settings& from = scene.settings;
  StepSettings to;
  to.step = static_cast<float>(from.time_step);
  to.contact_radius = static_cast<float>(from.contact_radius);
  to.detection_radius = static_cast<float>((1 + from.contact_margin) * from.contact_radius);
  to.friction_limit = static_cast<float>(from.friction_velocity * from.time_step);
  to.bounds_relaxation = static_cast<float>(from.bounds_relaxation);
  to.acceleration = {static_cast<float>(scene.gravity.x), static_cast<float>(scene.gravity.y),
                     static_cast<float>(scene.gravity.z)};
  to.iterations = static_cast<int>(from.iterations);
  to.divides = traits_of(from.bounds).divides;
  to.energies = energies;
  to.control.contact_radius = to.detection_radius;
  to.control.largest_query_radius = std::max(static_cast<float>(from.detection_radius_cap * from.contact_radius),
                                             to.detection_radius);
  to.control.redetect_vertices = from.detection_fraction * static_cast<double>(moving);
  to.control.detection_every = static_cast<int>(from.detection_every);
  to.control.detection_gap = static_cast<int>(from.detection_gap);
  to.control.deep_asks = from.detection_deep != 0;
  to.control.settled_move = static_cast<float>(from.settled_move);
  to.control.guess_rounds = static_cast<int>(from.guess_rounds);
  to.control.sort_every = steps_between_sorts;
  to.control.iterations = to.iterations;
  return to;
}

}  // namespace ogc::fast
