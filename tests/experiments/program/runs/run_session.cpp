// Runs a simulation with planted faults. The audit must find each fault, stop the run and keep the last good state.
#include "experiments/program/runs/run_session.hpp"

#include <limits>

#include <nlohmann/json.hpp>

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using compare::Vec3f;

namespace {

constexpr std::int64_t fault_step = 7;

compare::Scene two_bodies() {
  compare::Scene scene;
  scene.name = "two_bodies";
  scene.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0.25}, {1, 0, 0.25}, {0, 1, 0.25}};
  scene.mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  scene.rest_positions = scene.mesh.positions;
  scene.velocities.resize(6);
  compare::Body body;
  body.name = "lower";
  body.vertex_count = 3;
  body.triangle_count = 1;
  scene.bodies.push_back(body);
  body.name = "upper";
  body.first_vertex = 3;
  body.first_triangle = 1;
  scene.bodies.push_back(body);
  scene.settings.steps = 12;
  scene.settings.frame_steps = 3;
  return scene;
}

enum class Fault { none, crossing, beyond_bound, unsafe_bound, uncovered, half_space, not_finite, bound_status };

/// A simulation in which nothing moves until the planted fault.
class FakeSimulation : public compare::Simulation {
 public:
  FakeSimulation(const compare::Scene& scene, Fault fault) : fault_(fault) {
    state_.positions = state_.previous = compare::to_single(scene.mesh.positions);
    state_.velocities.resize(6);
    state_.bounds.assign(6, 0.001f);
    state_.query_radius = 0.02f;
  }
  std::vector<compare::StepMetrics> advance(std::int64_t steps) override {
    std::vector<compare::StepMetrics> rows;
    for (std::int64_t i = 0; i < steps; ++i) {
      compare::StepMetrics row;
      row.step = state_.step + 1;
      row.wall_ms = static_cast<double>(row.step);
      if (row.step == fault_step) row.status = strike();
      rows.push_back(row);
      if (row.status == compare::step_not_finite) return rows;
      state_.step = row.step;
      if (row.status != compare::step_clean) return rows;
    }
    return rows;
  }
  compare::Snapshot snapshot() override { return state_; }
  void restore(const compare::Snapshot& snapshot) override { state_.step = snapshot.step; }
  std::string device() const override { return "nowhere"; }

 private:
  std::uint32_t strike() {
    switch (fault_) {
      case Fault::crossing: state_.positions[3] = state_.previous[3] = {0.25f, 0.25f, -0.25f}; break;
      case Fault::beyond_bound: state_.positions[4].z += 0.0011f; break;
      case Fault::unsafe_bound: state_.bounds[5] = 0.0091f; break;
      case Fault::uncovered: state_.query_radius = 0.3f, state_.bounds[3] = 0.12f; break;
      case Fault::half_space: state_.planes = {{0, 0, 0, 0, 1, 1, 1}, {{{}, {0, 0, 1}, 0.2}}}; break;
      case Fault::not_finite: return compare::step_not_finite;
      case Fault::bound_status: return compare::step_bound_violated;
      case Fault::none: break;
    }
    return compare::step_clean;
  }
  Fault fault_;
  compare::Snapshot state_;
};

experiments::RunSummary run(Fault fault, const tests::TemporaryFolder& folder, experiments::AuditMode audit,
                            bool beside = false, compare::Bounds bounds = compare::Bounds::ball) {
  experiments::RunRequest request;
  request.scene = two_bodies();
  request.scene.settings.bounds = bounds;
  request.audit = audit;
  request.audit_beside = beside;
  request.folder = folder / "run";
  compare::Contestant contestant;
  contestant.start = [fault](const compare::Scene& scene, const compare::SimulationOptions&) {
    return std::make_unique<FakeSimulation>(scene, fault);
  };
  experiments::RunSession session(std::move(request), contestant);
  return session.run();
}

std::vector<std::int64_t> frame_steps(const tests::TemporaryFolder& folder) {
  const compare::RunReader reader(folder / "run");
  std::vector<std::int64_t> steps;
  for (std::size_t i = 0; i < reader.frame_count(); ++i) steps.push_back(reader.frame_step(i));
  return steps;
}

}  // namespace

TEST_CASE("a run without fault audits what it was asked to and stores every frame", "[unit]") {
  const std::vector<std::pair<experiments::AuditMode, std::size_t>> modes{{experiments::AuditMode::every, 12},
                                                                          {experiments::AuditMode::frame, 4},
                                                                          {experiments::AuditMode::end, 1},
                                                                          {experiments::AuditMode::off, 0}};
  for (const bool beside : {false, true})
    for (const auto& [mode, states] : modes) {
      const tests::TemporaryFolder folder;
      const experiments::RunSummary summary = run(Fault::none, folder, mode, beside);
      CHECK(summary.status == "finished");
      CHECK(summary.audited_states == states);
      CHECK(summary.guarantee_kept == (states > 0 ? std::optional(true) : std::nullopt));
      CHECK(frame_steps(folder) == std::vector<std::int64_t>{0, 3, 6, 9, 12});
      CHECK(summary.median_ms == 6.5);
      CHECK(summary.worst_step == 12);
    }
}

TEST_CASE("the audit catches each planted fault, names it, and keeps the last good state", "[property]") {
  const auto [fault, words] = GENERATE(
      table<Fault, std::string>({{Fault::crossing, "upper"},
                                 {Fault::beyond_bound, "vertex 1 of body 'upper' (4 in the scene)"},
                                 {Fault::unsafe_bound, "vertex 2 of body 'upper' (5 in the scene)"}}));
  const bool beside = GENERATE(false, true);
  const tests::TemporaryFolder folder;
  const experiments::RunSummary summary = run(fault, folder, experiments::AuditMode::every, beside);
  INFO(summary.failure);
  CHECK(summary.guarantee_kept == false);
  CHECK(summary.last_step == fault_step - 1);
  CHECK(tests::contains(summary.failure, {"step 7", words, "failed_step_7.ply"}));
  CHECK(frame_steps(folder) == std::vector<std::int64_t>{0, 3, 6});
  CHECK(std::filesystem::exists(folder / "run/failed_step_7.ply"));
  CHECK(compare::RunReader(folder / "run").provenance().status.starts_with("failed: "));
  CHECK(summary.failed_states == 1);
}

// The sheets are 0.25 m apart; γ_p times this distance is 0.1125 m.
TEST_CASE("with planes the audit lists pairs that nothing holds apart, and half-spaces that are not kept",
          "[property]") {
  const auto [fault, words] = GENERATE(table<Fault, std::string>(
      {{Fault::crossing, "upper"},
       {Fault::beyond_bound, "vertex 1 of body 'upper' (4 in the scene)"},
       {Fault::uncovered, "pairs that neither a plane nor balls hold apart; the first: vertex 0 of body 'lower'"},
       {Fault::half_space, "1 half-space not kept at the detection, 1 half-space not kept now"}}));
  const tests::TemporaryFolder folder;
  const experiments::RunSummary summary = run(fault, folder, experiments::AuditMode::every, false,
                                              compare::Bounds::planes);
  INFO(summary.failure);
  CHECK(summary.guarantee_kept == false);
  CHECK(summary.last_step == fault_step - 1);
  CHECK(tests::contains(summary.failure, {words}));
}

TEST_CASE("with bounds off only intersections are found, and nothing is guaranteed", "[unit]") {
  const tests::TemporaryFolder folder, other;
  const auto off = compare::Bounds::off;
  const experiments::RunSummary kept = run(Fault::unsafe_bound, folder, experiments::AuditMode::every, false, off);
  CHECK(kept.last_step == 12);
  CHECK(tests::contains(describe(kept), {"no guarantee (bounds=off)"}));
  CHECK(run(Fault::crossing, other, experiments::AuditMode::every, false, off).last_step == fault_step - 1);
}

TEST_CASE("where only frames are audited a fault is found at the next frame", "[unit]") {
  const tests::TemporaryFolder folder;
  const experiments::RunSummary summary = run(Fault::crossing, folder, experiments::AuditMode::frame);
  CHECK(tests::contains(summary.failure, {"step 9"}));
  CHECK(frame_steps(folder) == std::vector<std::int64_t>{0, 3, 6});
}

TEST_CASE("a step that is not finite stops the run with its number and keeps the state before it", "[unit]") {
  for (const experiments::AuditMode mode :
       {experiments::AuditMode::every, experiments::AuditMode::frame, experiments::AuditMode::off}) {
    const tests::TemporaryFolder folder;
    const experiments::RunSummary summary = run(Fault::not_finite, folder, mode, true);
    CHECK(tests::contains(summary.failure, {"not a number", "step 7"}));
    CHECK(summary.last_step == 6);
    CHECK(frame_steps(folder) == std::vector<std::int64_t>{0, 3, 6});
    CHECK(summary.guarantee_kept == (mode == experiments::AuditMode::off ? std::nullopt : std::optional(true)));
  }
}

TEST_CASE("a run that ends before a state is audited says so, and calls an audit off only where it is", "[unit]") {
  const tests::TemporaryFolder ended, off;
  const experiments::RunSummary none = run(Fault::not_finite, ended, experiments::AuditMode::end);
  CHECK(none.audited_states == 0);
  CHECK(tests::contains(describe(none), {"not checked (audit end, but the run came to no state to audit)"}));
  CHECK(to_json(none).at("audit").at("mode") == "end");
  CHECK(
      tests::contains(describe(run(Fault::not_finite, off, experiments::AuditMode::off)), {"not checked (audit off)"}));
}

TEST_CASE("a step whose own certificate fails breaks the guarantee, audited or not", "[unit]") {
  const tests::TemporaryFolder folder;
  const experiments::RunSummary summary = run(Fault::bound_status, folder, experiments::AuditMode::off);
  CHECK(summary.guarantee_kept == false);
  CHECK(tests::contains(summary.failure, {"bound", "step 7"}));
  CHECK(frame_steps(folder) == std::vector<std::int64_t>{0, 3, 6});
}
