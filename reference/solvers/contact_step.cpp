#include "reference/solvers/contact_step.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "compare/problem/volumes.hpp"
#include "reference/solvers/guess_contacts.hpp"
#include "reference/solvers/measure.hpp"
#include "reference/solvers/variants/contact_sets.hpp"

namespace ogc::reference {
namespace {

using compare::Vec3f;

constexpr double not_asked = std::numeric_limits<double>::quiet_NaN();

/// Counts the contacts with volumes and the points in contact. Contacts of one point are adjacent in the list.
void count_volume_contacts(const ContactSets& sets, double contact_radius, compare::StepMetrics& metrics) {
  metrics.volume_contacts = static_cast<std::int64_t>(sets.volumes.size());
  metrics.depth_unresolved = static_cast<std::int64_t>(sets.unresolved.size());
  compare::Index last = -1;
  for (const compare::VolumeContact& contact : sets.volumes) {
    if (contact.inside == 0) continue;
    metrics.vertices_inside += contact.point != last;
    last = contact.point;
    metrics.deepest = std::max(metrics.deepest, double{contact.depth} - contact_radius);
  }
}

}  // namespace

double ContactStep::now_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double ContactStep::elapsed_ms() const { return now_ms() - started_ms_; }

ContactStep::ContactStep(const compare::Scene& scene, const compare::Topology& topology,
                         const compare::SimulationOptions& options, std::size_t stages)
    : scene_(scene),
      topology_(topology),
      settings_(scene.settings),
      options_(options),
      exclusions_(exclusions(scene)),
      potential_(scene, topology),
      volumes_(scene, topology),
      contact_set_(variants_of(settings_).contact_set),
      stage_ms_(stages, 0) {
  bounded_ = static_cast<std::size_t>(compare::bounded_count(topology, exclusions_.groups));
  const std::vector<bool> is_volume = compare::volume_flags(scene);
  for (std::size_t v = 0; v < exclusions_.groups.size(); ++v) {
    if (potential_.mobility()[v] == Mobility::fixed) continue;
    (is_volume[v] && potential_.mobility()[v] != Mobility::free ? driven_ : movable_).push_back(v);
  }
}

void ContactStep::begin(const std::vector<Vec3f>& start, const std::vector<Vec3f>& velocity, std::int64_t number) {
  started_ms_ = now_ms();
  metrics_ = {};
  metrics_.step = number;
  rows_.clear();
  std::fill(stage_ms_.begin(), stage_ms_.end(), 0);
  reference_force_ = -1;
  cut_ = 0;
  before_.clear();
  x_ = start_ = widened(start);
  target_ = inertial_targets(scene_, start, velocity, potential_.mobility(),
                             static_cast<double>(number) * settings_.time_step);
  double largest = 0;
  for (const std::size_t v : movable_) largest = std::max(largest, length(target_[v] - start_[v]));
  for (const std::size_t v : driven_) {
    largest = std::max(largest, length(target_[v] - start_[v]));
    x_[v] = target_[v];
  }
  const double listed = detection_radius(settings_);
  query_radius_ = static_cast<float>(
      std::min(listed + largest, std::max(listed, settings_.detection_radius_cap * settings_.contact_radius)));
  lagging_ = 0;
  advanced_ = lag_asked_ = false;
  potential_.begin_step(start_, target_);
  potential_.rods().begin_step(start_, number);
}

void ContactStep::detect_here() {
  detected_ = timed(detection_stage, [&] {
    std::vector<Vec3f> here = rounded(x_);
    const float query_radius = sufficient_query_radius(topology_, exclusions_, movable_, here,
                                                       static_cast<float>(detection_radius(settings_)), query_radius_);
    const std::vector<Vec3f> displacement = displacements_at(here);
    return detect(scene_, topology_, exclusions_, std::move(here), query_radius, displacement);
  });
  if (contact_set_ != Variants{}.contact_set) timed(detection_stage, [&] { replace_contacts(); });
  regions_ = FeasibleRegions(detected_, settings_.bounds);
  const State centre = widened(detected_.previous);
  for (const std::size_t v : movable_) x_[v] = regions_.inside(v, centre[v], x_[v]).x;
  compare::VolumeDepthOut found = timed(detection_stage, [&] { return volumes_.contacts(detected_.previous); });
  detected_.sets.volumes = std::move(found.contacts);
  detected_.sets.unresolved = std::move(found.unresolved);
  potential_.set_contacts(detected_.sets, widened(detected_.previous));
  ++metrics_.broad_phases;
  ++metrics_.discrete_detections;
  detect_next_ = false;
  fresh_ = true;
  iterations_since_ = 0;
}

void ContactStep::replace_contacts() {
  const std::vector<compare::Index> body = compare::body_of_vertex(scene_);
  const auto within = [&](double radius) {
    const compare::DetectIn in{&topology_, exclusions_, detected_.previous, static_cast<float>(radius),
                               static_cast<float>(radius)};
    ListedContacts listed = contact_variant(contact_set_, in, body);
    return ContactSets{std::move(listed.vertex_facet), std::move(listed.edge_edge)};
  };
  detected_.sets = within(detection_radius(settings_));
  detected_.active = settings_.contact_margin > 0 ? within(settings_.contact_radius) : detected_.sets;
}

std::vector<Vec3f> ContactStep::displacements_at(const std::vector<Vec3f>& here) const {
  if (!traits_of(settings_.bounds).divides) return {};
  std::vector<Vec3f> to = here;
  for (const std::size_t v : movable_)
    if (guessing_) to[v] = rounded({target_[v]}).front();
  return guessing_ ? compare::displacements(here, to) : compare::displacements(detected_.previous, here);
}

bool ContactStep::many(std::size_t cut, std::int64_t times) const {
  const double of_iteration = settings_.detection_fraction * static_cast<double>(bounded_);
  return cut > 0 && static_cast<double>(cut) >= static_cast<double>(times) * of_iteration;
}

bool ContactStep::asks(std::size_t cut, std::int64_t times) {
  const bool lag_asks = lagging_ > 0 && (advanced_ || !lag_asked_), many_are_cut = many(cut - lagging_, times);
  lag_asked_ = lag_asked_ || lag_asks;
  lagging_ = 0;
  advanced_ = false;
  return many_are_cut || lag_asks;
}

bool ContactStep::detection_due(std::size_t cut) {
  const bool is_early = waits(), asked = !is_early && asks(cut);
  if (is_early) lagging_ = 0, advanced_ = false;
  return asked || (settings_.detection_every > 0 && iterations_since_ >= settings_.detection_every);
}

bool ContactStep::in_contact() const {
  return !detected_.active.vertex_facet.empty() || !detected_.active.edge_edge.empty() ||
         !detected_.sets.volumes.empty();
}

void ContactStep::guess(GuessEnd end) {
  guessing_ = true;
  detect_here();
  potential_.lag_friction(x_);
  HeldMoves moves(exclusions_.groups, settings_.contact_radius);
  for (std::int64_t round = 1; end == GuessEnd::rounds || !in_contact(); ++round) {
    const State proposals = moves.round(
        guess_contacts(scene_, topology_, potential_.rest(), detected_.active.vertex_facet, detected_.active.edge_edge),
        widened(detected_.previous), target_);
    std::size_t cut = 0;
    for (const std::size_t v : movable_) move_towards(proposals[v], v, cut);
    metrics_.guess_rounds = round;
    const bool many = asks(cut, round);
    if (!many) break;
    if (round >= settings_.guess_rounds) break;
    detect_here();
  }
  guessing_ = false;
  potential_.rods().turn(x_);
  detect_next_ = !fresh_;
  if (metrics_.guess_rounds > 0) metrics_.momentum_lost_guess = momentum_lost({x_, start_, target_}, potential_);
}

/// Returns whether x certainly has no contacts. Two faces at distance d whose vertices moved by at most m are still at
/// least d − 2m apart. Returns false for scenes with volumes, because smallest distances are known for surfaces only.
bool ContactStep::nothing_near() const {
  if (compare::has_volumes(scene_)) return false;
  double largest = 0;
  for (const std::size_t v : movable_) {
    const Vec3f& p = detected_.previous[v];
    largest = std::max(largest, length(x_[v] - Triple<double>{p.x, p.y, p.z}));
  }
  return detected_.smallest_distance - 2 * largest > settings_.contact_radius;
}

void ContactStep::move_towards(const Triple<double>& proposal, std::size_t vertex, std::size_t& cut) {
  const bool is_prescribed = potential_.mobility()[vertex] == Mobility::prescribed;
  const FeasibleRegions::Inside inside = is_prescribed ? regions_.inside_on_path(vertex, x_[vertex], proposal)
                                                       : regions_.inside(vertex, x_[vertex], proposal);
  fresh_ = fresh_ && x_[vertex] == inside.x;
  x_[vertex] = inside.x;
  cut += inside.cut;
  if (!inside.cut || !is_prescribed || !traits_of(settings_.bounds).has_planes) return;
  const Vec3f& p = detected_.previous[vertex];
  ++lagging_;
  advanced_ = advanced_ || inside.x != Triple<double>{p.x, p.y, p.z};
}

std::size_t ContactStep::move_prescribed() {
  std::size_t cut = 0;
  for (const std::size_t v : movable_) {
    if (potential_.mobility()[v] != Mobility::prescribed) continue;
    move_towards(target_[v], v, cut);
  }
  return cut;
}

void ContactStep::set_residual(double mean_force) {
  if (reference_force_ < 0) reference_force_ = mean_force;
  residual_ = reference_force_ > 0 ? mean_force / reference_force_ : 0;
}

compare::IterationMetrics ContactStep::new_row(bool detects) const {
  compare::IterationMetrics row;
  row.step = metrics_.step;
  row.iteration = metrics_.iterations;
  row.wall_ms = elapsed_ms();
  row.residual = residual_;
  row.energy = Potential::total(potential_.terms(x_));
  row.detected = detects ? 1 : 0;
  row.condition_number = row.condition_without_friction = row.condition_without_contact = not_asked;
  return row;
}

StepResult ContactStep::finish(std::uint32_t status) {
  StepResult result;
  result.position = rounded(x_);
  result.velocity = end_velocities(result.position, start_, settings_.time_step);
  result.orientation = potential_.rods().orientations();
  result.query_radius = query_radius_;
  metrics_.status = status;
  metrics_.vertex_facet_contacts = static_cast<std::int64_t>(detected_.sets.vertex_facet.size());
  metrics_.edge_edge_contacts = static_cast<std::int64_t>(detected_.sets.edge_edge.size());
  metrics_.vertices_cut = static_cast<std::int64_t>(cut_);
  metrics_.share_cut = bounded_ == 0 ? 0 : static_cast<double>(cut_) / static_cast<double>(bounded_);
  metrics_.query_radius = double{query_radius_};
  metrics_.residual = residual_;
  metrics_.smallest_distance = detected_.smallest_distance;
  count_volume_contacts(detected_.sets, settings_.contact_radius, metrics_);
  metrics_.wall_ms = elapsed_ms();
  if (options_.profile) metrics_.stage_ms = stage_ms_;
  metrics_.momentum_lost_end = momentum_lost({x_, start_, target_}, potential_);
  metrics_.last_motion = last_motion({x_, start_, target_}, before_, potential_);
  metrics_.largest_lag = largest_lag(x_, target_, potential_.mobility());
  measure_energies(metrics_, {x_, start_, target_}, potential_, scene_, options_.energies);
  if (metrics_.status == compare::step_clean && traits_of(settings_.bounds).certifies &&
      !keeps_bounds(result.position, detected_))
    metrics_.status = compare::step_bound_violated;
  metrics_.iteration_rows = std::move(rows_);
  result.metrics = std::move(metrics_);
  result.detected = detected_;
  return result;
}

}  // namespace ogc::reference
