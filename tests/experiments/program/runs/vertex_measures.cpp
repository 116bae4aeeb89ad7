// Tests what frames hold of each vertex if a run measures it: its part of the residual, and whether it was cut.
#include <algorithm>
#include <cmath>

#include "compare/record/run_folder.hpp"
#include "compare/record/steps_csv.hpp"
#include "experiments/program/runs/measured_simulation.hpp"
#include "experiments/scenes/registry.hpp"
#include "fast/contestant.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::experiments;
using namespace ogc::tests;

namespace {

double length(const compare::Vec3f& a) { return std::sqrt(double{a.x} * a.x + double{a.y} * a.y + double{a.z} * a.z); }

compare::Vec3f between(const compare::Vec3f& a, const compare::Vec3f& b) { return {b.x - a.x, b.y - a.y, b.z - a.z}; }

void make(const std::filesystem::path& run, const std::string& arguments) {
  const ProgramResult result = run_ogc("run " + arguments + " --out " + run.string());
  INFO(arguments << "\n" << result.err);
  REQUIRE(result.status == 0);
}

}  // namespace

// A part of the residual is rounded to single precision once, by at most u = 2⁻²⁴ of itself; all parts are positive.
// The sums in double err by less than u again.
TEST_CASE("the mean of a frame's residuals is the step's residual, and its cuts are as many as the step's",
          "[property]") {
  const TemporaryFolder folder;
  const std::string bounds = GENERATE("ball", "planes");
  make(folder / "run",
       "cloth_on_sphere --scale smoke --residual --ledger --audit off --set frame_steps=1 --set bounds=" + bounds);
  const compare::RunReader reader(folder / "run");
  const std::vector<compare::StepMetrics> rows = compare::read_steps(folder / "run").rows;
  const std::vector<compare::Index> groups = rigid_groups(reader.scene());
  std::int64_t cut_at_all = 0;
  CHECK(reader.frame(0).residual.empty());
  CHECK(reader.frame(0).cut.empty());
  for (std::size_t i = 1; i < reader.frame_count(); ++i) {
    const compare::Frame frame = reader.frame(i);
    const compare::StepMetrics& row = rows.at(static_cast<std::size_t>(frame.step - 1));
    INFO("step " << frame.step);
    REQUIRE(row.step == frame.step);
    REQUIRE(frame.residual.size() == groups.size());
    double sum = 0, free = 0;
    for (std::size_t v = 0; v < groups.size(); ++v) {
      REQUIRE(std::isnan(frame.residual[v]) == (groups[v] != -1));
      if (groups[v] != -1) continue;
      sum += frame.residual[v], ++free;
    }
    CHECK(sum / free == Approx(row.residual).epsilon(0x1p-23).margin(0));
    CHECK(std::ranges::count(frame.cut, 1.0f) == row.vertices_cut);
    CHECK(std::ranges::count(frame.cut, 0.0f) == std::ssize(frame.cut) - row.vertices_cut);
    cut_at_all += row.vertices_cut;
  }
  CHECK(cut_at_all > 10);
}

// A vertex that the last iteration cut lies on its ball's surface: at b from X_prev, less two attempts' 2⁻²² b, and
// each coordinate rounded to the next float towards X_prev (fast/kernels/truncate.hpp), less than 2⁻²³ of its size.
TEST_CASE("a vertex that is said to be cut lies at its bound", "[property]") {
  compare::Scene scene = make_scene("cloth_on_sphere", Scale::smoke);
  round_to_single(scene);
  const compare::Contestant contestant = measured(fast::contestant(fast::Backend::cpu), {.ledger = true});
  const auto simulation = contestant.start(scene, {});
  CHECK(vertex_measures(*simulation).cut.empty());
  std::size_t cut = 0;
  for (std::int64_t step = 0; step < scene.settings.steps; ++step) {
    simulation->advance(1);
    const compare::Snapshot state = simulation->snapshot();
    const std::vector<float>& is_cut = vertex_measures(*simulation).cut;
    REQUIRE(is_cut.size() == state.positions.size());
    for (std::size_t v = 0; v < is_cut.size(); ++v) {
      if (is_cut[v] == 0) continue;
      CAPTURE(state.step, v);
      const double bound = state.bounds[v], rounding = 2 * 0x1p-22 * bound + 0x1p-23 * length(state.positions[v]);
      CHECK(length(between(state.previous[v], state.positions[v])) >= bound - 2 * rounding);
      ++cut;
    }
  }
  CHECK(cut > 10);
  simulation->restore(simulation->snapshot());
  CHECK(vertex_measures(*simulation).cut.empty());
}

// tests/experiments/program/runs/resume.cpp compares frames with measures of a run that was cut off.
TEST_CASE("frames hold no measures of vertices unless they are asked for", "[unit]") {
  const TemporaryFolder folder;
  make(folder / "run", "cloth_on_sphere --scale smoke --steps 8 --audit off --set frame_steps=4");
  const compare::RunReader reader(folder / "run");
  REQUIRE(reader.frame_count() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(reader.frame(i).residual.empty());
    CHECK(reader.frame(i).cut.empty());
  }
}

// Vertices of the folded mat have several contacts with the same volume there, whose forces are added up in the order
// in which a tree offers them.
TEST_CASE("the trace of a late step of a solid that lies in itself ends in the step's own state", "[property]") {
  const TemporaryFolder folder;
  const std::string mat = "mat_twist --scale smoke --set body_contact=volume --audit off ";
  make(folder / "run", mat + "--steps 348");
  make(folder / "traced",
       mat + "--iterations --steps 349 --from-state " + (folder / "run/frames/frame_000348.h5").string());
  CHECK(compare::read_steps(folder / "traced").rows.at(0).vertices_inside > 0);
}
