#include "experiments/program/runs/to_minimiser.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/problem/error.hpp"
#include "compare/problem/rods.hpp"
#include "compare/stages/initial_guess.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {
namespace {

using compare::Snapshot;
using compare::SweepIn;
using compare::Vec3f;
using Positions = reference::Minimiser::Positions;

/// Far beyond every scene, and its square is a float: no vertex is cut.
constexpr float no_bound = 0x1p40F;
/// Sweeps between two looks at the force, and how often in a row it may have fallen by less than a hundredth of the
/// least so far until the floor is reached.
constexpr std::int64_t sweeps_a_look = 10, looks_at_floor = 20;
constexpr double least_gain = 0.99;
/// So often friction is lagged to the minimiser itself.
constexpr int most_friction_solves = 100;

Positions widened(const std::vector<Vec3f>& x) {
  Positions result;
  for (const Vec3f& p : x) result.push_back({p.x, p.y, p.z});
  return result;
}

Positions halfway(const Positions& a, const Positions& b) {
  Positions middle = a;
  for (std::size_t v = 0; v < a.size(); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis) middle[v][axis] = (a[v][axis] + b[v][axis]) / 2;
  return middle;
}

/// Largest and root mean square over `free` vertices [m].
struct Apart {
  double largest = 0, rms = 0;
};

Apart apart(const Positions& a, const Positions& b, std::size_t free) {
  Apart result;
  for (std::size_t v = 0; v < a.size(); ++v) {
    const double d = std::hypot(a[v][0] - b[v][0], a[v][1] - b[v][1], a[v][2] - b[v][2]);
    result.largest = std::max(result.largest, d);
    result.rms += d * d;
  }
  result.rms = free > 0 ? std::sqrt(result.rms / static_cast<double>(free)) : 0;
  return result;
}

double largest_coordinate(const std::vector<Vec3f>& x) {
  double largest = 0;
  for (const Vec3f& p : x)
    largest = std::max({largest, std::abs(double{p.x}), std::abs(double{p.y}), std::abs(double{p.z})});
  return largest;
}

/// y of a step, in single precision as the contestants read it.
std::vector<Vec3f> targets_of(const compare::Scene& scene, const Snapshot& start) {
  compare::InitialGuessIn question;
  const Vec3f acceleration = compare::to_single({scene.gravity})[0];
  const auto h = static_cast<float>(scene.settings.time_step);
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    question.cases.push_back({start.positions[v], start.velocities[v], acceleration, h, start.positions[v], 0, 0});
  const std::vector<Vec3f> free = compare::to_single(reference::authority().initial_guess(question).target);
  const std::vector<compare::Index> groups = rigid_groups(scene);
  std::vector<Vec3f> target = start.positions;
  for (std::size_t v = 0; v < target.size(); ++v)
    if (groups[v] == -1) target[v] = free[v];
  for (const compare::PrescribedMotion& motion : scene.motions) {
    const auto number = static_cast<double>(start.step + 1);
    const std::vector<Vec3f> places = prescribed_targets(scene, motion, number * scene.settings.time_step);
    for (std::size_t k = 0; k < places.size(); ++k) target[static_cast<std::size_t>(motion.vertices[k])] = places[k];
  }
  return target;
}

/// The state after one step of the contestant itself.
Snapshot after_step(const compare::Contestant& contestant, const compare::Scene& scene, const Snapshot& start,
                    std::string& device) {
  const auto simulation = contestant.start(scene, {.energies = false});
  device = simulation->device();
  simulation->restore(start);
  simulation->advance(1);
  Snapshot after = simulation->snapshot();
  if (after.step != start.step + 1)
    throw compare::InputError("the step after step " + std::to_string(start.step) + " of scene '" + scene.name +
                              "' can't be made: a position became infinite, or a vertex left its bound");
  return after;
}

/// The question of a sweep, and all that it looks at: contacts at the end of a step of the contestant's, by the
/// authority; no bounds; colours of the contestant.
class Question {
 public:
  Question(const compare::Contestant& contestant, const compare::Scene& scene, const Snapshot& start,
           const Snapshot& end)
      : topology_(build_topology(scene)),
        start_(start.positions),
        target_(targets_of(scene, start)),
        previous_(end.positions),
        bound_(end.positions.size(), no_bound) {
    const compare::Authority authority = reference::authority();
    const compare::Exclusions exclusions = compare::exclusions(scene);
    const auto contact_radius = static_cast<float>(scene.settings.contact_radius);
    const compare::DetectIn detect{&topology_, exclusions, previous_, contact_radius, contact_radius};
    vertex_facet_ = authority.detect_vertex_facet(detect).exact.contacts;
    edge_edge_ = authority.detect_edge_edge(detect).exact.contacts;
    rest_ = authority.rest_state({&scene, &topology_}).exact;
    colour_ = colours_of(contestant, scene);
    in_ = {&scene,  &topology_, &rest_, colour_,       previous_, start_,
           target_, previous_,  bound_, vertex_facet_, edge_edge_};
  }
  Question(const Question&) = delete;
  Question& operator=(const Question&) = delete;

  const SweepIn& in() const { return in_; }

 private:
  /// From the trace of a step of one iteration from the scene's own start.
  std::vector<compare::Index> colours_of(const compare::Contestant& contestant, compare::Scene scene) const {
    scene.settings.iterations = scene.settings.guess_rounds = 1;
    return contestant.step({&scene, &topology_}).colour;
  }

  compare::Topology topology_;
  std::vector<Vec3f> start_, target_, previous_;
  std::vector<float> bound_;
  std::vector<compare::VertexFacetContact> vertex_facet_;
  std::vector<compare::EdgeEdgeContact> edge_edge_;
  compare::RestStateOut rest_;
  std::vector<compare::Index> colour_;
  SweepIn in_;
};

/// ∇E with friction of the state itself: what is left of the sweep's own force.
reference::Gradient left_at(reference::Minimiser& minimiser, const std::vector<Vec3f>& x) {
  const Positions wide = widened(x);
  minimiser.lag_friction(wide);
  return minimiser.gradient(wide);
}

/// Sweeps until the force falls no further; the state that they end in.
std::vector<Vec3f> swept(const compare::Contestant& contestant, SweepIn in, reference::Minimiser& minimiser,
                         std::int64_t most_sweeps, ToMinimiser& result) {
  std::vector<Vec3f> x(in.old.begin(), in.old.end());
  double least = left_at(minimiser, x).mean;
  for (std::int64_t look = 0; look < looks_at_floor && result.sweeps < most_sweeps; ++look) {
    const std::int64_t until = std::min(result.sweeps + sweeps_a_look, most_sweeps);
    for (; result.sweeps < until; ++result.sweeps) {
      in.old = x;
      compare::SweepOut out = contestant.sweep(in);
      if (out.cut > 0) throw std::logic_error("a vertex was cut where there is no bound");
      x = std::move(out.position);
    }
    const double force = left_at(minimiser, x).mean;
    if (!std::isfinite(force)) throw compare::InputError("the sweeps left the finite numbers: take an earlier state");
    if (force <= least_gain * least) look = -1;
    least = std::min(least, force);
    result.reached_floor = look == looks_at_floor - 1;
  }
  return x;
}

/// Of the line between the two states, looked at in three places.
void measure_convexity(reference::Minimiser& minimiser, const Positions& swept, const Positions& minimum,
                       ToMinimiser& result) {
  result.smallest_eigenvalue = minimiser.smallest_eigenvalue(minimum).value_or(0);
  result.smallest_eigenvalue_between = result.smallest_eigenvalue;
  for (const Positions& x : {halfway(swept, minimum), swept})
    result.smallest_eigenvalue_between = std::min(result.smallest_eigenvalue_between,
                                                  minimiser.smallest_eigenvalue(x).value_or(0));
}

/// The minimiser whose friction is lagged to itself, from `x`; nothing where it does not come to rest.
std::optional<Positions> with_own_friction(reference::Minimiser& minimiser, Positions x) {
  for (int solve = 0; solve < most_friction_solves; ++solve) {
    minimiser.lag_friction(x);
    reference::Minimum next = minimiser.minimum(x);
    if (!next.converged) return {};
    if (next.forces.size() == 1) return x;
    x = std::move(next.position);
  }
  return {};
}

}  // namespace

ToMinimiser distance_to_minimiser(const compare::Contestant& contestant, const compare::Scene& scene,
                                  const Snapshot& start, std::int64_t most_sweeps) {
  ToMinimiser result;
  compare::refuse_rods(scene, "minimise");
  const Snapshot end = after_step(contestant, scene, start, result.device);
  const Question question(contestant, scene, start, end);
  const std::vector<compare::Index> groups = rigid_groups(scene);
  result.scene = scene.name;
  result.step = end.step;
  result.vertices = groups.size();
  result.free_vertices = static_cast<std::size_t>(std::ranges::count(groups, -1));
  result.vertex_facet_contacts = question.in().vertex_facet.size();
  result.edge_edge_contacts = question.in().edge_edge.size();
  reference::ResidualMeter meter(scene);
  meter.begin_step(start.positions, start.velocities, end.step);
  const double unit = meter.reference_force();

  reference::Minimiser minimiser(question.in());
  result.residual_before = left_at(minimiser, end.positions).mean / unit;
  const std::vector<Vec3f> floor = swept(contestant, question.in(), minimiser, most_sweeps, result);
  const reference::Gradient left = left_at(minimiser, floor);
  const Positions x = widened(floor);
  const reference::Minimum minimum = minimiser.minimum(widened(end.positions));
  const reference::Gradient least = minimiser.gradient(minimum.position);
  measure_convexity(minimiser, x, minimum.position, result);
  const Apart distance = apart(x, minimum.position, result.free_vertices);
  result.energy_above = minimiser.energy_above(x, minimum.position);
  const auto own = with_own_friction(minimiser, minimum.position);

  result.residual = left.mean / unit;
  result.gradient = left.norm;
  result.newton_iterations = static_cast<std::int64_t>(minimum.forces.size()) - 1;
  result.newton_residual = least.mean / unit;
  result.newton_converged = minimum.converged;
  result.largest_distance = distance.largest;
  result.rms_distance = distance.rms;
  result.largest_distance_own_friction = own ? apart(x, *own, result.free_vertices).largest
                                             : std::numeric_limits<double>::quiet_NaN();
  result.rounding = compare::unit_roundoff * largest_coordinate(floor);
  const double lambda = result.smallest_eigenvalue_between;
  result.bound_by_gradient = result.bound_by_energy = std::numeric_limits<double>::infinity();
  if (lambda == 0) return result;
  // What Newton's method leaves counts, too: the exact minimiser is ‖∇E‖/λ from where it stopped.
  result.bound_by_gradient = (left.norm + least.norm) / lambda;
  result.bound_by_energy = std::sqrt(2 * std::max(0.0, result.energy_above) / lambda) + least.norm / lambda;
  return result;
}

}  // namespace ogc::experiments
