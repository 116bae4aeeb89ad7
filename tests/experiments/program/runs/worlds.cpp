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

TEST_CASE("a world with settings of its own is the run alone with these settings, and ends at its own step",
          "[property]") {
  const TemporaryFolder folder;
  const std::string scene = "twist --scale smoke --jitter 1e-6 ",
                    table = folder
                                .write("table.csv",
                                       "friction, steps, iterations, bounds, jitter_seed\n"
                                       "0.1,,,,\n\n"
                                       "0.4,4,7,planes,9\r\n"
                                       ",9,,,")
                                .string();
  const fs::path out = folder / "worlds";
  const json worlds = run(scene + "--seed 5 --steps 6 --audit frame --set frame_steps=3 --world-settings " + table +
                          " --out " + out.string());
  const std::vector<std::string> alone{"--seed 5 --set friction=0.1 --steps 6",
                                       "--seed 9 --set friction=0.4 --set iterations=7 --set bounds=planes --steps 4",
                                       "--seed 7 --steps 9"};
  REQUIRE(worlds.at("worlds").size() == alone.size());
  const std::vector<std::size_t> last_steps{6, 4, 9}, audits{2, 2, 3};
  for (std::size_t w = 0; w < alone.size(); ++w) {
    const json& world = worlds.at("worlds").at(w);
    const json single = run(scene + alone[w] + " --audit off --out " +
                            (folder / ("alone" + std::to_string(w))).string());
    INFO("world " << w);
    CHECK(world.at("status") == "finished");
    CHECK(world.at("last_step") == last_steps[w]);
    CHECK(world.at("final_hash") == single.at("final_hash"));
    CHECK(lines_of(out / "worlds_steps.csv", static_cast<int>(w)).size() == last_steps[w]);
    // Of each world, states at frames and the last one are audited: 3 and 6; 3 and 4; 3, 6 and 9.
    CHECK(lines_of(out / "worlds.csv", static_cast<int>(w))
              .at(0)
              .find("," + std::to_string(audits[w]) + "," + world.at("final_hash").get<std::string>()) !=
          std::string::npos);
  }
  CHECK(worlds.at("steps") == 9);
  CHECK(worlds.at("audited_states") == 7);
  CHECK(worlds.at("worlds").at(1).at("settings").at("friction") == "0.4");
  CHECK(contains(
      compare::read_bytes(out / "worlds.csv"),
      {"world,jitter_seed,set_friction,set_steps,set_iterations,set_bounds,status,", "\n1,9,0.4,4,7,planes,fin"}));
}

TEST_CASE("a table of worlds says which file, line and column is wrong, and what to do", "[unit]") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& table, std::initializer_list<std::string> words,
                           const std::string& options = "") {
    const std::string file = folder.write("table.csv", table).string();
    const ProgramResult result = run_ogc("run twist --scale smoke --steps 2 --world-settings " + file + options +
                                         " --out " + (folder / "out").string());
    INFO(table << "\n" << result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {"table.csv"}));
    CHECK(contains(result.err, words));
    CHECK_FALSE(fs::exists(folder / "out"));
  };
  refused("", {"is empty", "first line names settings"});
  refused("friction\n\n", {"no line behind its first"});
  refused("frict\n0.1\n", {"line 1, column 'frict'", "friction"});
  refused("friction,friction\n0.1,0.2\n", {"line 1, column 'friction'", "occurs twice"});
  refused("data\ninput\n", {"line 1, column 'data'", "one mesh", "--set data="});
  refused("body_contact\nvolume\n", {"line 1, column 'body_contact'", "--set body_contact="});
  refused("frame_steps\n4\n", {"line 1, column 'frame_steps'", "--set frame_steps="});
  refused("jitter_seed\n4\n", {"line 1, column 'jitter_seed'", "--jitter"});
  refused("jitter_seed\n-4\n", {"line 2, column 'jitter_seed'", "'-4'"}, " --jitter 1e-6");
  refused("friction,steps\n0.1,2\n0.1\n", {"line 3", "1 value", "2 columns"});
  refused("friction,steps\n0.1,2\n\n0.1,none\n", {"line 4, column 'steps'", "none"});
  refused("friction\n0.1\n-1\n", {"line 3, column 'friction'", "-1"});
  refused("newton_truncation\npair\n", {"line 2", "newton_truncation", "--solver newton"});
  refused("contact_radius\n\n1e-6\n", {"line 3", "--jitter", "contact_radius"}, " --jitter 1e-6");
  refused("friction\n0.1\n0.2\n", {"2 worlds", "--worlds says 3"}, " --worlds 3");
  const ProgramResult none = run_ogc("run twist --scale smoke --world-settings /nowhere/table.csv");
  CHECK(none.status == 2);
  CHECK(contains(none.err, {"/nowhere/table.csv"}));
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
  for (const std::string option : {"--profile", "--iterations", "--residual", "--ledger", "--repeats 2",
                                   "--tolerate-start", "--solver newton", "--view"}) {
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
