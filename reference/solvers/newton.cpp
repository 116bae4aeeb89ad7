#include "reference/solvers/newton.hpp"

#include <string>

#include <tbb/task_arena.h>

#include "reference/solvers/newton_solver.hpp"

namespace ogc::reference {
namespace {

class NewtonSimulation : public compare::Simulation {
 public:
  NewtonSimulation(compare::Scene scene, const compare::SimulationOptions& options)
      : scene_(std::move(scene)), topology_(compare::build_topology(scene_)), profile_(options.profile), solver_(scene_, topology_, options) {
    state_.positions = compare::to_single(scene_.mesh.positions);
    state_.velocities = compare::to_single(scene_.velocities);
    state_.previous = state_.positions;
    state_.bounds.assign(state_.positions.size(), 0);
  }

  std::vector<compare::StepMetrics> advance(std::int64_t steps) override {
    std::vector<compare::StepMetrics> rows;
    for (std::int64_t k = 0; k < steps; ++k) {
      NewtonStep step = solver_.step(state_.positions, state_.velocities, state_.step + 1);
      const bool good = step.metrics.status == compare::step_clean;
      rows.push_back(std::move(step.metrics));
      if (!good) break;
      state_ = {state_.step + 1, std::move(step.position), std::move(step.velocity), std::move(step.detected.previous), std::move(step.detected.bound),
                step.query_radius};
    }
    return rows;
  }

  compare::Snapshot snapshot() override { return state_; }

  void restore(const compare::Snapshot& snapshot) override {
    state_ = snapshot;
    state_.previous = state_.positions;
    state_.bounds.assign(state_.positions.size(), 0);
  }

  std::vector<std::string> stage_names() const override { return profile_ ? newton_stage_names() : std::vector<std::string>{}; }
  std::string device() const override { return std::to_string(tbb::this_task_arena::max_concurrency()) + " threads"; }

 private:
  compare::Scene scene_;
  compare::Topology topology_;
  bool profile_;
  NewtonSolver solver_;
  compare::Snapshot state_;
};

}  // namespace

std::unique_ptr<compare::Simulation> start_newton(const compare::Scene& scene, const compare::SimulationOptions& options) {
  compare::Scene rounded = scene;
  round_to_single(rounded);
  return std::make_unique<NewtonSimulation>(std::move(rounded), options);
}

}  // namespace ogc::reference
