#include "reference/solvers/newton/solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "reference/solvers/newton/condition.hpp"

namespace ogc::reference {
namespace {

using compare::Vec3f;

/// The scaled step is taken if it lowers the energy by more than this multiple of the decrease of δ' (head of
/// solver.hpp).
constexpr double far_more = 2;
/// A judgement evaluates the residual of a converged or stalled solve with newly detected contacts. After this many
/// judgements without success the solve ends above the tolerance (head of solver.hpp).
constexpr int most_judgements = 4;
/// Largest factor by which a round stiffens a cut vertex (its inertia and spring): ‖δ_v‖/‖δ'_v‖, the full step over the
/// cut step. A vertex with a larger ratio practically does not move.
constexpr double most_pinned = 1e6;
/// Most rounds that stiffen springs on cut vertices. Each round costs a factorisation; from the third round on they
/// rarely lower the energy more.
constexpr int most_pin_rounds = 6;
/// A solve stalls if the line search accepts a smaller share of the step. Then vertices are at the limits of their
/// balls, or the energy has a kink where contacts change.
constexpr double least_share = 1e-3;

}  // namespace

void NewtonSolver::set_orientations(std::span<const compare::Quaternion> orientations) {
  potential_.rods().set_start(orientations);
}

std::vector<compare::Quaternion> NewtonSolver::orientations() const { return potential_.rods().orientations(); }

std::vector<std::string> NewtonSolver::stage_names() const {
  return {"detection", "derivatives", "assembly", "factorization", "line_search"};
}

NewtonSolver::NewtonSolver(const compare::Scene& scene, const compare::Topology& topology,
                           const compare::SimulationOptions& options, NewtonSteps steps)
    : ContactStep(scene, topology, options, stage_count),
      newton_(newton_settings(settings_)),
      steps_(steps),
      matrix_(potential_.unknowns()) {}

StepResult NewtonSolver::step(const std::vector<Vec3f>& start, const std::vector<Vec3f>& velocity,
                              std::int64_t number) {
  begin(start, velocity, number);
  judgements_ = 0;
  reference_torque_ = -1;
  least_judged_ = std::numeric_limits<double>::infinity();
  matrix_.forget_pattern();
  pattern_stale_ = true;
  guess(GuessEnd::contact);
  if (!moves_planes(newton_.truncation)) return finish(status_of(solve()));
  detect_next_ = true;  // the contacts of the guess loop come with balls, not planes
  const std::uint32_t status = status_of(solve());
  return finish(end_between_planes(status));
}

/// Checks that the stored positions keep the planes of the last detection. Then detects at these positions if needed,
/// because the result of a step contains the contacts and bounds there.
std::uint32_t NewtonSolver::end_between_planes(std::uint32_t status) {
  if (status == compare::step_not_finite) return status;
  if (!planes_.kept_by(rounded(x_))) return compare::step_bound_violated;
  if (!fresh_) detect_here();
  return status;
}

void NewtonSolver::detect_with_planes() {
  detect_here();
  planes_ = timed(detection, [&] {
    const double relaxation = settings_.bounds_relaxation;
    return MovingPlanes(detect_pairs(topology_, exclusions_, detected_.previous, query_radius_, relaxation),
                        detected_.previous, potential_.mobility(), double{query_radius_}, relaxation);
  });
  planes_.enter(x_);
}

std::size_t NewtonSolver::move_prescribed_between_planes() {
  std::size_t cut = 0;
  for (const std::size_t v : movable_) {
    if (potential_.mobility()[v] != Mobility::prescribed) continue;
    const Triple<double> step = target_[v] - x_[v];
    const double share = planes_.share_inside(x_, v, step);
    if (step != Triple<double>{} && share > 0) fresh_ = false;
    x_[v] = share == 1 ? target_[v] : x_[v] + share * step;
    cut += share < 1;
  }
  return cut;
}

std::uint32_t NewtonSolver::status_of(Outcome outcome) const {
  switch (outcome) {
    case Outcome::converged: return compare::step_clean;
    case Outcome::not_finite: return compare::step_not_finite;
    case Outcome::indefinite: return compare::step_indefinite;
    case Outcome::iteration_limit:
      return steps_ == NewtonSteps::whole ? compare::step_clean : compare::step_not_converged;
    case Outcome::no_decrease: break;
  }
  return compare::step_not_converged;
}

NewtonSolver::Outcome NewtonSolver::solve() {
  for (std::int64_t solve = 0;; ++solve) {
    const std::int64_t before = metrics_.iterations;
    const Outcome outcome = solve_once();
    const bool settled = solve > 0 && metrics_.iterations == before;
    if (outcome != Outcome::converged || settled || solve + 1 >= newton_.friction_solves ||
        metrics_.iterations >= newton_.iterations)
      return outcome;
    potential_.lag_friction(x_);
    pattern_stale_ = true;
  }
}

/// Runs rounds until the solve ends. A round is an iteration, or only a detection if the residual is small enough.
/// Several detections may follow each other while prescribed vertices approach their targets slowly. The limit on
/// rounds ends these, too.
NewtonSolver::Outcome NewtonSolver::solve_once() {
  for (std::int64_t round = 0; round <= 2 * newton_.iterations + 1; ++round)
    if (const std::optional<Outcome> outcome = iterate()) return *outcome;
  return Outcome::iteration_limit;
}

double NewtonSolver::mean_force() const {
  double sum = 0;
  for (std::size_t v = 0; v < x_.size(); ++v) sum += length(derivatives_.gradient[v]);
  return potential_.free_count() > 0 ? sum / static_cast<double>(potential_.free_count()) : 0;
}

/// Returns whether the sum of the torques on the rods' segments is small: at most newton_tolerance times the sum in the
/// first iteration, or at most its own rounding error. The rounding error is needed for a freely falling straight rod,
/// whose torque is 0.
bool NewtonSolver::has_small_torque() {
  double sum = 0;
  for (std::size_t i = x_.size(); i < derivatives_.gradient.size(); ++i) sum += length(derivatives_.gradient[i]);
  if (reference_torque_ < 0) reference_torque_ = sum;
  return sum <= std::max(newton_.tolerance * reference_torque_, derivatives_.torque_noise);
}

std::optional<NewtonSolver::Outcome> NewtonSolver::iterate() {
  const bool detects = detect_next_;
  judging_ = detects && judge_next_;
  judge_next_ = false;
  const bool by_vertex = !moves_planes(newton_.truncation);
  if (detects) by_vertex ? detect_here() : detect_with_planes();
  pattern_stale_ = pattern_stale_ || detects;
  const std::size_t prescribed_cut = by_vertex ? move_prescribed() : move_prescribed_between_planes();
  derive(cut_ > 0 ? newton_.projection : HessianProjection::none);
  const double force = mean_force();
  if (!std::isfinite(force)) return Outcome::not_finite;
  set_residual(force);
  const bool has_rods = potential_.rods().is_used();
  const bool small = newton_.tolerance > 0 && (!has_rods || has_small_torque()) &&
                     force <= std::max(newton_.tolerance * reference_force_, derivatives_.force_noise);
  if (options_.iterations) rows_.push_back(new_row(detects));
  if (small && (fresh_ || nothing_near())) return Outcome::converged;
  if (judging_ && judged_in_vain(force)) return Outcome::converged;
  if (metrics_.iterations >= newton_.iterations)
    return small || newton_.tolerance == 0 ? Outcome::converged : Outcome::iteration_limit;
  if (small) {
    detect_next_ = judge_next_ = true;
    return {};
  }
  return advance(prescribed_cut);
}

/// Counts a judgement of a solve (its residual with newly detected contacts), unless the force is at most half of the
/// least force of earlier judgements. Returns whether most_judgements have been counted.
bool NewtonSolver::judged_in_vain(double force) {
  if (judgements_ == 0 || force > 0.5 * least_judged_) ++judgements_;
  least_judged_ = std::min(least_judged_, force);
  return judgements_ >= most_judgements;
}

std::optional<NewtonSolver::Outcome> NewtonSolver::advance(std::size_t prescribed_cut) {
  if (!factorized_definite()) return Outcome::indefinite;
  const Direction direction = direction_of();
  if (!std::isfinite(direction.largest)) return Outcome::not_finite;
  if (options_.iterations && options_.condition) measure_condition(rows_.back());
  before_ = x_;
  const double share = steps_ == NewtonSteps::searched ? accepted_share(direction) : whole_step(direction);
  ++metrics_.iterations;
  ++iterations_since_;
  cut_ = direction.cut + prescribed_cut;
  if (options_.iterations) {
    rows_.back().largest_change = direction.largest;
    rows_.back().share = share;
    rows_.back().vertices_cut = static_cast<std::int64_t>(cut_);
  }
  if (share == 0 && fresh_) return Outcome::no_decrease;
  const bool stands_still = steps_ == NewtonSteps::searched && share < least_share;
  detect_next_ = steps_ == NewtonSteps::whole || stands_still || detection_due(cut_) ||
                 (newton_.tolerance > 0 && cut_ > 0);
  judge_next_ = stands_still && cut_ == 0 && newton_.tolerance > 0;
  fresh_ = false;
  if (cut_ == 0 && direction.largest <= newton_.step_tolerance * settings_.time_step) return Outcome::converged;
  return {};
}

void NewtonSolver::measure_condition(compare::IterationMetrics& row) {
  row.condition_number = condition_number(matrix_, factor_);
  const PotentialDerivatives projected = potential_.derivatives(x_, newton_.projection);
  const std::size_t elastic = potential_.elastic_count(), normal = potential_.frictionless_count();
  row.condition_without_friction = condition_of_first(potential_, normal, derivatives_, projected);
  row.condition_without_contact = condition_of_first(potential_, elastic, derivatives_, projected);
}

void NewtonSolver::derive(HessianProjection projection) {
  projection_ = projection;
  timed(derivation, [&] { derivatives_ = potential_.derivatives(x_, projection, std::move(derivatives_)); });
}

bool NewtonSolver::factorized_definite() {
  if (factorized()) return true;
  if (projection_ == newton_.projection) return false;
  derive(newton_.projection);
  return factorized();
}

bool NewtonSolver::factorized() {
  timed(assembly, [&] {
    if (pattern_stale_ && matrix_.set_stencils(potential_.vertices(), potential_.elastic_count()))
      timed(factorization, [&] { factor_.analyze(matrix_); });
    pattern_stale_ = false;
    matrix_.assemble(potential_.inertias(), derivatives_.stencil);
  });
  return timed(factorization, [&] { return factor_.factorize(matrix_); });
}

NewtonSolver::Direction NewtonSolver::direction_of() {
  const std::vector<std::size_t>& free = matrix_.free_vertices();
  std::vector<double> right;
  for (const std::size_t v : free)
    for (const double g : derivatives_.gradient[v]) right.push_back(-g);
  const std::vector<double> solution = timed(factorization, [&] { return factor_.solve(right); });
  const std::size_t unknowns = derivatives_.gradient.size();
  Direction direction{State(unknowns), State(unknowns), 0, 0};
  for (std::size_t i = 0; i < free.size(); ++i) {
    const std::size_t v = free[i];
    direction.delta[v] = {solution[3 * i], solution[3 * i + 1], solution[3 * i + 2]};
    const double change = v < x_.size() ? length(direction.delta[v])
                                        : potential_.rods().length(v - x_.size()) * length(direction.delta[v]);
    if (!(change <= direction.largest)) direction.largest = change;
  }
  truncate(direction);
  return direction;
}

void NewtonSolver::truncate(Direction& direction) const {
  if (moves_planes(newton_.truncation)) direction.truncated = planes_.truncated(x_, direction.delta);
  for (const std::size_t v : matrix_.free_vertices()) {
    if (v >= x_.size()) {  // a segment's frame, which has no bound
      direction.truncated[v] = direction.delta[v];
      continue;
    }
    if (moves_planes(newton_.truncation)) {
      direction.cut += direction.truncated[v] != direction.delta[v];
      continue;
    }
    const auto inside = regions_.inside(v, x_[v], x_[v] + direction.delta[v]);
    direction.truncated[v] = inside.cut ? inside.x - x_[v] : direction.delta[v];
    direction.cut += inside.cut;
  }
}

/// Adds springs, which hold cut vertices at their positions, to the matrix. Factorises the matrix and returns whether
/// that succeeded. With these springs, a vertex with only inertia moves exactly to the limit of its ball, and so do
/// sheets that move together.
bool NewtonSolver::pin(const Direction& direction, std::vector<double>& pins) {
  const std::vector<std::size_t>& free = matrix_.free_vertices();
  const std::vector<double> inertias = potential_.inertias();
  for (std::size_t i = 0; i < free.size(); ++i) {
    const std::size_t v = free[i];
    const double wanted = length(direction.delta[v]), kept = length(direction.truncated[v]);
    if (!(kept < wanted)) continue;
    const double ratio = wanted < most_pinned * kept ? wanted / kept : most_pinned;
    const double more = (ratio - 1) * (inertias[v] + pins[v]);
    pins[v] += more;
    matrix_.add_to_diagonal(i, more);
  }
  return timed(factorization, [&] { return factor_.factorize(matrix_); });
}

/// Solves with springs on cut vertices and searches along the truncated solution. Stiffens the springs and repeats
/// while vertices are cut again and the energy falls more.
Accepted NewtonSolver::pinned(Direction direction, const PotentialTerms& before, double noise) {
  Accepted best;
  std::vector<double> pins(derivatives_.gradient.size(), 0);
  for (int round = 0; round < most_pin_rounds && direction.cut > 0; ++round) {
    if (!pin(direction, pins)) break;
    direction = direction_of();
    Accepted found = timed(line_search,
                           [&] { return backtracked(potential_, unknowns(), direction.truncated, 1, before, noise); });
    if (found.share == 0 || (best.share > 0 && found.change >= best.change)) break;
    best = std::move(found);
  }
  return best;
}

double NewtonSolver::accepted_share(const Direction& direction) {
  const PotentialTerms before = potential_.terms(x_);
  const double noise = derivatives_.energy_noise + value_noise(before);
  Accepted best = timed(line_search, [&] { return searched(direction, before, noise); });
  if (direction.cut > 0 && direction.cut < matrix_.free_vertices().size()) {
    Accepted held = pinned(direction, before, noise);
    if (held.share > 0 && (best.share == 0 || held.change < best.change)) best = std::move(held);
  }
  if (best.share == 0) return 0;
  if (on_accepted) on_accepted(Potential::total(before), best.change, noise);
  move_to(std::move(best.x));
  return best.share;
}

double NewtonSolver::whole_step(const Direction& direction) {
  State all = unknowns();
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = all[i] + direction.delta[i];
  move_to(std::move(all));
  return 1;
}

void NewtonSolver::move_to(State all) {
  potential_.rods().turn_by(all);
  all.resize(x_.size());
  x_ = std::move(all);
}

State NewtonSolver::unknowns() const {
  State all = x_;
  all.resize(derivatives_.gradient.size());
  return all;
}

double NewtonSolver::room_for(const State& delta) const {
  if (moves_planes(newton_.truncation)) return planes_.share_inside(x_, delta);
  double room = 1;
  for (const std::size_t v : matrix_.free_vertices())
    if (v < x_.size()) room = std::min(room, regions_.share_inside(v, x_[v], delta[v]));
  return room;
}

/// Searches along δ'. If δ was cut, also searches along δ scaled to fit all balls. Takes the scaled direction if its
/// decrease of the energy is `far_more` times as large.
Accepted NewtonSolver::searched(const Direction& direction, const PotentialTerms& before, double noise) const {
  Accepted best = backtracked(potential_, unknowns(), direction.truncated, 1, before, noise);
  if (direction.cut > 0) {
    Accepted scaled = backtracked(potential_, unknowns(), direction.delta, room_for(direction.delta), before, noise);
    if (scaled.share > 0 && (best.share == 0 || scaled.change < far_more * best.change)) best = std::move(scaled);
  }
  return best;
}

}  // namespace ogc::reference
