#include "reference/solvers/vbd_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <tbb/parallel_for.h>

#include "reference/solvers/colouring.hpp"
#include "reference/solvers/potential_batches.hpp"
#include "reference/solvers/step_order.hpp"

namespace ogc::reference {

using compare::Index;
using compare::Vec3f;

VbdSolver::VbdSolver(const compare::Scene& scene, const compare::Topology& topology,
                     const compare::SimulationOptions& options, std::vector<Index> colour)
    : ContactStep(scene, topology, options, stage_count),
      cut_after_(variants_of(settings_).cut_after),
      systems_(potential_, variants_of(settings_).contact_blocks),
      colour_(std::move(colour)) {
  const Colouring rule = variants_of(settings_).colours;
  if (colour_.empty() || rule != Variants{}.colours)
    colour_ = colours_of(scene, potential_.rest(), exclusions_.groups, rule);
  for (std::size_t v = 0; v < exclusions_.groups.size(); ++v) {
    if ((exclusions_.groups[v] == -1) != (colour_.at(v) >= 0))
      throw std::invalid_argument("reference VBD: a colour for each free vertex, and for no other");
    if (colour_[v] < 0) continue;
    const auto c = static_cast<std::size_t>(colour_[v]);
    classes_.resize(std::max(classes_.size(), c + 1));
    classes_[c].push_back(static_cast<Index>(v));
  }
  if (options.iterations) meter_.emplace(scene);
}

void VbdSolver::set_orientations(std::span<const compare::Quaternion> orientations) {
  potential_.rods().set_start(orientations);
}

std::vector<compare::Quaternion> VbdSolver::orientations() const { return potential_.rods().orientations(); }

std::vector<std::string> VbdSolver::stage_names() const { return {"detection", "sweep"}; }

StepResult VbdSolver::step(const std::vector<Vec3f>& start, const std::vector<Vec3f>& velocity, std::int64_t number) {
  begin(start, velocity, number);
  measuring_ms_ = 0;
  if (meter_) orientations_ = orientations();
  residual_ = std::numeric_limits<double>::quiet_NaN();
  guess(GuessEnd::rounds);
  systems_.read_contacts();
  detect_next_ = false;
  measured([&] {
    meter_->begin_step(start, velocity, number, orientations_);
    reference_force_ = meter_->reference_force();
  });
  is_settled_ = false;
  while (metrics_.iterations < settings_.iterations && !is_settled_ && finite()) iterate();
  add_row(false);
  if (finite()) measured([&] { residual_ = meter_->at(x_, orientations()).share; });
  StepResult result = finish(finite() ? compare::step_clean : compare::step_not_finite);
  result.metrics.wall_ms -= measuring_ms_;
  return result;
}

void VbdSolver::iterate() {
  const bool detects = detect_next_;
  if (detects) {
    detect_here();
    systems_.read_contacts();
  }
  add_row(detects);
  before_ = x_;
  cut_ = timed(sweeping, [&] { return sweep(); });
  if (meter_) rows_.back().vertices_cut = static_cast<std::int64_t>(cut_);
  ++metrics_.iterations;
  ++iterations_since_;
  const bool is_cut = is_any_cut(cut_), is_due = detection_due(cut_);
  detect_next_ = is_due || (settings_.detection_deep != 0 && !waits() && is_cut && is_deep_inside());
  is_settled_ = settings_.settled_move > 0 && cut_ == 0 && !detect_next_ && largest_move() <= settings_.settled_move;
}

double VbdSolver::largest_move() const {
  double largest = 0;
  for (const std::size_t v : movable_)
    for (std::size_t axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(x_[v][axis] - before_[v][axis]));
  return largest;
}

bool VbdSolver::is_deep_inside() const {
  return std::ranges::any_of(potential_.volumes(), [&](const VolumeTerm& term) {
    return term.overlap(separation(term.weight, gathered<4>(term.vertex, x_))) > (1 + deep_share) * term.contact_radius;
  });
}

std::size_t VbdSolver::sweep() {
  const State old = x_;
  std::size_t cut = move_prescribed();
  potential_.rods().sweep(x_);
  const SweepView view{old, x_, colour_};
  for (const std::vector<Index>& members : classes_) {
    std::vector<FeasibleRegions::Inside> moved(members.size());
    tbb::parallel_for(std::size_t{0}, members.size(), [&](std::size_t k) {
      const auto v = static_cast<std::size_t>(members[k]);
      const VertexSystem system = systems_.at(members[k], view);
      const auto metric = [&](const Triple<double>& n) { return solved(system, n); };
      const Triple<double> wanted = old[v] + metric(system.force);
      moved[k] = cuts_updates(cut_after_) ? regions_.inside(v, old[v], wanted, metric)
                                          : FeasibleRegions::Inside{wanted};
    });
    for (std::size_t k = 0; k < members.size(); ++k) {
      x_[static_cast<std::size_t>(members[k])] = moved[k].x;
      cut += moved[k].cut;
    }
  }
  return cuts_updates(cut_after_) ? cut : cut + cut_all(old);
}

std::size_t VbdSolver::cut_all(const State& old) {
  std::size_t cut = 0;
  for (const std::vector<Index>& members : classes_)
    for (const Index vertex : members) {
      const auto v = static_cast<std::size_t>(vertex);
      const FeasibleRegions::Inside inside = regions_.inside(v, old[v], x_[v]);
      x_[v] = inside.x;
      cut += inside.cut;
    }
  return cut;
}

template <class Work>
void VbdSolver::measured(Work work) {
  if (!meter_) return;
  const double start = elapsed_ms();
  work();
  measuring_ms_ += elapsed_ms() - start;
}

void VbdSolver::add_row(bool detects) {
  const double now = elapsed_ms() - measuring_ms_;
  measured([&] {
    set_residual(systems_.mean_force(x_));
    compare::IterationMetrics& row = rows_.emplace_back(new_row(detects));
    row.wall_ms = now;
    row.largest_change = std::numeric_limits<double>::quiet_NaN();
    row.share = 1;
  });
}

bool VbdSolver::finite() const {
  return std::all_of(x_.begin(), x_.end(), [](const Triple<double>& p) {
    return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
  });
}

}  // namespace ogc::reference
