#include "reference/simulation.hpp"

#include <string>

#include <tbb/task_arena.h>

#include "compare/problem/error.hpp"
#include "compare/problem/readers.hpp"
#include "compare/problem/rods.hpp"
#include "reference/solvers/newton/solver.hpp"
#include "reference/solvers/vbd_solver.hpp"

namespace ogc::reference {
namespace {

template <class Solver>
class ReferenceSimulation : public compare::Simulation {
 public:
  template <class... More>
  ReferenceSimulation(const compare::Scene& scene, const compare::SimulationOptions& options, More&&... more)
      : scene_(rounded_scene(scene)),
        topology_(compare::build_topology(scene_)),
        profile_(options.profile),
        solver_(scene_, topology_, options, std::forward<More>(more)...) {
    state_.positions = compare::to_single(scene_.mesh.positions);
    state_.velocities = compare::to_single(scene_.velocities);
    state_.previous = state_.positions;
    state_.bounds.assign(state_.positions.size(), 0);
    state_.orientations = solver_.orientations();
  }

  std::vector<compare::StepMetrics> advance(std::int64_t steps) override {
    std::vector<compare::StepMetrics> rows;
    for (std::int64_t k = 0; k < steps; ++k) {
      solver_.set_orientations(state_.orientations);
      StepResult step = solver_.step(state_.positions, state_.velocities, state_.step + 1);
      const bool good = step.metrics.status == compare::step_clean;
      rows.push_back(std::move(step.metrics));
      if (!good) break;
      state_ = {state_.step + 1,
                std::move(step.position),
                std::move(step.velocity),
                std::move(step.detected.previous),
                std::move(step.detected.bound),
                step.query_radius};
      state_.planes = std::move(step.detected.planes);
      state_.orientations = std::move(step.orientation);
    }
    return rows;
  }

  compare::Snapshot snapshot() override { return state_; }

  void restore(const compare::Snapshot& snapshot) override {
    state_ = snapshot;
    state_.previous = state_.positions;
    state_.bounds.assign(state_.positions.size(), 0);
    state_.planes = {};
    solver_.set_orientations(snapshot.orientations);
    state_.orientations = solver_.orientations();
  }

  std::vector<std::string> stage_names() const override {
    return profile_ ? solver_.stage_names() : std::vector<std::string>{};
  }
  std::string device() const override { return std::to_string(tbb::this_task_arena::max_concurrency()) + " threads"; }

 private:
  static compare::Scene rounded_scene(compare::Scene scene) {
    round_to_single(scene);
    return scene;
  }

  compare::Scene scene_;
  compare::Topology topology_;
  bool profile_;
  Solver solver_;
  compare::Snapshot state_;
};

/// Throws compare::InputError for rods with newton_truncation=pair, because pairs with segments of rods have no planes.
void refuse_rods_between_planes(const compare::Scene& scene) {
  if (has_rods(scene) && moves_planes(newton_settings(scene.settings).truncation))
    throw compare::InputError("setting 'truncation' can't be 'pair' with rods; leave it out, or the rods");
}

}  // namespace

std::unique_ptr<compare::Simulation> start_newton(const compare::Scene& scene,
                                                  const compare::SimulationOptions& options) {
  refuse_unread(scene.settings, "newton");
  refuse_rods_between_planes(scene);
  return std::make_unique<ReferenceSimulation<NewtonSolver>>(scene, options);
}

std::unique_ptr<compare::Simulation> start_penalty(const compare::Scene& scene,
                                                   const compare::SimulationOptions& options) {
  refuse_unread(scene.settings, "penalty");
  return std::make_unique<ReferenceSimulation<NewtonSolver>>(scene, options, NewtonSteps::whole);
}

std::unique_ptr<compare::Simulation> start_vbd(const compare::Scene& scene, const compare::SimulationOptions& options,
                                               std::vector<compare::Index> colour) {
  refuse_unread(scene.settings, "reference_vbd");
  return std::make_unique<ReferenceSimulation<VbdSolver>>(scene, options, std::move(colour));
}

}  // namespace ogc::reference
