// Tests that long runs react to signals. A run checks for signals within a second, or after each step if a step takes
// longer, even if the next frame is many steps away.
#include "experiments/program/runs/pace.hpp"

#include <chrono>
#include <fstream>
#include <random>
#include <thread>

#include "compare/files/bytes.hpp"
#include "compare/record/checkpoint.hpp"
#include "compare/record/steps_csv.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/runs/run_options.hpp"
#include "experiments/scenes/registry.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/cut_runs.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;
using experiments::Pace;
using Clock = std::chrono::steady_clock;

namespace {

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// One call of `advance`: the state of the run folder when the call began, and the call's duration.
struct Call {
  std::int64_t before = 0, steps = 0;
  double seconds = 0;
  std::size_t rows = 0;
  std::int64_t saved = 0;  ///< step of the checkpoint
};

/// Simulates one triangle at rest. Each step takes the given time.
class SlowSimulation : public compare::Simulation {
 public:
  SlowSimulation(const compare::Scene& scene, std::filesystem::path folder, std::chrono::milliseconds step,
                 std::vector<Call>& calls)
      : folder_(std::move(folder)), time_(step), calls_(calls) {
    state_.positions = state_.previous = compare::to_single(scene.mesh.positions);
    state_.velocities.resize(3);
    state_.bounds.assign(3, 0.001f);
    state_.query_radius = 0.02f;
  }
  std::vector<compare::StepMetrics> advance(std::int64_t steps) override {
    calls_.push_back({state_.step, steps, 0, compare::read_steps(folder_).rows.size(),
                      compare::read_checkpoint(folder_, compare::scene_digest(folder_)).state.step});
    const Clock::time_point begin = Clock::now();
    std::vector<compare::StepMetrics> rows(static_cast<std::size_t>(steps));
    for (compare::StepMetrics& row : rows) {
      std::this_thread::sleep_for(time_);
      row.step = ++state_.step;
    }
    calls_.back().seconds = seconds_since(begin);
    return rows;
  }
  compare::Snapshot snapshot() override { return state_; }
  void restore(const compare::Snapshot& snapshot) override { state_.step = snapshot.step; }
  std::string device() const override { return "nowhere"; }

 private:
  std::filesystem::path folder_;
  std::chrono::milliseconds time_;
  std::vector<Call>& calls_;
  compare::Snapshot state_;
};

experiments::RunRequest slow_request(const std::filesystem::path& folder, std::int64_t steps) {
  experiments::RunRequest request;
  compare::Scene& scene = request.scene;
  scene.name = "slow";
  scene.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.mesh.triangles = {{0, 1, 2}};
  scene.rest_positions = scene.mesh.positions;
  scene.velocities.resize(3);
  compare::Body body;
  body.name = "triangle";
  body.vertex_count = 3;
  body.triangle_count = 1;
  scene.bodies = {body};
  scene.settings.steps = steps;
  scene.settings.frame_steps = 100000;
  request.folder = folder;
  request.checkpoint_seconds = 0.2;
  return request;
}

std::vector<Call> run_slowly(const std::filesystem::path& folder, std::int64_t steps, std::chrono::milliseconds step) {
  std::vector<Call> calls;
  compare::Contestant contestant;
  contestant.start = [&](const compare::Scene& scene, const compare::SimulationOptions&) {
    return std::make_unique<SlowSimulation>(scene, folder, step, calls);
  };
  experiments::RunSession session(slow_request(folder, steps), contestant);
  CHECK(session.run().status == "finished");
  return calls;
}

/// Returns rows in the format of steps.csv, without times.
std::string rows_text(std::vector<compare::StepMetrics> rows) {
  for (compare::StepMetrics& row : rows) row.wall_ms = 0;
  return compare::step_lines(rows, 0);
}

}  // namespace

TEST_CASE("a call asks for a quarter of a second of steps, for one at least and for 64 at most", "[unit]") {
  Pace pace;
  CHECK(pace.steps() == 1);
  const auto after = [&](std::int64_t steps, double seconds) { return pace.measured(steps, seconds), pace.steps(); };
  CHECK(after(1, 0.01) == 25);
  CHECK(after(25, 2.5) == 2);
  CHECK(after(2, 7) == 1);
  CHECK(after(1, 1e-7) == 64);
  CHECK(after(64, 0) == 64);
}

TEST_CASE("rows and checkpoints are written while a run is far from its next frame, and no call lasts long",
          "[property]") {
  const TemporaryFolder folder;
  const std::vector<Call> calls = run_slowly(folder / "run", 250, std::chrono::milliseconds(4));
  REQUIRE(calls.size() >= 4);
  std::int64_t oldest = 0;
  for (const Call& call : calls) {
    INFO("call after step " << call.before << ": " << call.steps << " steps, " << call.seconds << " s");
    CHECK(call.seconds < 1);
    CHECK(call.rows == static_cast<std::size_t>(call.before));
    oldest = std::max(oldest, call.before - call.saved);
  }
  CHECK(calls.back().saved > 0);
  CHECK(oldest < 200);
  const std::vector<Call> slow = run_slowly(folder / "slow", 3, std::chrono::milliseconds(300));
  for (const Call& call : slow) CHECK(call.steps == 1);
}

TEST_CASE("where a simulation pauses changes no bit of its states and rows, whoever computes it", "[property]") {
  const std::string solver = GENERATE("vbd", "newton", "ipc", "reference_vbd");
  experiments::RunOptions options;
  options.solver = solver;
  const compare::Scene scene = experiments::make_scene("cloth_on_sphere", experiments::Scale::smoke);
  constexpr std::int64_t steps = 6;
  const auto whole = experiments::contestant_of(options, {}).start(scene, {}),
             cut = experiments::contestant_of(options, {}).start(scene, {});
  const std::vector<compare::StepMetrics> expected = whole->advance(steps);
  const unsigned seed = std::random_device{}();
  INFO(solver << ", seed " << seed);
  std::mt19937 random(seed);
  std::vector<compare::StepMetrics> rows;
  while (static_cast<std::int64_t>(rows.size()) < steps) {
    const std::int64_t left = steps - static_cast<std::int64_t>(rows.size());
    for (compare::StepMetrics& row :
         cut->advance(std::min<std::int64_t>(left, 1 + static_cast<std::int64_t>(random() % 3))))
      rows.push_back(std::move(row));
  }
  CHECK(rows_text(rows) == rows_text(expected));
  CHECK(cut->snapshot().positions == whole->snapshot().positions);
  CHECK(cut->snapshot().velocities == whole->snapshot().velocities);
}

TEST_CASE(
    "Ctrl-C stops every solver within a second or a step, however far its next frame is, and keeps what was computed",
    "[property]") {
  const TemporaryFolder folder;
  const std::string solver = GENERATE("vbd", "newton", "ipc", "reference_vbd");
  const std::filesystem::path run = folder / "run";
  const Clock::time_point begin = Clock::now();
  const ProgramResult result = run_ogc(
      "run cloth_on_sphere --scale smoke --steps 100000 --set frame_steps=100000 --solver " + solver + " --out " +
          run.string(),
      "timeout --foreground --preserve-status -k 20 -s INT 2 ");
  INFO(solver << "\n" << result.err);
  CHECK(result.status == 130);
  CHECK(seconds_since(begin) < 10);  // 2 s until the signal, 1 s to react; the rest is for a busy machine
  CHECK(contains(result.err, {"stops after step"}));
  const compare::RunReader reader(run);
  CHECK(reader.provenance().status == "interrupted");
  REQUIRE(reader.frame_count() == 2);
  const std::int64_t last = reader.frame_step(1);
  CHECK(last > 0);
  CHECK(compare::read_steps(run).rows.size() == static_cast<std::size_t>(last));
  CHECK(compare::read_checkpoint(run, compare::scene_digest(run)).state.step == last);
}

TEST_CASE("a run whose frames lie far apart resumes between them, and counts no audit that a whole run does not make",
          "[property]") {
  const TemporaryFolder folder;
  check_cut_runs(folder / "runs", "cloth_on_sphere --scale smoke --steps 40 --set frame_steps=1000 --audit frame",
                 {"KILL", "INT"});
}
