#include "reference/ipc/simulation.hpp"

#include <string>

#include <tbb/task_arena.h>

#include "compare/problem/readers.hpp"
#include "compare/problem/volumes.hpp"
#include "reference/ipc/solver.hpp"
#include "reference/solvers/detection.hpp"

namespace ogc::reference {
namespace {

compare::Scene rounded_scene(compare::Scene scene) {
  round_to_single(scene);
  return scene;
}

std::vector<compare::Vec3> as_vectors(const State& state) {
  std::vector<compare::Vec3> vectors;
  vectors.reserve(state.size());
  for (const Triple<double>& a : state) vectors.push_back({a[0], a[1], a[2]});
  return vectors;
}

State as_state(const std::vector<compare::Vec3>& vectors) {
  State state;
  state.reserve(vectors.size());
  for (const compare::Vec3& v : vectors) state.push_back({v.x, v.y, v.z});
  return state;
}

class IpcSimulation : public compare::Simulation {
 public:
  IpcSimulation(const compare::Scene& scene, const compare::SimulationOptions& options)
      : scene_(rounded_scene(scene)),
        topology_(compare::build_topology(scene_)),
        profile_(options.profile),
        solver_(scene_, topology_, options) {
    set_state(0, widened(compare::to_single(scene_.mesh.positions)), widened(compare::to_single(scene_.velocities)),
              {});
  }

  std::vector<compare::StepMetrics> advance(std::int64_t steps) override {
    std::vector<compare::StepMetrics> metrics_rows;
    for (std::int64_t k = 0; k < steps; ++k) {
      solver_.set_orientations(orientations_);
      IpcStep step = solver_.step(position_, velocity_, number_ + 1);
      const bool good = step.metrics.status == compare::step_clean;
      metrics_rows.push_back(std::move(step.metrics));
      if (!good) break;
      ++number_;
      position_ = std::move(step.position);
      velocity_ = std::move(step.velocity);
      orientations_ = solver_.orientations();
    }
    return metrics_rows;
  }

  /// Returns the state with bounds of 0, because IPC has no bounds.
  compare::Snapshot snapshot() override {
    const std::vector<compare::Vec3f> position = rounded(position_);
    return {number_,
            position,
            rounded(velocity_),
            position,
            std::vector<float>(position.size(), 0),
            0,
            {},
            as_vectors(position_),
            as_vectors(velocity_),
            {},
            orientations_};
  }

  /// Restores a snapshot: to the last bit if it has exact positions, otherwise from rounded numbers, as in a stored
  /// frame.
  void restore(const compare::Snapshot& snapshot) override {
    if (snapshot.exact_positions.empty())
      return set_state(snapshot.step, widened(snapshot.positions), widened(snapshot.velocities), snapshot.orientations);
    set_state(snapshot.step, as_state(snapshot.exact_positions), as_state(snapshot.exact_velocities),
              snapshot.orientations);
  }

  std::vector<std::string> stage_names() const override {
    return profile_ ? ipc_stage_names() : std::vector<std::string>{};
  }
  std::string device() const override { return std::to_string(tbb::this_task_arena::max_concurrency()) + " threads"; }

 private:
  void set_state(std::int64_t number, State position, State velocity,
                 const std::vector<compare::Quaternion>& orientations) {
    solver_.set_orientations(orientations);
    orientations_ = solver_.orientations();
    number_ = number;
    position_ = std::move(position);
    velocity_ = std::move(velocity);
    solver_.check_start(position_);
  }

  compare::Scene scene_;
  compare::Topology topology_;
  bool profile_;
  IpcSolver solver_;
  std::int64_t number_ = 0;
  State position_, velocity_;
  std::vector<compare::Quaternion> orientations_;  ///< rounded; rods' frames have no gap that rounding could remove
};

}  // namespace

std::unique_ptr<compare::Simulation> start_ipc(const compare::Scene& scene, const compare::SimulationOptions& options) {
  refuse_unread(scene.settings, "ipc");
  refuse_volumes(scene, "ipc",
                 "whose barrier lets nothing enter a body: leave the body a surface (--set body_contact=surface)");
  return std::make_unique<IpcSimulation>(scene, options);
}

}  // namespace ogc::reference
