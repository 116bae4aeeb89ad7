#include "tests/experiments/cut_runs.hpp"

#include <chrono>
#include <fstream>
#include <map>
#include <random>

#include "compare/files/bytes.hpp"
#include "compare/record/run_folder.hpp"
#include "compare/record/steps_csv.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

namespace ogc::tests {

namespace fs = std::filesystem;

namespace {

/// Returns the bytes of each frame by file name.
std::map<std::string, std::string> frames_of(const fs::path& run) {
  std::map<std::string, std::string> frames;
  for (const auto& entry : fs::directory_iterator(run / "frames"))
    frames[entry.path().filename().string()] = compare::read_bytes(entry.path());
  return frames;
}

/// Returns the rows of steps.csv without times.
std::string rows_of(const fs::path& run) {
  compare::StepTable table = compare::read_steps(run);
  for (compare::StepMetrics& row : table.rows) row.wall_ms = 0, row.stage_ms.clear();
  return compare::step_lines(table.rows, table.stage_names.size(), table.groups);
}

/// Returns iterations.csv without its third column, which is a time.
std::string iterations_of(const fs::path& run) {
  std::ifstream file(run / "iterations.csv");
  std::string text;
  for (std::string line; std::getline(file, line);) {
    const std::size_t time = line.find(',', line.find(',') + 1);
    text += line.substr(0, time) + line.substr(line.find(',', time + 1)) + "\n";
  }
  return text;
}

/// Checks the folder of an interrupted run. Every frame must be complete. All rows up to the checkpoint must exist, and
/// all frames that the run's output `said` reports as written.
void check_left(const fs::path& run, const std::string& said) {
  const compare::RunReader reader(run);
  std::int64_t last = -1;
  for (std::size_t i = 0; i < reader.frame_count(); ++i) last = reader.frame(i).step;
  const std::int64_t saved = compare::read_checkpoint(run, compare::scene_digest(run)).state.step;
  const std::vector<compare::StepMetrics> rows = compare::read_steps(run).rows;
  CHECK((saved == 0 || (!rows.empty() && rows.back().step >= saved)));
  const std::string words = "frames written up to step ";
  for (std::size_t at = said.find(words); at != std::string::npos; at = said.find(words, at + 1))
    CHECK(std::stoll(said.substr(at + words.size())) <= last);
}

bool is_finished(const fs::path& run) {
  return fs::exists(run / "run.json") && compare::RunReader(run).provenance().status == "finished";
}

}  // namespace

void check_same_run(const fs::path& whole, const fs::path& resumed) {
  CHECK(compare::RunReader(resumed).provenance().extra.at("final_hash") ==
        compare::RunReader(whole).provenance().extra.at("final_hash"));
  CHECK(compare::RunReader(resumed).provenance().extra.at("audited_states") ==
        compare::RunReader(whole).provenance().extra.at("audited_states"));
  CHECK(rows_of(resumed) == rows_of(whole));
  CHECK(iterations_of(resumed) == iterations_of(whole));
  CHECK(frames_of(resumed) == frames_of(whole));
  CHECK(fs::exists(resumed / "trajectory.vtkhdf"));
}

Cuts run_with_cuts(const std::string& command, const fs::path& run, const std::string& signal, double seconds,
                   unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.1, 0.6);
  Cuts cuts;
  std::string arguments = command + " --out " + run.string();
  for (int attempt = 0; attempt < 40; ++attempt) {
    // With --foreground, timeout waits for the process that it kills. Without it, timeout dies by its own SIGKILL,
    // possibly before the run releases its lock.
    const std::string before = cuts.in_time < 3 && cuts.killed < 20
                                   ? "timeout --foreground --preserve-status -s " + signal + " " +
                                         std::to_string(share(random) * seconds) + " "
                                   : "";
    const ProgramResult result = run_ogc("run " + arguments, before);
    // The signal may reach a run after its last step was written. Only the trajectory is missing then, and `ogc export`
    // writes it.
    if (result.status == 0 || is_finished(run)) {
      if (result.status != 0) REQUIRE(run_ogc("export " + run.string()).status == 0);
      if (cuts.in_time > 0) break;
      fs::remove_all(run);  // no signal came in time; try again, sooner: the whole run may have waited for a processor
      seconds *= 0.7;
      continue;
    }
    INFO(result.err);
    REQUIRE((result.status == 128 + 9 || result.status == 130 || result.status == 143));
    ++cuts.killed;
    const bool begun = fs::exists(run / "checkpoint.h5") && fs::exists(run / "run.json");
    cuts.in_time += begun;
    if (begun) check_left(run, result.err);
    if (begun) arguments = "--resume " + run.string() + " --checkpoint 0";
    if (!begun) fs::remove_all(run);
  }
  return cuts;
}

void check_cut_runs(const fs::path& folder, const std::string& command, std::initializer_list<std::string> signals) {
  const std::string all = command + " --checkpoint 0";
  const auto begin = std::chrono::steady_clock::now();
  const ProgramResult whole = run_ogc("run " + all + " --out " + (folder / "whole").string());
  INFO(whole.err);
  REQUIRE(whole.status == 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const unsigned seed = std::random_device{}();
  for (const std::string& signal : signals) {
    INFO(command << ", " << signal << ", seed " << seed);
    CHECK(run_with_cuts(all, folder / signal, signal, seconds, seed).in_time > 0);
    check_same_run(folder / "whole", folder / signal);
  }
}

}  // namespace ogc::tests
