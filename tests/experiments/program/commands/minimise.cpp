#include <algorithm>
#include <functional>
#include <map>

#include "compare/files/bytes.hpp"
#include "compare/stages/sweep.hpp"
#include "experiments/program/runs/to_minimiser.hpp"
#include "experiments/scenes/registry.hpp"
#include "fast/contestant.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::experiments;
using namespace ogc::tests;

namespace {

constexpr std::int64_t most_sweeps = 5000;

compare::Snapshot state_after(const compare::Contestant& contestant, const compare::Scene& scene, std::int64_t steps) {
  const auto simulation = contestant.start(scene, {.energies = false});
  simulation->advance(steps);
  return simulation->snapshot();
}

/// The contestant with its sweeps asked another question than the one that it was given.
compare::Contestant misled(compare::Contestant contestant,
                           std::function<void(compare::SweepIn&, compare::RestStateOut&)> change) {
  contestant.sweep = [sweep = contestant.sweep, change](compare::SweepIn in) {
    compare::RestStateOut rest = *in.rest;
    in.rest = &rest;
    change(in, rest);
    return sweep(in);
  };
  return contestant;
}

}  // namespace

TEST_CASE("sweeps end at the minimiser up to single precision, and those of a force a thousandth too small do not",
          "[agreement]") {
  const compare::Contestant fast = fast::contestant(fast::Backend::cpu);
  const std::vector<compare::Contestant> wrong{
      misled(fast,
             [](compare::SweepIn&, compare::RestStateOut& rest) {
               for (compare::MeetingMaterial& meeting : rest.meetings) meeting.stiffness *= 0.999F;
             }),
      misled(fast,
             [](compare::SweepIn&, compare::RestStateOut& rest) {
               for (compare::MeetingMaterial& meeting : rest.meetings) meeting.friction *= 0.99F;
             }),
      misled(fast, [](compare::SweepIn& in, compare::RestStateOut&) { in.edge_edge = in.edge_edge.subspan(1); })};
  const std::map<std::string, std::int64_t> steps{
      {"cloth_on_sphere", 22}, {"three_cloths_on_sphere", 22}, {"twist", 600}};
  for (const auto& [name, step] : steps) {
    compare::Scene scene = make_scene(name, Scale::smoke);
    // In cloth that collapses contacts press more, so that a wrong one moves more.
    for (compare::Body& body : scene.bodies) body.material.membrane = compare::MembraneModel::st_venant_kirchhoff;
    round_to_single(scene);
    const compare::Snapshot start = state_after(fast, scene, step);
    const ToMinimiser found = distance_to_minimiser(fast, scene, start, most_sweeps);
    INFO(name << ": " << found.largest_distance << " m, rounding " << found.rounding << " m");
    CHECK(found.step == step + 1);
    CHECK(found.edge_edge_contacts > 20);
    CHECK((found.reached_floor && found.newton_converged));
    CHECK(found.residual < found.residual_before);
    CHECK(found.smallest_eigenvalue_between > 0);
    CHECK(found.bound_by_energy < found.bound_by_gradient);
    CHECK(found.largest_distance <= found.bound_by_energy);
    CHECK(found.rms_distance <= found.largest_distance);
    // A vertex stands still where its own step is below half a spacing, and neighbours add up to some of these: at most
    // 8 are measured here. The weakest of the faults, k_c in twist, moves a vertex by 28.
    CHECK(found.largest_distance <= 16 * found.rounding);
    CHECK(found.largest_distance_own_friction <= 16 * found.rounding);
    for (const compare::Contestant& one : wrong) {
      const ToMinimiser off = distance_to_minimiser(one, scene, start, most_sweeps);
      CHECK(off.largest_distance > 16 * off.rounding);
      CHECK(off.largest_distance <= off.bound_by_energy);
    }
  }
}

TEST_CASE("ogc minimise tells the distance from frames of a run, as text, JSON and a table", "[agreement]") {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string(), table = (folder / "table.csv").string();
  REQUIRE(run_ogc("run cloth_on_sphere --scale smoke --steps 21 --audit off --out " + run).status == 0);
  const std::string frames = run + "/frames/frame_000020.h5 " + run + "/frames/frame_000021.h5";
  const ProgramResult done = run_ogc("minimise --json --csv " + table + " " + frames);
  INFO(done.err);
  REQUIRE(done.status == 0);
  const std::string rows = compare::read_bytes(table);
  CHECK(contains(rows, {"scene,step [1],backend,", ",largest_distance [m],"}));
  CHECK(contains(rows, {"\ncloth_on_sphere,21,cpu,", "\ncloth_on_sphere,22,cpu,"}));
  CHECK(std::ranges::count(rows, '\n') == 3);
  CHECK(contains(done.out, {"\"step\":21", "\"step\":22", "\"bound_by_energy\":"}));
  const ProgramResult few = run_ogc("minimise --sweeps 10 " + run + "/frames/frame_000020.h5");
  CHECK(few.status == 0);
  CHECK(contains(few.out, {"largest_distance", "reached_floor", "no"}));
  CHECK(contains(few.err, {"the force still falls after 10 sweeps; give more --sweeps"}));
}

TEST_CASE("ogc minimise refuses what is no frame of a run by its name", "[unit]") {
  const TemporaryFolder folder;
  const std::string text = folder.write("frame.h5", "no frame").string();
  for (const std::string& arguments : {std::string(), " " + text, std::string(" none.h5"), " --sweeps 0 " + text}) {
    const ProgramResult refused = run_ogc("minimise" + arguments);
    INFO(arguments << ": " << refused.err);
    CHECK(refused.status == 2);
    CHECK(refused.out.empty());
  }
  CHECK(contains(run_ogc("minimise " + text).err, {"frame.h5"}));
}
