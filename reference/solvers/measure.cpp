#include "reference/solvers/measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/geometry/plane.hpp"
#include "reference/solvers/potential_batches.hpp"

namespace ogc::reference {
namespace {

using compare::Vec3f;

/// Returns the distance of a contact's closed faces at x [m].
double distance_of(const ContactTerm& term, const State& x) {
  const auto corners = contact_corners(term.sides, term.vertex, x);
  return length(separation(closest_form(term.sides, corners).weight, corners));
}

/// Fills the metrics that only scenes with rods have.
void measure_rods(compare::StepMetrics& metrics, const State& x, const Potential& potential) {
  if (!potential.rods().is_used()) return;
  const RodSystem::Stretch stretch = potential.rods().stretch(x);
  metrics.mean_stretch = stretch.mean;
  metrics.largest_stretch = stretch.largest;
  double smallest = std::numeric_limits<double>::infinity();
  for (const ContactTerm& term : potential.contacts())
    if (const double d = distance_of(term, x); d > 0 && d < term.contact_radius) smallest = std::min(smallest, d);
  metrics.smallest_contact_distance = std::isfinite(smallest) ? smallest : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

State inertial_targets(const compare::Scene& scene, const std::vector<Vec3f>& start, const std::vector<Vec3f>& velocity,
                       const std::vector<Mobility>& mobility, double time) {
  const double h = scene.settings.time_step;
  const Triple<double> acceleration{scene.gravity.x, scene.gravity.y, scene.gravity.z};
  State target = widened(start);
  for (std::size_t v = 0; v < target.size(); ++v)
    if (mobility[v] == Mobility::free) target[v] = target[v] + h * widened(velocity[v]) + h * h * acceleration;
  for (const compare::PrescribedMotion& motion : scene.motions) {
    const std::vector<Vec3f> positions = prescribed_targets(scene, motion, time);
    for (std::size_t k = 0; k < positions.size(); ++k)
      target[static_cast<std::size_t>(motion.vertices[k])] = widened(positions[k]);
  }
  return target;
}

std::vector<Vec3f> end_velocities(const std::vector<Vec3f>& position, const State& start, double step) {
  std::vector<Vec3f> velocity;
  velocity.reserve(position.size());
  for (std::size_t v = 0; v < position.size(); ++v) {
    const Triple<double> moved = (1 / step) * (widened(position[v]) - start[v]);
    velocity.push_back({static_cast<float>(moved[0]), static_cast<float>(moved[1]), static_cast<float>(moved[2])});
  }
  return velocity;
}

double momentum_lost(const StepStates& states, const Potential& potential) {
  Triple<double> lost{}, moved{};
  for (std::size_t v = 0; v < states.x.size(); ++v) {
    if (potential.mobility()[v] != Mobility::free) continue;
    lost = lost + potential.mass()[v] * (states.x[v] - states.target[v]);
    moved = moved + potential.mass()[v] * (states.target[v] - states.start[v]);
  }
  return length(moved) > 0 ? length(lost) / length(moved) : 0;
}

double last_motion(const StepStates& states, const State& before, const Potential& potential) {
  if (before.empty()) return std::numeric_limits<double>::quiet_NaN();
  double last = 0, whole = 0;
  for (std::size_t v = 0; v < states.x.size(); ++v) {
    if (potential.mobility()[v] != Mobility::free) continue;
    const Triple<double> swept = states.x[v] - before[v], moved = states.x[v] - states.start[v];
    last += potential.mass()[v] * dot(swept, swept);
    whole += potential.mass()[v] * dot(moved, moved);
  }
  return whole > 0 ? std::sqrt(last / whole) : 0;
}

double largest_lag(const State& x, const State& target, const std::vector<Mobility>& mobility) {
  double largest = 0;
  for (std::size_t v = 0; v < x.size(); ++v)
    if (mobility[v] == Mobility::prescribed) largest = std::max(largest, length(target[v] - x[v]));
  return largest;
}

void measure_energies(compare::StepMetrics& metrics, const StepStates& states, const Potential& potential,
                      const compare::Scene& scene, bool wanted) {
  metrics.inverted_tetrahedra = potential.inverted_tetrahedra(states.x);
  measure_rods(metrics, states.x, potential);
  if (!wanted) {
    metrics.kinetic_energy = metrics.elastic_energy = metrics.contact_energy = metrics.gravity_energy =
        std::numeric_limits<double>::quiet_NaN();
    return;
  }
  const Triple<double> acceleration{scene.gravity.x, scene.gravity.y, scene.gravity.z};
  const double h = scene.settings.time_step;
  for (std::size_t v = 0; v < states.x.size(); ++v) {
    const Triple<double> moved = states.x[v] - states.start[v];
    metrics.kinetic_energy += 0.5 * potential.mass()[v] * dot(moved, moved) / (h * h);
    metrics.gravity_energy -= potential.mass()[v] * dot(acceleration, states.x[v]);
  }
  metrics.elastic_energy = potential.elastic_energy(states.x);
  metrics.contact_energy = potential.contact_energy(states.x);
}

bool keeps_bounds(const std::vector<Vec3f>& position, const Detected& detected) {
  for (std::size_t v = 0; v < position.size(); ++v) {
    const Triple<double> moved = widened(position[v]) - widened(detected.previous[v]);
    if (!(dot(moved, moved) <= double{detected.bound[v]} * detected.bound[v])) return false;
  }
  return broken_planes(detected.planes, position) == 0;
}

}  // namespace ogc::reference
