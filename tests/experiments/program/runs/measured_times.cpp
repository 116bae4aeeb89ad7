// Tests the times that a run measures: of iterations, and of steps that are repeated.
#include <cmath>
#include <fstream>
#include <sstream>

#include "compare/record/run_folder.hpp"
#include "compare/record/steps_csv.hpp"
#include "experiments/program/runs/measured_simulation.hpp"
#include "experiments/scenes/registry.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::experiments;
using namespace ogc::tests;

namespace {

/// A simulation whose steps take the given times in turn. With `drifts` a step that follows a restore ends elsewhere.
class Scripted : public compare::Simulation {
 public:
  Scripted(std::vector<double> times, bool drifts) : times_(std::move(times)), drifts_(drifts) {
    state_.positions.resize(1);
  }

  std::vector<compare::StepMetrics> advance(std::int64_t) override {
    compare::StepMetrics row;
    row.step = ++state_.step;
    row.wall_ms = times_.at(at_++);
    row.stage_ms = {row.wall_ms / 2};
    row.repeats = at_ == 1 ? 1 : 0;
    state_.positions[0].x += 1;
    return {row};
  }
  compare::Snapshot snapshot() override { return state_; }
  void restore(const compare::Snapshot& snapshot) override {
    state_ = snapshot;
    if (drifts_) state_.positions[0].x += 0.5f;
  }
  std::vector<std::string> stage_names() const override { return {"detection"}; }
  std::string device() const override { return "none"; }

 private:
  std::vector<double> times_;
  bool drifts_;
  std::size_t at_ = 0;
  compare::Snapshot state_;
};

std::vector<compare::StepMetrics> advanced(std::vector<double> times, std::int64_t repeats, std::int64_t steps,
                                           bool drifts = false) {
  compare::Contestant contestant;
  contestant.start = [&](const compare::Scene&, const compare::SimulationOptions&) {
    return std::make_unique<Scripted>(times, drifts);
  };
  return measured(contestant, {.repeats = repeats}).start(make_scene("twist", Scale::smoke), {})->advance(steps);
}

/// Returns the rows of iterations.csv, as texts.
std::vector<std::vector<std::string>> iteration_rows(const std::filesystem::path& run) {
  std::ifstream file(run / "iterations.csv");
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    std::istringstream parts(line);
    rows.emplace_back();
    for (std::string part; std::getline(parts, part, ',');) rows.back().push_back(part);
  }
  return rows;
}

}  // namespace

TEST_CASE("the time of a repeated step is the median of its repetitions, without its first time", "[unit]") {
  const std::vector<compare::StepMetrics> rows = advanced({900, 5, 1, 3, 800, 2, 2, 7}, 3, 2);
  REQUIRE(rows.size() == 2);
  CHECK(rows[0].wall_ms == 3);
  CHECK(rows[0].stage_ms == std::vector<double>{1.5});
  CHECK(rows[0].repeats == 1);
  CHECK(rows[1].wall_ms == 2);
  CHECK(rows[1].step == 2);
  CHECK(advanced({900, 4, 6}, 2, 1)[0].wall_ms == 4);
  CHECK_THROWS_WITH(advanced({1, 1, 1}, 2, 1, true), ContainsSubstring("step 1 ends in another state"));
}

TEST_CASE("rows of iterations have measured times with --profile, and none without it", "[property]") {
  const TemporaryFolder folder;
  const std::string scene = "run cloth_on_sphere --scale smoke --steps 24 --audit off --iterations";
  const auto made = [&](const std::string& name, const std::string& more) {
    const ProgramResult result = run_ogc(scene + more + " --out " + (folder / name).string());
    INFO(result.err);
    REQUIRE(result.status == 0);
    return iteration_rows(folder / name);
  };
  const auto without = made("without", ""), with = made("with", " --profile --repeats 2");
  REQUIRE(without.size() == with.size());
  const std::vector<compare::StepMetrics> steps = compare::read_steps(folder / "with").rows;
  bool detects = false;
  for (std::size_t i = 1; i < with.size(); ++i) {
    INFO("row " << i);
    CHECK(without[i][2] == "nan");
    const double time = std::stod(with[i][2]);
    const std::size_t step = std::stoul(with[i][0]);
    CHECK(time > 0);
    CHECK(time <= steps.at(step - 1).wall_ms);
    if (with[i][1] != "0") CHECK(time > std::stod(with[i - 1][2]));
    CHECK(std::equal(with[i].begin() + 3, with[i].end(), without[i].begin() + 3, without[i].end()));
    detects = detects || (with[i][11] == "1" && with[i][1] != "0");
  }
  CHECK(detects);
  const std::vector<compare::StepMetrics> once = compare::read_steps(folder / "without").rows;
  for (std::size_t i = 0; i < once.size(); ++i) CHECK(once[i].discrete_detections == steps[i].discrete_detections);
  CHECK(compare::RunReader(folder / "with").provenance().extra.at("time_repeats") == "2");
}

TEST_CASE("a number of repetitions that is none is refused", "[unit]") {
  for (const std::string count : {"0", "-1", "1001", "few"}) {
    const ProgramResult result = run_ogc("run twist --scale smoke --repeats " + count);
    INFO(result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {"--repeats"}));
  }
}
