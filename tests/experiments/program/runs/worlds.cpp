// Tests `ogc run --worlds`: each world is the run alone with its seed, a world that fails is named, and the folder says
// how each world ended.
#include <filesystem>
#include <map>
#include <sstream>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/record/frame_file.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

/// Runs `ogc run` with these arguments and returns the JSON that it prints.
json run(const std::string& arguments, int status = 0) {
  const ProgramResult result = run_ogc("run " + arguments + " --json");
  INFO(result.err);
  REQUIRE(result.status == status);
  return json::parse(result.out);
}

/// Returns the lines of a table that belong to a world, without its number.
std::vector<std::string> lines_of(const fs::path& table, int world) {
  std::vector<std::string> lines;
  std::istringstream text(compare::read_bytes(table));
  const std::string begin = std::to_string(world) + ",";
  for (std::string line; std::getline(text, line);)
    if (line.starts_with(begin)) lines.push_back(line.substr(begin.size()));
  return lines;
}

}  // namespace

TEST_CASE("world w of a run is the run alone with seed + w, and its state begins another run", "[property]") {
  const TemporaryFolder folder;
  const std::string scene = "twist --scale smoke --steps 6 --jitter 1e-6 --audit end";
  const fs::path out = folder / "worlds";
  const json worlds = run(scene + " --seed 5 --worlds 3 --out " + out.string());
  REQUIRE(worlds.at("worlds").size() == 3);
  CHECK(worlds.at("status") == "finished");
  CHECK(worlds.at("audited_states") == 3);
  for (int w = 0; w < 3; ++w) {
    const json& world = worlds.at("worlds").at(static_cast<std::size_t>(w));
    CHECK(world.at("jitter_seed") == 5 + w);
    const fs::path alone = folder / ("alone" + std::to_string(w));
    const json single = run(scene + " --seed " + std::to_string(5 + w) + " --out " + alone.string());
    CHECK(world.at("final_hash") == single.at("final_hash"));
    CHECK(lines_of(out / "worlds_steps.csv", w).size() == 6);
    const compare::Frame end = compare::read_frame(out / "ends" / ("world_000" + std::to_string(w) + ".h5"));
    CHECK(end.positions == compare::read_frame(alone / "frames" / "frame_000006.h5").positions);
  }
  CHECK(worlds.at("worlds").at(0).at("final_hash") != worlds.at("worlds").at(1).at("final_hash"));
  const json on = run("twist --scale smoke --steps 8 --audit off --from-state " +
                      (out / "ends" / "world_0001.h5").string() + " --out " + (folder / "on").string());
  CHECK(on.at("first_step") == 6);
  const ProgramResult again = run_ogc("run " + scene + " --worlds 2 --out " + out.string());
  CHECK(again.status == 2);
  CHECK(contains(again.err, {"holds a run already"}));
}

TEST_CASE("a run of worlds states its memory before the first step, and run.json has their number", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_ogc("run twist --scale smoke --steps 2 --worlds 2 --audit off --out " +
                                       (folder / "worlds").string());
  CHECK(result.status == 0);
  CHECK(contains(result.err, {"2 worlds of", "vertices need", "MB of the machine's memory"}));
  const json manifest = json::parse(compare::read_bytes(folder / "worlds/run.json"));
  CHECK(manifest.at("worlds") == "2");
  CHECK(manifest.at("status") == "finished");
}

TEST_CASE("more worlds than the memory holds are refused before the first step, with the number that fits", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_ogc("run twist --scale small --worlds 1048576 --audit off --out " +
                                       (folder / "worlds").string());
  INFO(result.err);
  CHECK(result.status == 3);
  CHECK(contains(result.err, {"1048576 worlds of", "1048576 worlds need", "run at most"}));
  CHECK_FALSE(fs::exists(folder / "worlds"));
}

TEST_CASE("worlds refuse what belongs to one world, by name", "[unit]") {
  const TemporaryFolder folder;
  for (const std::string option :
       {"--profile", "--iterations", "--residual", "--ledger", "--tolerate-start", "--solver newton", "--view"}) {
    const ProgramResult result = run_ogc("run twist --scale smoke --worlds 2 " + option + " --out " +
                                         (folder / "out").string());
    INFO(option << ": " << result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {option, "--worlds"}));
  }
  for (const std::string count : {"0", "-1", "1048577", "1e3", "many"}) {
    const ProgramResult result = run_ogc("run twist --scale smoke --worlds " + count);
    INFO(count << ": " << result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {"--worlds"}));
  }
}
