// Holds what a step needs to know of its scene, in single precision, and how often work is done that not every step
// needs.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "compare/problem/scene.hpp"
#include "compare/problem/volumes.hpp"
#include "fast/kernels/control.hpp"

namespace ogc::fast {

/// Numbers of a scene that a step needs, in single precision: all are set by `step_settings`.
struct StepSettings {
  float step = 0, contact_radius = 0, friction_limit = 0, bounds_relaxation = 0;  ///< h [s], r [m], ε_v h [m], γ_p
  float detection_radius = 0;                                                     ///< r and the margin of contacts [m]
  Vec acceleration;                                                               ///< [m/s²]
  int iterations = 0;                                                             ///< of a step
  bool divides = false;     ///< whether displacements divide the gaps of pairs (bounds=dat)
  bool energies = false;    ///< whether a row has the energies of elements and contacts
  ControlSettings control;  ///< what the device decides by
};

/// The order of the trees changes no answer, only the time of a detection. A sort is worth two detections, and an order
/// ages slowly (fast/PERFORMANCE.md).
inline constexpr int steps_between_sorts = 16;

/// Who decides whether a step sorts its trees: the device, or the host when it records the step.
enum class Sorting { asked, made, left_out };

/// Steps from one to the next in which forces are measured. Measuring takes as long as six sweeps at most
/// (compare/method.md §6), which shall be 2 % of all sweeps.
inline std::int64_t steps_between_measures(std::int64_t iterations) {
  return (300 + iterations - 1) / std::max<std::int64_t>(1, iterations);
}

/// Iterations that are asked together whether a detection is due, where few are: five where they are fewer than one in
/// four iterations (counted in fast/PERFORMANCE.md). `redetections` are those of `steps` steps after the guess loop.
inline int iterations_in_group(std::int64_t redetections, std::int64_t steps, int iterations) {
  return 4 * redetections < steps * iterations ? 5 : 1;
}

/// `moving`: K, as compare::bounded_count.
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
  to.control.guess_rounds = static_cast<int>(from.guess_rounds);
  to.control.sort_every = steps_between_sorts;
  to.control.iterations = to.iterations;
  return to;
}

}  // namespace ogc::fast
