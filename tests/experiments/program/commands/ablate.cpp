#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "experiments/program/runs/ablation_table.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/cut_runs.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// Runs `ogc ablate` for cloth_on_sphere at scale smoke; `options` define the grid.
ProgramResult whole_grid(const std::string& options, const std::filesystem::path& out) {
  const ProgramResult result = run_ogc("ablate cloth_on_sphere --scale smoke " + options + " --out " + out.string());
  INFO(result.err);
  REQUIRE(result.status == 0);
  return result;
}

}  // namespace

TEST_CASE("an ablation makes a run folder for each point of its grid and a table over all", "[figure]") {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "grid";
  const ProgramResult result = whole_grid("--steps 2 --vary solver=vbd,newton --vary contact_radius=0.01,0.02 --json",
                                          out);
  CHECK(nlohmann::json::parse(result.out).at("runs").size() == 4);
  const std::vector<std::string> lines = lines_of(out / "ablation.csv");
  REQUIRE(lines.size() == 5);
  CHECK(lines[0].starts_with("solver,contact_radius,status,"));
  CHECK(lines[1].starts_with("vbd,0.01,finished,2,"));
  CHECK(lines[4].starts_with("newton,0.02,finished,2,"));
  for (const char* point : {"solver=vbd,contact_radius=0.01", "solver=newton,contact_radius=0.02"})
    CHECK(std::filesystem::exists(out / point / "run.json"));
}

TEST_CASE("an ablation with a wrong key or value anywhere in its grid runs nothing", "[unit]") {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "grid";
  for (const char* vary :
       {"contact_activation=ogc,barrier", "activatoin=ogc", "activation", "iterations=5,", "solver=newton,implicit",
        "backend=cpu,gpu", "iterations=5,0", "iterations=5,5", "iterations=5 --vary iterations=6",
        "iterations=5,6 --repeat 2", "iterations=5,6 --repeat 2 --jitter 0", "iterations=5,6 --repeat 0 --jitter 1e-6",
        "iterations=5,6 --only 2", "iterations=5 --point iterations=6", "iterations=5 --point friction",
        "iterations=5 --point friction=0.1,friction=0.2", "iterations=5 --point default --point default",
        "iterations=5 --point friction=-1", "iterations=5,6 --jitter 1"}) {
    const ProgramResult result = run_ogc(std::string("ablate cloth_on_sphere --scale smoke --steps 1 --vary ") + vary +
                                         " --out " + out.string());
    INFO(vary << "\n" << result.err);
    CHECK(result.status == 2);
    CHECK(!std::filesystem::exists(out));
  }
}

TEST_CASE("a point of an ablation that fails is a row, and the exit status is 1", "[unit]") {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "grid";
  const ProgramResult result = run_ogc(
      "ablate cloth_on_sphere --scale smoke --steps 7 --solver newton --vary newton_iterations=1,50 --out " +
      out.string());
  CHECK(result.status == 1);
  const std::vector<std::string> lines = lines_of(out / "ablation.csv");
  REQUIRE(lines.size() == 3);
  CHECK(lines[1].starts_with("1,failed,"));
  CHECK(lines[2].starts_with("50,finished,7,"));
}

TEST_CASE("a refused value of an ablation comes with the list of values", "[unit]") {
  const auto said = [](const std::string& vary) {
    return run_ogc("ablate cloth_on_sphere --scale smoke --steps 1 --vary " + vary).err;
  };
  CHECK_THAT(said("contact_activation=ogc,barrier"),
             ContainsSubstring("barrier") && ContainsSubstring("quadratic, ipc_log, cubic"));
  CHECK_THAT(said("membrane=rubber"), ContainsSubstring("rubber") && ContainsSubstring("stable_neo_hookean"));
  CHECK_THAT(said("iterations=0"), ContainsSubstring("from 1 to 1073741824"));
  CHECK_THAT(said("iterations=5 --repeat 3"),
             ContainsSubstring("--repeat 3") && ContainsSubstring("same bits") && ContainsSubstring("--jitter"));
}

namespace {

const std::string repeated =
    "ablate cloth_on_sphere --scale smoke --steps 14 --audit end --set frame_steps=7 --vary iterations=5,10 --repeat 2 "
    "--jitter 1e-6 --seed 7 --checkpoint 0 --out ";
const std::vector<std::string> repeated_runs{"iterations=5,seed=7", "iterations=10,seed=7", "iterations=5,seed=8",
                                             "iterations=10,seed=8"};

/// Returns the cell in column `name`. The CSV has no quoted commas.
std::string cell(const std::string& line, const std::string& header, const std::string& name) {
  std::istringstream names(header), cells(line);
  std::string key, value;
  while (std::getline(names, key, ',') && std::getline(cells, value, ','))
    if (key == name) return value;
  return "";
}

}  // namespace

TEST_CASE("residuals with the contacts of a step's last detection are those of its last iteration", "[unit]") {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "grid";
  run_ogc("ablate cloth_on_sphere --scale smoke --steps 5 --iterations --point default --out " + out.string());
  const std::vector<std::string> table = lines_of(out / "ablation.csv"),
                                 rows = lines_of(out / "default/iterations.csv");
  REQUIRE(table.size() == 2);
  std::map<std::string, double> last;  // by step
  for (std::size_t i = 1; i < rows.size(); ++i)
    last[cell(rows[i], rows[0], "step [1]")] = std::stod(cell(rows[i], rows[0], "residual [1]"));
  std::vector<double> values;
  for (const auto& [step, value] : last) values.push_back(value);
  std::ranges::sort(values);
  REQUIRE(values.size() == 5);
  CHECK(std::stod(cell(table[1], table[0], "median_stale_residual [1]")) == values[2]);
  CHECK(std::stod(cell(table[1], table[0], "largest_stale_residual [1]")) == values[4]);
}

TEST_CASE("a repeated ablation that signals cut off ends with the runs of one that was left alone", "[property]") {
  const TemporaryFolder folder;
  const std::filesystem::path whole = folder / "whole", cut = folder / "cut";
  REQUIRE(run_ogc(repeated + whole.string()).status == 0);
  for (const char* cutting : {"KILL 0.3", "INT 0.4", "KILL 0.5"})
    run_ogc(repeated + cut.string(), std::string("timeout -s ") + cutting + " ");
  const ProgramResult result = run_ogc(repeated + cut.string());
  INFO(result.err);
  REQUIRE(result.status == 0);
  for (const std::string& run : repeated_runs) check_same_run(whole / run, cut / run);
  // Imitates an interruption: only the folder of one run exists, without results. A folder that contains a foreign file
  // must not be removed.
  std::filesystem::remove_all(cut / repeated_runs[1]);
  std::filesystem::create_directories(cut / repeated_runs[1] / "frames");
  REQUIRE(run_ogc(repeated + cut.string()).status == 0);
  check_same_run(whole / repeated_runs[1], cut / repeated_runs[1]);
  std::filesystem::remove_all(cut / repeated_runs[1]);
  std::filesystem::create_directories(cut / repeated_runs[1] / "frames");
  compare::write_bytes(cut / repeated_runs[1] / "notes.txt", "mine");
  CHECK(run_ogc(repeated + cut.string()).status == 2);
  CHECK(compare::read_bytes(cut / repeated_runs[1] / "notes.txt") == "mine");
  std::filesystem::remove_all(cut / repeated_runs[1]);
  REQUIRE(run_ogc(repeated + cut.string()).status == 0);
  const auto rows = lines_of(whole / "ablation.csv"), others = lines_of(cut / "ablation.csv");
  REQUIRE(rows.size() == 5);
  REQUIRE(others.size() == 5);
  for (std::size_t i = 1; i < 5; ++i)
    for (const char* name : {"iterations", "seed", "final_hash", "most_contacts [1]", "last_energy [J]"})
      CHECK(cell(rows[i], rows[0], name) == cell(others[i], rows[0], name));
  CHECK(cell(rows[1], rows[0], "final_hash") != cell(rows[3], rows[0], "final_hash"));
}

TEST_CASE("an ablation keeps what is done, takes more seeds, and refuses a folder of another question", "[unit]") {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "grid";
  const std::string command =
      "ablate cloth_on_sphere --scale smoke --steps 2 --jitter 1e-6 --vary iterations=5,10 "
      "--out " +
      out.string();
  REQUIRE(run_ogc(command + " --repeat 2").status == 0);
  const std::string before = compare::read_bytes(out / "iterations=5,seed=1/run.json");
  const ProgramResult more = run_ogc(command + " --repeat 3");
  REQUIRE(more.status == 0);
  CHECK_THAT(more.err, ContainsSubstring("iterations=10,seed=2 (4 of 6): is done"));
  CHECK(compare::read_bytes(out / "iterations=5,seed=1/run.json") == before);
  CHECK(lines_of(out / "ablation.csv").size() == 7);
  CHECK_THAT(more.out, ContainsSubstring("iterations_a_step: iterations=10 is 2 times iterations=5, range 2 to 2"));
  CHECK_THAT(more.out, ContainsSubstring("audit: iterations=5: 3 of 3 runs finished, 3 of the 3 audited ones kept"));
  for (const char* other : {" --repeat 3 --set friction=0.31", " --repeat 3 --audit every", " --repeat 3 --residual",
                            " --repeat 3 --solver reference_vbd"}) {
    const ProgramResult refused = run_ogc(command + other);
    INFO(other << "\n" << refused.err);
    CHECK(refused.status == 2);
    CHECK_THAT(refused.err,
               ContainsSubstring("iterations=5,seed=1: holds a run") && ContainsSubstring("another --out"));
  }
}

TEST_CASE("tasks of an array job make the runs of an ablation, and the command then tabulates them", "[unit]") {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "a grid";
  const std::string command =
      "ablate cloth_on_sphere --scale smoke --steps 2 --jitter 1e-6 --repeat 2 --vary "
      "iterations=5,10 --residual --out '" +
      out.string() + "'";
  const ProgramResult planned = run_ogc(command + " --slurm");
  REQUIRE(planned.status == 0);
  const std::string script = compare::read_bytes(out / "slurm_array.sh");
  CHECK_THAT(script, ContainsSubstring("--array=0-3\n") && ContainsSubstring("'" + out.string() + "'") &&
                         ContainsSubstring(" --residual ") && ContainsSubstring("--repeat '2'"));
  CHECK(!std::filesystem::exists(out / "ablation.csv"));
  // Imitates a cluster that runs the tasks one after the other. The script `srun` only runs its command.
  const std::string array = "for i in 3 1 0 2; do SLURM_ARRAY_TASK_ID=$i PATH=\"" + (folder / "bin").string() +
                            ":$PATH\" bash \"" + (out / "slurm_array.sh").string() + "\" 2>/dev/null || exit 1; done; ";
  std::filesystem::create_directories(folder / "bin");
  compare::write_bytes(folder / "bin/srun", "#!/bin/sh\nexec \"$@\"\n");
  std::filesystem::permissions(folder / "bin/srun", std::filesystem::perms::owner_all);
  const ProgramResult result = run_ogc(command, array);
  INFO(result.err);
  REQUIRE(result.status == 0);
  CHECK_THAT(result.err, ContainsSubstring("(1 of 4): is done") && ContainsSubstring("(4 of 4): is done"));
  CHECK(lines_of(out / "ablation.csv").size() == 5);
}

TEST_CASE("runs of an ablation side by side end in the bits of those one after the other", "[property]") {
  const TemporaryFolder folder;
  const std::string command =
      "ablate cloth_on_sphere --scale smoke --steps 6 --jitter 1e-6 --repeat 2 --vary iterations=5,10 ";
  REQUIRE(run_ogc(command + "--out " + (folder / "one").string()).status == 0);
  const ProgramResult result = run_ogc(command + "--jobs 3 --out " + (folder / "three").string());
  INFO(result.err);
  REQUIRE(result.status == 0);
  const std::vector<std::string> one = lines_of(folder / "one/ablation.csv"),
                                 three = lines_of(folder / "three/ablation.csv");
  REQUIRE(one.size() == 5);
  REQUIRE(three.size() == 5);
  for (std::size_t i = 1; i < one.size(); ++i)
    for (const char* name : {"iterations", "seed", "status", "final_hash"})
      CHECK(cell(one[i], one[0], name) == cell(three[i], three[0], name));
  CHECK(!std::filesystem::exists(folder / "three/iterations=5,seed=1.log"));
  CHECK_THAT(result.err, ContainsSubstring("(4 of 4)\n") && ContainsSubstring("(4 of 4): is done"));
}

TEST_CASE("runs side by side that signals cut off end as if they had been left alone", "[property]") {
  const TemporaryFolder folder;
  const std::filesystem::path whole = folder / "whole", cut = folder / "cut";
  REQUIRE(run_ogc(repeated + whole.string()).status == 0);
  for (const char* cutting : {"KILL 0.3", "INT 0.3", "TERM 0.4", "KILL 0.5"})
    run_ogc(repeated + cut.string() + " --jobs 2", std::string("timeout -s ") + cutting + " ");
  const ProgramResult result = run_ogc(repeated + cut.string() + " --jobs 2");
  INFO(result.err);
  REQUIRE(result.status == 0);
  for (const std::string& run : repeated_runs) check_same_run(whole / run, cut / run);
}

TEST_CASE("a run of an ablation that fails beside others is a row, and its log stays", "[unit]") {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "grid";
  const ProgramResult result = run_ogc(
      "ablate cloth_on_sphere --scale smoke --steps 7 --solver newton --vary newton_iterations=1,50 --jobs 2 --out " +
      out.string());
  CHECK(result.status == 1);
  CHECK(lines_of(out / "ablation.csv").size() == 3);
  CHECK_THAT(compare::read_bytes(out / "newton_iterations=1.log"), ContainsSubstring("did not converge in step"));
  CHECK(!std::filesystem::exists(out / "newton_iterations=50.log"));
}

TEST_CASE("a difference is stated only where ranges lie apart, with the range of all ratios", "[unit]") {
  using namespace ogc::experiments;
  const std::size_t metric = 0;
  const auto setting = [](const std::string& name, const std::vector<double>& values) {
    SettingRows rows{name, {}};
    for (const double value : values) {
      RunRow row;
      row.status = "finished";
      row.metrics.assign(ablation_metrics().size(), std::numeric_limits<double>::quiet_NaN());
      row.metrics[0] = value;
      row.guarantee_kept = "yes";
      rows.rows.push_back(row);
    }
    return rows;
  };
  const auto said = [&](const std::vector<double>& x, const std::vector<double>& y) {
    const SettingRows one = setting("x", x), other = setting("y", y);
    return sentence({"time", "ms"}, one, range_of(one, metric), other, range_of(other, metric));
  };
  CHECK(said({6, 8, 7}, {4, 3, 3.5}) == "time: x is 2 times y, range 1.5 to 2.67 (medians 7 ms and 3.5 ms)");
  CHECK(said({3, 4}, {6, 8}) == "time: x is 0.5 times y, range 0.375 to 0.667 (medians 3.5 ms and 7 ms)");
  CHECK_THAT(said({1, 5}, {4, 9}),
             ContainsSubstring("no difference is shown") && ContainsSubstring("1 to 5 ms and 4 to 9 ms"));
  CHECK_THAT(said({1, 4}, {4, 9}), ContainsSubstring("no difference is shown"));
  CHECK(said({-3, -2}, {0, 1}) == "time: x is 3 ms less than y, range 2 to 4 ms (medians -2.5 ms and 0.5 ms)");
  CHECK(said({2, 2}, {2, 2}) == "time: x and y are equal: 2 ms in every run");
  CHECK(said({2, std::numeric_limits<double>::quiet_NaN()}, {1, 1}).empty());
  SettingRows failed = setting("x", {6, 7, 1});
  failed.rows.back().status = "failed";
  failed.rows.back().guarantee_kept = "no";
  CHECK(range_of(failed, metric).smallest == 6);
  const std::vector<std::string> lines = findings({setting("y", {3, 4}), failed});
  REQUIRE(lines.size() == 4);
  CHECK(lines[1] == "audit: x: 2 of 3 runs finished, 2 of the 3 audited ones kept the guarantee");
  CHECK(lines[3] == "by chance alone 0.333 of these sentences would call equal settings different");
  CHECK(std::llround(2 / apart_by_chance(10, 10)) == 184756);
  CHECK_THAT(findings({setting("y", {3}), setting("x", {5})}).back(), ContainsSubstring("--repeat 10"));
}

TEST_CASE("points of an ablation change several settings together, and the rest is the scene's", "[unit]") {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "grid";
  whole_grid(
      "--point default --point iterations=20,time_step=0.005,steps=4 --point time_step=0.02 --set steps=2 "
      "--vary friction=0.1,0.2",
      out);
  const std::vector<std::string> lines = lines_of(out / "ablation.csv");
  REQUIRE(lines.size() == 7);
  CHECK(lines[0].starts_with("iterations,time_step,steps,friction,status,steps [1]"));
  CHECK(lines[1].starts_with(",,,0.1,finished,2,"));
  CHECK(lines[4].starts_with("20,0.005,4,0.2,finished,4,"));
  CHECK(lines[5].starts_with(",0.02,,0.1,finished,2,"));
  CHECK(std::filesystem::exists(out / "iterations=20,time_step=0.005,steps=4,friction=0.2/run.json"));
  CHECK(run_ogc("ablate cloth_on_sphere --scale smoke --out " + (folder / "none").string()).status == 2);
}
