// Tests random offsets of a run's start (--jitter): their size, which vertices they move, and that their bits are
// reproducible.
#include "experiments/program/runs/jitter.hpp"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <set>

#include <nlohmann/json.hpp>

#include "compare/problem/error.hpp"
#include "compare/record/run_folder.hpp"
#include "experiments/scenes/registry.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::Vec3f;

namespace {

compare::Scene twist() { return experiments::make_scene("twist", experiments::Scale::smoke); }

std::vector<Vec3f> jittered(const compare::Scene& scene, const experiments::Jitter& jitter) {
  std::vector<Vec3f> positions = compare::to_single(scene.mesh.positions);
  add_jitter(jitter, scene, positions);
  return positions;
}

/// Holds a run's final hash, its jitter and seed in run.json, and the positions of its first frame.
struct ShortRun {
  std::string hash, first;
  std::vector<Vec3f> start;
};
ShortRun run(const std::filesystem::path& out, const std::string& options, int steps = 3) {
  const ProgramResult result = run_ogc("run twist --scale smoke --steps " + std::to_string(steps) + " --out " +
                                       out.string() + options);
  INFO(result.err);
  REQUIRE(result.status == 0);
  const compare::RunReader reader(out);
  const auto& extra = reader.provenance().extra;
  const auto jitter = extra.find("jitter"), seed = extra.find("jitter_seed");
  CHECK((jitter == extra.end()) == (seed == extra.end()));
  return {extra.at("final_hash"), jitter == extra.end() ? "" : jitter->second + " " + seed->second,
          reader.frame(0).positions};
}

}  // namespace

TEST_CASE("jitter moves free vertices alone, each coordinate by up to so much, and fills that range", "[property]") {
  const compare::Scene scene = twist();
  const std::vector<Vec3f> start = compare::to_single(scene.mesh.positions);
  const std::vector<compare::Index> groups = rigid_groups(scene);
  const float largest = GENERATE(1e-6f, 1e-4f);
  const std::vector<Vec3f> moved = jittered(scene, {.largest = largest, .seed = 3});
  // Storing a coordinate below 1 m in single precision adds at most half a unit in the last place, 2⁻²⁵ m.
  const double room = static_cast<double>(largest) + 0x1p-25;
  double lowest = 0, highest = 0, sum = 0;
  std::size_t count = 0;
  for (std::size_t v = 0; v < start.size(); ++v) {
    if (groups[v] != -1) {
      CHECK(moved[v] == start[v]);
      continue;
    }
    for (const auto coordinate : {&Vec3f::x, &Vec3f::y, &Vec3f::z}) {
      REQUIRE(std::abs(start[v].*coordinate) < 1);
      const double offset = static_cast<double>(moved[v].*coordinate) - static_cast<double>(start[v].*coordinate);
      CHECK(std::abs(offset) <= room);
      lowest = std::min(lowest, offset), highest = std::max(highest, offset), sum += offset;
      ++count;
    }
  }
  REQUIRE(count > 300);
  CHECK(lowest < -0.95 * static_cast<double>(largest));
  CHECK(highest > 0.95 * static_cast<double>(largest));
  // The mean of `count` uniform offsets has the standard deviation largest/√(3 count); the limit is five standard
  // deviations.
  CHECK(std::abs(sum) < 5 * static_cast<double>(largest) * std::sqrt(static_cast<double>(count) / 3));
}

// The expected numbers were computed by integer arithmetic in Python, from the hash of random.hpp. If a machine
// computed other numbers, runs with the same seed would differ there.
TEST_CASE("an offset depends on seed, vertex and coordinate alone, to the bit", "[unit]") {
  compare::Scene scene = twist();
  const experiments::Jitter jitter{.largest = 0x1p-10, .seed = 7};
  compare::Scene cut = scene;
  cut.motions.clear();
  std::vector<Vec3f> zero(scene.mesh.positions.size(), Vec3f{0, 0, 0});
  add_jitter(jitter, cut, zero);
  const auto bits = [](float a) {
    std::uint32_t b = 0;
    std::memcpy(&b, &a, sizeof b);
    return b;
  };
  CHECK(bits(zero[0].x) == 0x3945b780u);
  CHECK(bits(zero[0].y) == 0x395d1a30u);
  CHECK(bits(zero[5].z) == 0x3a6bc32cu);
  CHECK(jittered(scene, jitter) == jittered(scene, jitter));
  CHECK(jittered(scene, jitter) != jittered(scene, {.largest = 0x1p-10, .seed = 8}));
  CHECK(jittered(scene, {}) == compare::to_single(scene.mesh.positions));
}

TEST_CASE("runs of one seed end with the same bits, of another with others; run.json has both numbers", "[unit]") {
  const TemporaryFolder folder;
  const ShortRun plain = run(folder / "plain", ""), none = run(folder / "none", " --jitter 0 --seed 4"),
                 one = run(folder / "one", " --jitter 1e-6 --seed 4"),
                 again = run(folder / "again", " --jitter 1e-6 --seed 4 --threads 1"),
                 other = run(folder / "other", " --jitter 1e-6 --seed 5"), first = run(folder / "f", " --jitter 1e-6");
  CHECK(none.hash == plain.hash);
  CHECK(none.start == plain.start);
  CHECK(one.hash == again.hash);
  CHECK(one.start == jittered(twist(), {.largest = 1e-6, .seed = 4}));
  CHECK(std::set{plain.hash, one.hash, other.hash, first.hash}.size() == 4);
  CHECK((plain.first + none.first).empty());
  CHECK(one.first == "1e-06 4");
  CHECK(other.first == "1e-06 5");
  CHECK(first.first == "1e-06 1");
}

TEST_CASE("every solver begins at the jittered start", "[property]") {
  const TemporaryFolder folder;
  const std::string solver = GENERATE("newton", "ipc", "reference_vbd");
  const std::string options = " --solver " + solver + " --set newton_tolerance=0 --set newton_iterations=2 ";
  const ShortRun plain = run(folder / "plain", options), moved = run(folder / "moved", options + "--jitter 1e-5");
  CHECK(moved.start == jittered(twist(), {.largest = 1e-5, .seed = 1}));
  CHECK(moved.hash != plain.hash);
}

TEST_CASE("jitter from a stored frame moves that frame's state", "[unit]") {
  const TemporaryFolder folder;
  const ShortRun begun = run(folder / "begun", "");
  std::filesystem::path last;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "begun/frames"))
    last = std::max(last, entry.path());
  const ShortRun moved = run(folder / "moved", " --jitter 1e-6 --from-state " + last.string(), 5);
  const compare::RunReader reader(folder / "begun");
  std::vector<Vec3f> expected = reader.frame(reader.frame_count() - 1).positions;
  experiments::add_jitter({.largest = 1e-6}, twist(), expected);
  CHECK(moved.start == expected);
}

TEST_CASE("jitter that a start can't have is refused by name, with the reason, before any folder is made", "[unit]") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& options, std::initializer_list<std::string> words) {
    const ProgramResult result = run_ogc("run " + options + " --out " + (folder / "run").string());
    INFO(options << "\n" << result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, words));
    REQUIRE(!std::filesystem::exists(folder / "run"));
  };
  const std::string scene = "twist --scale smoke --set contact_radius=0.004 ";
  for (const char* value : {"nan", "-1e-6", "inf", "1e20", "-nan", "much"})
    refused(scene + "--jitter " + value, {"--jitter", value, "from 0 to 1048576 m"});
  refused(scene + "--jitter 4e-4", {"--jitter 4e-04", "less than a tenth of contact_radius", "4e-04 m", "0.35 r"});
  refused(scene + "--jitter 1", {"--jitter 1", "a tenth of contact_radius"});
  refused(scene + "--seed 3", {"--seed", "--jitter"});
  refused(scene + "--jitter 1e-6 --seed -1", {"--seed", "-1"});
  refused(scene + "--jitter 1e-6 --seed 1.5", {"--seed", "1.5"});
  // The sheets are closer to each other than the offsets are long. Only the audit of the moved start finds the
  // intersection.
  const std::string mesh = folder
                               .write("near.obj",
                                      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 1e-5\nv 0.6 0.2 1e-5\nv 0.2 0.6 1e-5\n"
                                      "f 1 2 3\nf 4 5 6\n")
                               .string();
  refused(mesh + " --set contact_radius=0.01 --jitter 9e-4 --seed 7", {"moved by --jitter", "intersection"});
}

TEST_CASE("the help of run teaches jitter", "[unit]") {
  const std::string help = run_ogc("run --help").out;
  CHECK(contains(help, {"--jitter", "a tenth of contact_radius", "--seed", "the same bits on every machine",
                        "--jitter 1e-6 --seed 7"}));
}
