// Runs that are cut off, by real signals at random moments, and go on: everything but times comes out as if nothing had happened.
#include <chrono>
#include <fstream>
#include <map>
#include <random>

#include "compare/files/bytes.hpp"
#include "compare/record/run_folder.hpp"
#include "compare/record/steps_csv.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

namespace fs = std::filesystem;

/// Frames by name, byte by byte.
std::map<std::string, std::string> frames_of(const fs::path& run) {
  std::map<std::string, std::string> frames;
  for (const auto& entry : fs::directory_iterator(run / "frames")) frames[entry.path().filename().string()] = compare::read_bytes(entry.path());
  return frames;
}

/// steps.csv without what a clock says.
std::string rows_of(const fs::path& run) {
  compare::StepTable table = compare::read_steps(run);
  for (compare::StepMetrics& row : table.rows) row.wall_ms = 0, row.stage_ms.clear();
  return compare::step_lines(table.rows, table.stage_names.size());
}

/// Of iterations.csv, all but the third column, a time.
std::string iterations_of(const fs::path& run) {
  std::ifstream file(run / "iterations.csv");
  std::string text;
  for (std::string line; std::getline(file, line);) {
    const std::size_t time = line.find(',', line.find(',') + 1);
    text += line.substr(0, time) + line.substr(line.find(',', time + 1)) + "\n";
  }
  return text;
}

void check_same_run(const fs::path& whole, const fs::path& resumed) {
  CHECK(compare::RunReader(resumed).provenance().extra.at("final_hash") == compare::RunReader(whole).provenance().extra.at("final_hash"));
  CHECK(compare::RunReader(resumed).provenance().extra.at("audited_states") == compare::RunReader(whole).provenance().extra.at("audited_states"));
  CHECK(rows_of(resumed) == rows_of(whole));
  CHECK(iterations_of(resumed) == iterations_of(whole));
  CHECK(frames_of(resumed) == frames_of(whole));
  CHECK(fs::exists(resumed / "trajectory.vtkhdf"));
}

struct Cuts {
  int killed = 0, in_time = 0;  ///< of the cuts: those that met a run which had begun
};

/// Runs the scene to its end, cut off after random fractions of `seconds`, which should be about what the whole run takes.
Cuts run_with_cuts(const std::string& command, const fs::path& run, const std::string& signal, double seconds, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> moment(0.1 * seconds, 0.6 * seconds);
  Cuts cuts;
  std::string arguments = command + " --out " + run.string();
  for (int attempt = 0; attempt < 40; ++attempt) {
    const std::string before = cuts.killed < 4 ? "timeout --preserve-status -s " + signal + " " + std::to_string(moment(random)) + " " : "";
    const ProgramResult result = run_ogc("run " + arguments, before);
    if (result.status == 0) break;
    INFO(result.err);
    REQUIRE((result.status == 128 + 9 || result.status == 130 || result.status == 143));
    ++cuts.killed;
    const bool begun = fs::exists(run / "checkpoint.h5") && fs::exists(run / "run.json");
    cuts.in_time += begun;
    if (begun) arguments = "--resume " + run.string() + " --checkpoint 0";
    if (!begun) fs::remove_all(run);
  }
  return cuts;
}

}  // namespace

TEST_CASE("a run that kill -9, SIGINT or SIGTERM cut off again and again ends with the bits of one that was left alone", "[property]") {
  const TemporaryFolder folder;
  const std::string scene = GENERATE("cloth_on_sphere --scale smoke --audit every", "twist --scale smoke --steps 40 --audit frame --set frame_steps=4");
  const std::string command = scene + " --checkpoint 0";
  const auto begin = std::chrono::steady_clock::now();
  REQUIRE(run_ogc("run " + command + " --out " + (folder / "whole").string()).status == 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const unsigned seed = std::random_device{}();
  for (const std::string signal : {"KILL", "INT", "TERM"}) {
    INFO(scene << ", " << signal << ", seed " << seed);
    const fs::path run = folder / signal;
    const Cuts cuts = run_with_cuts(command, run, signal, seconds, seed);
    CHECK(cuts.killed > 0);
    check_same_run(folder / "whole", run);
  }
}

TEST_CASE("every solver in single precision resumes to the same bits, with its rows by iteration", "[property]") {
  const auto [solver, options] = GENERATE(table<std::string, std::string>({{"newton", "--iterations --steps 12"}, {"reference_vbd", "--steps 8"}, {"vbd", "--iterations --residual --profile --steps 8"}}));
  const TemporaryFolder folder;
  const std::string command = "cloth_on_sphere --scale smoke --set frame_steps=2 --checkpoint 0 --solver " + solver + " " + options;
  const auto begin = std::chrono::steady_clock::now();
  REQUIRE(run_ogc("run " + command + " --out " + (folder / "whole").string()).status == 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const unsigned seed = std::random_device{}();
  INFO(solver << ", seed " << seed);
  CHECK(run_with_cuts(command, folder / "cut", "KILL", seconds, seed).killed > 0);
  check_same_run(folder / "whole", folder / "cut");
}

TEST_CASE("what can't be resumed to the same bits is refused, and the message says why and what to do", "[unit]") {
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  REQUIRE(run_ogc("run cloth_on_sphere --scale smoke --steps 3 --audit off --out " + run.string()).status == 0);
  const auto refused = [&](std::initializer_list<std::string> words, const std::string& more = "") {
    const ProgramResult result = run_ogc("run --resume " + run.string() + more);
    INFO(result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, words));
  };
  const auto rewritten = [&](const std::string& file, const std::string& from, const std::string& to) {
    std::string text = compare::read_bytes(run / file);
    REQUIRE(text.find(from) != std::string::npos);
    compare::write_bytes(run / file, text.replace(text.find(from), from.size(), to));
  };
  refused({"finished run (3 steps)", "--from-state", "frame_000003.h5"});
  rewritten("run.json", "\"finished\"", "\"running\"");
  refused({"leave out: SCENE|FILE.json, --steps"}, " --steps 9 -- twist");
  const std::string scene = compare::read_bytes(run / "scene/cloth_on_sphere.json"), checkpoint = compare::read_bytes(run / "checkpoint.h5"),
                    manifest = compare::read_bytes(run / "run.json");
  rewritten("scene/cloth_on_sphere.json", "\"steps\": 3", "\"steps\": 4");
  refused({"is not the scene that this run was begun with", "scene"});
  compare::write_bytes(run / "scene/cloth_on_sphere.json", scene);
  compare::write_bytes(run / "checkpoint.h5", checkpoint.substr(0, checkpoint.size() / 2));
  refused({"checkpoint.h5", "damaged", "--from-state"});
  std::string flipped = checkpoint;
  flipped[checkpoint.size() / 2] ^= 1;
  compare::write_bytes(run / "checkpoint.h5", flipped);
  refused({"checkpoint.h5", "damaged", "--from-state"});
  fs::remove(run / "checkpoint.h5");
  refused({"checkpoint.h5", "missing", "run it again"});
  compare::write_bytes(run / "checkpoint.h5", checkpoint);
  rewritten("run.json", "\"commit\": \"", "\"commit\": \"0");
  refused({"another program", "commit", "--from-state"});
  compare::write_bytes(run / "run.json", manifest);
  rewritten("run.json", "\"solver\": \"vbd\"", "\"solver\": \"ipc\"");
  refused({"ipc", "double precision"});
  compare::write_bytes(run / "run.json", manifest);
  rewritten("steps.csv", "\n2,", "\n9,");
  refused({"steps.csv", "not every row"});
}

TEST_CASE("a run that is still going on is not resumed by a second program", "[unit]") {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string();
  const std::string first = "'" OGC_PROGRAM "' run twist --scale small --audit off --out " + run + " > /dev/null 2>&1 & first=$!; ";
  const ProgramResult second = run_ogc("run --resume " + run + "; status=$?; kill -9 $first; wait $first 2> /dev/null; exit $status",
                                       first + "while [ ! -e " + run + "/checkpoint.h5 ]; do sleep 0.05; done; ");
  INFO(second.err);
  CHECK(second.status == 2);
  CHECK(contains(second.err, {"steps.csv", "another process"}));
}
