#include "reference/ipc/solver.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "compare/problem/error.hpp"
#include "reference/ipc/intersections.hpp"
#include "reference/ipc/stopping.hpp"

namespace ogc::reference {
namespace {

constexpr double smallest_share = 1e-10;             ///< share of the direction p below which a step has stalled
constexpr std::size_t window = 3;                    ///< number of iterations over which `velocity` averages
constexpr double first_pull = 1e3, most_pull = 1e8;  ///< ρ (Li et al. 2020, supplement)
/// Once prescribed vertices have moved this share of the distance to their targets, they are fixed.
constexpr double pulled_enough = 0.999;
constexpr std::size_t most_named = 20;  ///< largest number of pairs in a message

double now_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Returns x + share p for the vertices; ignores the frames of p.
State moved(const State& x, double share, const State& p) {
  State to = x;
  for (std::size_t v = 0; v < x.size(); ++v) to[v] = x[v] + share * p[v];
  return to;
}

double largest_component(const State& p) {
  double largest = 0;
  for (const Triple<double>& a : p)
    for (const double c : a)
      if (!(std::abs(c) <= largest)) largest = std::abs(c);
  return largest;
}

BarrierShape shape_of(const compare::Scene& scene, const IpcSettings& settings) {
  const double distance = settings.distance > 0 ? settings.distance : settings.relative_distance * rest_diagonal(scene);
  return {distance, settings.thickness};
}

double mean_inertia(const Potential& potential) {
  double sum = 0;
  for (std::size_t v = 0; v < potential.mobility().size(); ++v)
    if (potential.mobility()[v] == Mobility::free) sum += potential.inertia(v);
  return potential.free_count() > 0 ? sum / static_cast<double>(potential.free_count()) : 0;
}

std::vector<Mobility> all_movable(std::vector<Mobility> mobility) {
  for (Mobility& m : mobility)
    if (m == Mobility::prescribed) m = Mobility::free;
  return mobility;
}

std::string number(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

}  // namespace

std::vector<std::string> ipc_stage_names() {
  return {"broad_phase", "barriers", "derivatives", "assembly", "factorization", "ccd", "line_search", "guard"};
}

IpcSolver::IpcSolver(const compare::Scene& scene, const compare::Topology& topology,
                     const compare::SimulationOptions& options)
    : scene_(scene),
      topology_(topology),
      settings_(scene.settings),
      ipc_(ipc_settings(settings_)),
      newton_(newton_settings(settings_)),
      options_(options),
      exclusions_(exclusions(scene)),
      shape_(shape_of(scene, ipc_)),
      forces_(scene, topology, shape_),
      mesh_{topology_, exclusions_, forces_.potential().rest().edge_length_squared},
      moving_diagonal_(moving_diagonal(scene)),
      guard_({rest_diagonal(scene), 0}, shape_, ipc_.adaptation),
      free_(forces_.potential().unknowns()) {
  scale_ = {rest_diagonal(scene), mean_inertia(forces_.potential())};
  bounds_ = reference::stiffness_bounds(shape_, scale_, ipc_.adaptation);
  if (ipc_.stiffness > 0) bounds_ = {ipc_.stiffness, ipc_.stiffness};
  stiffness_ = bounds_.lower;
}

template <class Work>
auto IpcSolver::timed(IpcStage stage, Work work) {
  struct Clock {
    double& sum;
    double start = now_ms();
    ~Clock() { sum += now_ms() - start; }
  } clock{stage_ms_[static_cast<std::size_t>(stage)]};
  return work();
}

void IpcSolver::check_start(const State& x) const {
  const compare::ElementNames names(scene_);
  std::vector<std::string> wrong;
  for (const EdgeThroughTriangle& meeting : intersections(mesh_, x))
    wrong.push_back(describe(topology_, meeting, names) + " intersect");
  if (wrong.empty())
    for (const PrimitivePair& pair : barriers_at(mesh_, shape_, near_pairs(mesh_, x, x, shape_.reach()), x).touching)
      wrong.push_back(describe(topology_, pair, names) + " have no gap");
  if (wrong.empty()) return;
  const std::string beyond = shape_.thickness > 0 ? " beyond the thickness" : "";
  std::string text = "IPC can't start: barriers keep gaps open and can't make any" + beyond + ". Move apart:";
  for (std::size_t i = 0; i < std::min(most_named, wrong.size()); ++i) text += "\n" + wrong[i];
  if (wrong.size() > most_named) text += "\nand " + std::to_string(wrong.size() - most_named) + " more";
  throw compare::InputError(text);
}

IpcStep IpcSolver::step(const State& start, const State& velocity, std::int64_t number) {
  started_ms_ = now_ms();
  begin(start, velocity, number);
  find_barriers(x_);
  start_stiffness();
  forces_.lag_friction(set_, x_, stiffness_);
  move_prescribed();
  forces_.rods().turn(x_);
  return finish(solve());
}

void IpcSolver::set_orientations(std::span<const compare::Quaternion> orientations) {
  forces_.rods().set_start(orientations);
}

std::vector<compare::Quaternion> IpcSolver::orientations() const { return forces_.potential().rods().orientations(); }

double IpcSolver::elapsed_ms() const { return now_ms() - started_ms_; }

void IpcSolver::begin(const State& start, const State& velocity, std::int64_t number) {
  metrics_ = {};
  metrics_.step = number;
  rows_.clear();
  stage_ms_ = {};
  descend_ = false;
  guard_.forget();
  free_.matrix.forget_pattern();
  if (pulled_) pulled_->matrix.forget_pattern();
  x_ = start_ = target_ = start;
  const double h = settings_.time_step;
  const std::vector<Mobility>& mobility = forces_.potential().mobility();
  const Triple<double> fall{h * h * scene_.gravity.x, h * h * scene_.gravity.y, h * h * scene_.gravity.z};
  for (std::size_t v = 0; v < target_.size(); ++v)
    if (mobility[v] == Mobility::free) target_[v] = target_[v] + h * velocity[v] + fall;
  for (const compare::PrescribedMotion& motion : scene_.motions) {
    const State to = widened(prescribed_targets(scene_, motion, static_cast<double>(number) * h));
    for (std::size_t k = 0; k < to.size(); ++k) target_[static_cast<std::size_t>(motion.vertices[k])] = to[k];
  }
  forces_.begin_step(start_, target_, number);
}

std::vector<PrimitivePair> IpcSolver::near(const State& from, const State& to) {
  ++metrics_.broad_phases;
  return timed(IpcStage::broad_phase, [&] { return near_pairs(mesh_, from, to, shape_.reach()); });
}

void IpcSolver::find_barriers(const State& x) {
  const std::vector<PrimitivePair> pairs = near(x, x);
  ++metrics_.discrete_detections;
  set_ = timed(IpcStage::barriers, [&] { return barriers_at(mesh_, shape_, pairs, x); });
}

void IpcSolver::start_stiffness() {
  if (ipc_.stiffness > 0) return;
  if (set_.terms.empty()) {
    stiffness_ = bounds_.lower;
    return;
  }
  timed(IpcStage::derivatives,
        [&] { derivatives_ = forces_.derivatives(x_, {}, 0, HessianProjection::none, std::move(derivatives_)); });
  stiffness_ = initial_stiffness(derivatives_.gradient, forces_.barrier_gradient(x_, set_), bounds_);
}

/// Moves all prescribed vertices by the same share of their displacements; the other vertices stay.
void IpcSolver::move_prescribed() {
  const std::vector<Mobility>& mobility = forces_.potential().mobility();
  State p(x_.size());
  prescribed_way_ = 0;
  for (std::size_t v = 0; v < x_.size(); ++v) {
    if (mobility[v] != Mobility::prescribed) continue;
    p[v] = target_[v] - x_[v];
    prescribed_way_ += dot(p[v], p[v]);
  }
  if (prescribed_way_ == 0) return;
  const std::vector<PrimitivePair> pairs = near(x_, moved(x_, 1, p));
  ++metrics_.continuous_detections;
  const StepBound bound = timed(IpcStage::ccd, [&] { return step_bound(mesh_, pairs, x_, p, shape_.thickness); });
  x_ = moved(x_, bound.share, p);
  if (bound.share == 1)
    for (std::size_t v = 0; v < x_.size(); ++v)
      if (mobility[v] == Mobility::prescribed) x_[v] = target_[v];
  ++metrics_.discrete_detections;
  set_ = timed(IpcStage::barriers, [&] { return barriers_at(mesh_, shape_, pairs, x_); });
  if (bound.share < 1) forces_.pull(Pull{first_pull, State(x_.size())});
}

IpcSolver::Outcome IpcSolver::solve() {
  for (std::int64_t solve = 1;; ++solve) {
    const Outcome outcome = solve_once();
    // If the first iteration of this solve already converged, friction has settled.
    if (outcome != Outcome::converged || solve >= newton_.friction_solves || (solve > 1 && iterations_ <= 1))
      return outcome;
    forces_.lag_friction(set_, x_, stiffness_);
  }
}

IpcSolver::Outcome IpcSolver::solve_once() {
  iterations_ = 0;
  speeds_.clear();
  for (;;)
    if (const std::optional<Outcome> outcome = iterate()) return *outcome;
}

IpcSolver::System& IpcSolver::system() {
  if (!forces_.pull()) return free_;
  if (!pulled_) pulled_ = std::make_unique<System>(all_movable(forces_.potential().unknowns()));
  return *pulled_;
}

std::optional<IpcSolver::Outcome> IpcSolver::iterate() {
  if (options_.iterations) add_row();
  timed(IpcStage::derivatives,
        [&] { derivatives_ = forces_.derivatives(x_, set_, stiffness_, newton_.projection, std::move(derivatives_)); });
  const std::optional<State> p = direction();
  if (!p) return Outcome::indefinite;
  ++metrics_.iterations;
  ++iterations_;
  const double largest = largest_component(as_motion(*p));
  metrics_.residual = largest / settings_.time_step / moving_diagonal_;
  if (!std::isfinite(metrics_.residual)) return Outcome::not_finite;
  const bool is_noise = iterations_ > 1 && largest <= 0x1p-52 * largest_component(x_);
  const bool done = is_noise || converged(*p);
  // Algorithm 1 also takes the last, small step (README.md). With this step the error of the result is of second order.
  const bool is_taken = !done || (ipc_.stopping == IpcStopping::displacement && !is_noise);
  if (is_taken && !take(*p, done)) return Outcome::stuck;
  if (done && pulled_home()) return Outcome::converged;
  return metrics_.iterations >= ipc_.iterations ? std::optional(Outcome::limit) : std::nullopt;
}

/// Moves along p as far as the line search accepts. Returns false if neither Newton's step nor the following step along
/// the gradient makes progress. The last step of a solve may stall, because nothing is left to do.
bool IpcSolver::take(const State& p, bool is_last) {
  const Bounded bound = bounded(p);
  const double share = searched(p, bound);
  if (options_.iterations) rows_.back().share = share, rows_.back().largest_change = largest_motion(of_vertices(p));
  const bool is_nothing = share < smallest_share && !is_last, was_gradient = descend_;
  if (is_nothing)
    note((was_gradient ? "a step along the gradient" : "Newton's step") + std::string(" came to ") + number(share) +
         " of itself" +
         (bound.pair ? ", held by " + describe(topology_, *bound.pair, compare::ElementNames(scene_)) : std::string()) +
         (was_gradient ? "" : "; the next one follows the gradient"));
  descend_ = is_nothing;
  if (is_nothing && was_gradient) return false;
  adapt_stiffness();
  release_pull();
  return true;
}

/// Converts the frames' rotations to lengths: a frame that rotates by ω moves points fixed to it by up to the segment's
/// length times ω.
State IpcSolver::as_motion(State p) const {
  for (std::size_t i = x_.size(); i < p.size(); ++i) p[i] = forces_.potential().rods().length(i - x_.size()) * p[i];
  return p;
}

State IpcSolver::of_vertices(const State& p) const { return {p.begin(), p.begin() + std::ssize(x_)}; }

/// Returns Newton's direction p, or the negative gradient divided by the diagonal. Along the gradient frames do not
/// rotate, because their diagonal does not determine the angle.
std::optional<State> IpcSolver::direction() {
  System& now = system();
  const std::vector<double> diagonal = forces_.diagonal();
  State p(diagonal.size());
  const std::vector<std::size_t>& unknowns = now.matrix.free_vertices();
  if (descend_) {
    for (const std::size_t v : unknowns)
      if (v < x_.size()) p[v] = (-1 / diagonal[v]) * derivatives_.gradient[v];
    return p;
  }
  const bool is_new = timed(IpcStage::assembly, [&] {
    const bool changed = now.matrix.set_stencils(derivatives_.vertices, forces_.potential().elastic_count());
    now.matrix.assemble(diagonal, derivatives_.stencil);
    return changed;
  });
  std::vector<double> right;
  right.reserve(3 * unknowns.size());
  for (const std::size_t v : unknowns)
    for (const double g : derivatives_.gradient[v]) right.push_back(-g);
  return timed(IpcStage::factorization, [&]() -> std::optional<State> {
    if (is_new) now.factor.analyze(now.matrix);
    if (!now.factor.factorize(now.matrix)) return {};
    const std::vector<double> solution = now.factor.solve(right);
    for (std::size_t i = 0; i < unknowns.size(); ++i)
      p[unknowns[i]] = {solution[3 * i], solution[3 * i + 1], solution[3 * i + 2]};
    return p;
  });
}

/// Tests the stopping rule. Both published rules require at least one step, so the first iteration never converges.
bool IpcSolver::converged(const State& p) {
  if (ipc_.stopping == IpcStopping::displacement)
    return iterations_ > 1 && largest_component(as_motion(p)) < ipc_.tolerance * moving_diagonal_ * settings_.time_step;
  double sum = 0;
  for (const Triple<double>& a : as_motion(p)) sum += dot(a, a);
  const double h = settings_.time_step,
               unknowns = static_cast<double>(std::max<std::size_t>(1, system().matrix.free_vertices().size()));
  speeds_.push_back(sum / (unknowns * h * h));
  if (speeds_.size() > window) speeds_.pop_front();
  double mean = 0;
  for (const double s : speeds_) mean += s / static_cast<double>(speeds_.size());
  return iterations_ > 1 && std::sqrt(mean) < ipc_.velocity_tolerance;
}

/// Returns whether there is no pull. With a pull, the converged state minimises only the present Lagrangian. The
/// function then doubles ρ, or updates λ once ρ has reached most_pull.
bool IpcSolver::pulled_home() {
  if (!forces_.pull()) return true;
  Pull pull = *forces_.pull();
  if (pull.stiffness < most_pull) {
    pull.stiffness *= 2;
  } else {
    for (std::size_t v = 0; v < x_.size(); ++v)
      if (forces_.potential().mobility()[v] == Mobility::prescribed)
        pull.force[v] = pull.force[v] - pull.stiffness * forces_.potential().inertia(v) * (x_[v] - target_[v]);
  }
  forces_.pull(std::move(pull));
  return false;
}

void IpcSolver::release_pull() {
  if (!forces_.pull()) return;
  double left = 0;
  for (std::size_t v = 0; v < x_.size(); ++v) {
    if (forces_.potential().mobility()[v] != Mobility::prescribed) continue;
    const Triple<double> lag = target_[v] - x_[v];
    left += dot(lag, lag);
  }
  if (1 - std::sqrt(left / prescribed_way_) >= pulled_enough) forces_.pull({});
}

IpcSolver::Bounded IpcSolver::bounded(const State& p) {
  ++metrics_.continuous_detections;
  const StepBound active = timed(IpcStage::ccd,
                                 [&] { return step_bound(mesh_, set_.active, x_, p, shape_.thickness); });
  const double fastest = largest_motion(of_vertices(p)), free_share = fastest > 0 ? 0.5 * shape_.distance / fastest : 1;
  Bounded bound{std::min(active.share, free_share), active.pair, {}};
  const bool full = ipc_.ccd == IpcCcd::full || free_share < 0.5 * active.share;
  bound.pairs = near(x_, moved(x_, full ? active.share : bound.share, p));
  if (!full) return bound;
  ++metrics_.continuous_detections;
  const StepBound all = timed(IpcStage::ccd,
                              [&] { return step_bound(mesh_, bound.pairs, x_, p, shape_.thickness, active.share); });
  bound.share = all.share;
  if (all.pair) bound.pair = all.pair;
  return bound;
}

/// Appends `share` times the rotations of the frames in p to x.
State IpcSolver::with_frames(State x, double share, const State& p) const {
  for (std::size_t i = x.size(); i < p.size(); ++i) x.push_back(share * p[i]);
  return x;
}

bool IpcSolver::intersects(const State& x) {
  ++metrics_.broad_phases;
  return timed(IpcStage::guard, [&] { return !intersections(mesh_, x).empty(); });
}

/// Returns the accepted share of p. The largest allowed step is also accepted if it raises the energy by no more than
/// its rounding error, because near the minimum this error hides a decrease.
double IpcSolver::searched(const State& p, const Bounded& bound) {
  const IpcEnergy before = timed(IpcStage::line_search, [&] { return forces_.energy(x_, set_, stiffness_); });
  const double noise = derivatives_.energy_noise + value_noise(before);
  for (double share = bound.share; share > 0; share *= 0.5) {
    if (share < smallest_share) return share;
    State trial = moved(x_, share, p);
    ++metrics_.discrete_detections;
    BarrierSet set = timed(IpcStage::barriers, [&] { return barriers_at(mesh_, shape_, bound.pairs, trial); });
    if (!set.touching.empty()) continue;
    const double difference = change(before, timed(IpcStage::line_search, [&] {
                                       return forces_.energy(with_frames(trial, share, p), set, stiffness_);
                                     }));
    if (!(difference < 0 || (share == bound.share && difference <= noise)) || intersects(trial)) continue;
    if (on_accepted) on_accepted(difference, noise);
    forces_.rods().turn_by(with_frames(trial, share, p));
    x_ = std::move(trial);
    set_ = std::move(set);
    return share;
  }
  return 0;
}

void IpcSolver::adapt_stiffness() {
  const std::optional<PrimitivePair> pair = guard_.came_closer(set_);
  if (!pair || ipc_.stiffness > 0) return;
  if (stiffness_ >= bounds_.upper)
    note("κ is at its bound of " + number(bounds_.upper) + " J/m⁴ while " +
         describe(topology_, *pair, compare::ElementNames(scene_)) + " still come closer; it stays there");
  stiffness_ = std::min(bounds_.upper, 2 * stiffness_);
}

}  // namespace ogc::reference
