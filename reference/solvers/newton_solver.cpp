#include "reference/solvers/newton_solver.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "reference/solvers/newton_condition.hpp"
#include "reference/solvers/newton_measure.hpp"

namespace ogc::reference {
namespace {

using compare::Vec3f;

constexpr int most_halvings = 20;
/// So often a solve that has converged goes on because the contacts found at its result are others: see the head of newton_solver.hpp.
constexpr int most_judgements = 4;
constexpr double not_asked = std::numeric_limits<double>::quiet_NaN();

double now_ms() { return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

double length(const Triple<double>& a) { return std::hypot(a[0], a[1], a[2]); }

State moved(const State& x, double share, const State& delta) {
  State to = x;
  for (std::size_t v = 0; v < x.size(); ++v) to[v] = x[v] + share * delta[v];
  return to;
}

/// Rounding of the terms' own values.
double value_noise(const PotentialTerms& terms) {
  double sum = 0;
  for (const double e : terms.stencil) sum += std::abs(e);
  for (const double e : terms.inertia) sum += e;
  return 0x1p-52 * sum;
}

}  // namespace

std::vector<std::string> newton_stage_names() { return {"detection", "derivatives", "assembly", "factorization", "line_search"}; }

NewtonSolver::NewtonSolver(const compare::Scene& scene, const compare::Topology& topology, const compare::SimulationOptions& options)
    : scene_(scene),
      topology_(topology),
      settings_(scene.settings),
      options_(options),
      groups_(rigid_groups(scene)),
      potential_(scene, topology),
      matrix_(potential_.mobility()) {
  for (std::size_t v = 0; v < groups_.size(); ++v)
    if (potential_.mobility()[v] != Mobility::fixed) movable_.push_back(v);
}

template <class Work>
auto NewtonSolver::timed(NewtonStage stage, Work work) {
  struct Clock {
    double& sum;
    double start = now_ms();
    ~Clock() { sum += now_ms() - start; }
  } clock{stage_ms_[static_cast<std::size_t>(stage)]};
  return work();
}

NewtonStep NewtonSolver::step(const std::vector<Vec3f>& start, const std::vector<Vec3f>& velocity, std::int64_t number) {
  started_ms_ = now_ms();
  begin(start, velocity, number);
  guess();
  metrics_.momentum_lost_guess = momentum_lost({x_, start_, target_}, potential_);
  const Outcome outcome = solve();
  NewtonStep step;
  finish(step, outcome);
  return step;
}

void NewtonSolver::begin(const std::vector<Vec3f>& start, const std::vector<Vec3f>& velocity, std::int64_t number) {
  metrics_ = {};
  metrics_.step = number;
  rows_.clear();
  stage_ms_ = {};
  reference_force_ = -1;
  cut_ = 0;
  judgements_ = 0;
  x_ = start_ = widened(start);
  target_ = inertial_targets(scene_, start, velocity, potential_.mobility(), static_cast<double>(number) * settings_.time_step);
  double largest = 0;
  for (const std::size_t v : movable_) largest = std::max(largest, length(target_[v] - start_[v]));
  const double r = settings_.contact_radius;
  query_radius_ = static_cast<float>(std::min(r + largest, settings_.query_radius_cap * r));
  potential_.begin_step(start_, target_);
}

void NewtonSolver::detect_here() {
  detected_ = timed(NewtonStage::detection, [&] { return detect(scene_, topology_, groups_, rounded(x_), query_radius_); });
  balls_ = Balls(detected_);
  for (const std::size_t v : movable_) x_[v] = balls_.inside(v, x_[v]).x;
  potential_.set_contacts(detected_.sets, widened(detected_.previous));
  ++metrics_.broad_phases;
  ++metrics_.discrete_detections;
  detect_next_ = false;
  fresh_ = pattern_stale_ = true;
  iterations_since_ = 0;
}

bool NewtonSolver::many(std::size_t cut) const {
  return cut > 0 && static_cast<double>(cut) >= settings_.redetect_fraction * static_cast<double>(movable_.size());
}

void NewtonSolver::guess() {
  detect_here();
  potential_.lag_friction(x_);
  for (std::int64_t round = 1;; ++round) {
    const std::vector<bool> touched = round > 1 ? touched_vertices(detected_.sets, topology_) : std::vector<bool>(x_.size(), false);
    std::size_t cut = 0;
    for (const std::size_t v : movable_) {
      if (touched[v]) continue;
      const Balls::Inside inside = balls_.inside(v, target_[v]);
      fresh_ = fresh_ && x_[v] == inside.x;
      x_[v] = inside.x;
      cut += inside.cut;
    }
    metrics_.guess_rounds = round;
    if (!many(cut) || round >= settings_.guess_rounds) break;
    detect_here();
  }
  detect_next_ = !fresh_;
}

/// Two vertices that were d apart and moved by at most m each are now at least d − 2m apart, and so are all faces.
bool NewtonSolver::nothing_near() const {
  double largest = 0;
  for (const std::size_t v : movable_) {
    const Vec3f& p = detected_.previous[v];
    largest = std::max(largest, length(x_[v] - Triple<double>{p.x, p.y, p.z}));
  }
  return detected_.smallest_distance - 2 * largest > settings_.contact_radius;
}

std::size_t NewtonSolver::move_prescribed() {
  std::size_t cut = 0;
  for (const std::size_t v : movable_) {
    if (potential_.mobility()[v] != Mobility::prescribed) continue;
    const Balls::Inside inside = balls_.inside(v, target_[v]);
    fresh_ = fresh_ && x_[v] == inside.x;
    x_[v] = inside.x;
    cut += inside.cut;
  }
  return cut;
}

NewtonSolver::Outcome NewtonSolver::solve() {
  for (std::int64_t solve = 0;; ++solve) {
    const std::int64_t before = metrics_.iterations;
    const Outcome outcome = solve_once();
    const bool settled = solve > 0 && metrics_.iterations == before;
    if (outcome != Outcome::converged || settled || solve + 1 >= settings_.friction_solves || metrics_.iterations >= settings_.newton_iterations)
      return outcome;
    potential_.lag_friction(x_);
    pattern_stale_ = true;
  }
}

/// Each round does an iteration or detects because the residual is small enough; two of the latter never follow one another, but for prescribed vertices
/// that creep towards their targets. The limit ends both.
NewtonSolver::Outcome NewtonSolver::solve_once() {
  for (std::int64_t round = 0; round <= 2 * settings_.newton_iterations + 1; ++round)
    if (const std::optional<Outcome> outcome = iterate()) return *outcome;
  return Outcome::iteration_limit;
}

double NewtonSolver::mean_force(const PotentialDerivatives& derivatives) const {
  double sum = 0;
  for (const Triple<double>& g : derivatives.gradient) sum += length(g);
  return potential_.free_count() > 0 ? sum / static_cast<double>(potential_.free_count()) : 0;
}

std::optional<NewtonSolver::Outcome> NewtonSolver::iterate() {
  const bool detects = detect_next_;
  judging_ = detects && judge_next_;
  judge_next_ = false;
  if (detects) detect_here();
  const std::size_t prescribed_cut = move_prescribed();
  const PotentialDerivatives derivatives =
      timed(NewtonStage::derivatives, [&] { return potential_.derivatives(x_, settings_.projection); });
  const double force = mean_force(derivatives);
  if (!std::isfinite(force)) return Outcome::not_finite;
  if (reference_force_ < 0) reference_force_ = force;
  residual_ = reference_force_ > 0 ? force / reference_force_ : 0;
  const bool small = settings_.newton_tolerance > 0 && force <= std::max(settings_.newton_tolerance * reference_force_, derivatives.force_noise);
  if (options_.iterations) rows_.push_back(new_row(detects));
  if (small && (fresh_ || nothing_near())) return Outcome::converged;
  if (judging_ && judgements_ >= most_judgements) return Outcome::converged;
  if (metrics_.iterations >= settings_.newton_iterations) return small || settings_.newton_tolerance == 0 ? Outcome::converged : Outcome::iteration_limit;
  if (small) {
    detect_next_ = judge_next_ = true;
    ++judgements_;
    return {};
  }
  return advance(derivatives, prescribed_cut);
}

compare::IterationMetrics NewtonSolver::new_row(bool detects) const {
  compare::IterationMetrics row;
  row.step = metrics_.step;
  row.iteration = metrics_.iterations;
  row.wall_ms = now_ms() - started_ms_;
  row.residual = residual_;
  row.energy = Potential::total(potential_.terms(x_));
  row.detected = detects ? 1 : 0;
  row.condition_number = not_asked;
  return row;
}

/// Solves, truncates, searches along the line.
std::optional<NewtonSolver::Outcome> NewtonSolver::advance(const PotentialDerivatives& derivatives, std::size_t prescribed_cut) {
  if (!factorized(derivatives)) return Outcome::indefinite;
  const Direction direction = direction_of(derivatives);
  if (!std::isfinite(direction.largest)) return Outcome::not_finite;
  const double share = timed(NewtonStage::line_search, [&] { return searched(direction, derivatives); });
  ++metrics_.iterations;
  ++iterations_since_;
  cut_ = direction.cut + prescribed_cut;
  if (options_.iterations) {
    rows_.back().largest_change = direction.largest;
    rows_.back().share = share;
    rows_.back().vertices_at_bound = static_cast<std::int64_t>(cut_);
    if (options_.condition) rows_.back().condition_number = condition_number(matrix_, factor_);
  }
  if (share == 0 && fresh_) return Outcome::no_decrease;
  const bool due = settings_.redetect_every > 0 && iterations_since_ >= settings_.redetect_every;
  detect_next_ = share == 0 || many(cut_) || due || (settings_.newton_tolerance > 0 && cut_ > 0);
  fresh_ = false;
  if (cut_ == 0 && direction.largest <= settings_.newton_step_tolerance * settings_.time_step) return Outcome::converged;
  return {};
}

bool NewtonSolver::factorized(const PotentialDerivatives& derivatives) {
  timed(NewtonStage::assembly, [&] {
    if (pattern_stale_ && matrix_.set_stencils(potential_)) timed(NewtonStage::factorization, [&] { factor_.analyze(matrix_); });
    pattern_stale_ = false;
    matrix_.assemble(potential_, derivatives);
  });
  return timed(NewtonStage::factorization, [&] { return factor_.factorize(matrix_); });
}

NewtonSolver::Direction NewtonSolver::direction_of(const PotentialDerivatives& derivatives) {
  const std::vector<std::size_t>& free = matrix_.free_vertices();
  std::vector<double> right;
  for (const std::size_t v : free)
    for (const double g : derivatives.gradient[v]) right.push_back(-g);
  const std::vector<double> solution = timed(NewtonStage::factorization, [&] { return factor_.solve(right); });
  Direction direction{State(x_.size()), State(x_.size()), 0, 0};
  for (std::size_t i = 0; i < free.size(); ++i) {
    const std::size_t v = free[i];
    direction.delta[v] = {solution[3 * i], solution[3 * i + 1], solution[3 * i + 2]};
    const Balls::Inside inside = balls_.inside(v, x_[v] + direction.delta[v]);
    direction.truncated[v] = inside.cut ? inside.x - x_[v] : direction.delta[v];
    direction.cut += inside.cut;
    const double change = length(direction.delta[v]);
    if (!(change <= direction.largest)) direction.largest = change;
  }
  return direction;
}

/// method.md §7: along δ' first, then along δ scaled to fit all balls. The share of it that was taken, or 0.
double NewtonSolver::searched(const Direction& direction, const PotentialDerivatives& derivatives) {
  const PotentialTerms before = potential_.terms(x_);
  const double noise = derivatives.energy_noise + value_noise(before);
  if (const double share = backtracked(direction.truncated, 1, before, noise); share > 0) return share;
  double room = 1;
  for (const std::size_t v : matrix_.free_vertices()) room = std::min(room, balls_.share_inside(v, x_[v], direction.delta[v]));
  return room > 0 ? backtracked(direction.delta, room, before, noise) : 0;
}

/// A full step may also change the energy by less than its rounding: close to the minimum no decrease can be seen any more.
double NewtonSolver::backtracked(const State& delta, double share, const PotentialTerms& before, double noise) {
  const double full = share;
  for (int halving = 0; halving <= most_halvings; ++halving, share *= 0.5) {
    State trial = moved(x_, share, delta);
    const double change = Potential::change(before, potential_.terms(trial));
    if (!(change < 0 || (share == full && change <= noise))) continue;
    if (on_accepted) on_accepted(Potential::total(before), change, noise);
    x_ = std::move(trial);
    return share;
  }
  return 0;
}

void NewtonSolver::finish(NewtonStep& step, Outcome outcome) {
  step.position = rounded(x_);
  step.velocity = end_velocities(step.position, start_, settings_.time_step);
  step.query_radius = query_radius_;
  metrics_.status = outcome == Outcome::converged    ? compare::step_clean
                    : outcome == Outcome::not_finite ? compare::step_not_finite
                    : outcome == Outcome::indefinite ? compare::step_indefinite
                                                     : compare::step_not_converged;
  metrics_.vertex_facet_contacts = static_cast<std::int64_t>(detected_.sets.vertex_facet.size());
  metrics_.edge_edge_contacts = static_cast<std::int64_t>(detected_.sets.edge_edge.size());
  metrics_.vertices_at_bound = static_cast<std::int64_t>(cut_);
  metrics_.share_at_bound = movable_.empty() ? 0 : static_cast<double>(cut_) / static_cast<double>(movable_.size());
  metrics_.query_radius = double{query_radius_};
  metrics_.residual = residual_;
  metrics_.smallest_distance = detected_.smallest_distance;
  metrics_.wall_ms = now_ms() - started_ms_;
  if (options_.profile) metrics_.stage_ms.assign(stage_ms_.begin(), stage_ms_.end());
  metrics_.momentum_lost_end = momentum_lost({x_, start_, target_}, potential_);
  metrics_.largest_lag = largest_lag(x_, target_, potential_.mobility());
  measure_energies(metrics_, {x_, start_, target_}, potential_, scene_, options_.energies);
  if (metrics_.status == compare::step_clean && !keeps_bounds(step.position, detected_)) metrics_.status = compare::step_bound_violated;
  metrics_.iteration_rows = std::move(rows_);
  step.metrics = std::move(metrics_);
  step.detected = detected_;
}

}  // namespace ogc::reference
