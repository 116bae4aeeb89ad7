// Tests runs that signals interrupt at random moments and that are then resumed. Everything except times must equal an
// uninterrupted run.
#include <map>

#include "compare/files/bytes.hpp"
#include "compare/files/durable_file.hpp"
#include "compare/record/run_folder.hpp"
#include "experiments/program/runs/resume.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/cut_runs.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace fs = std::filesystem;

TEST_CASE("a run that kill -9, SIGINT or SIGTERM cut off again and again ends with the bits of one that was left alone",
          "[property]") {
  const TemporaryFolder folder;
  const std::string scene = GENERATE(
      "cloth_on_sphere --scale smoke --audit every", "twist --scale smoke --steps 40 --audit frame --set frame_steps=4",
      OGC_SOURCE_DIR "/experiments/examples/solid_on_cloth/solid_on_cloth.json --audit frame",
      "yarn_twist --scale smoke --audit frame --set frame_steps=5");
  check_cut_runs(folder / "runs", scene, {"KILL", "INT", "TERM"});
}

TEST_CASE("every solver resumes to the same bits, with its rows by iteration", "[property]") {
  const TemporaryFolder folder;
  const std::string options = GENERATE(
      "newton --iterations --steps 12", "penalty --iterations --steps 6", "ipc --iterations --steps 12",
      "reference_vbd --steps 8", "vbd --iterations --residual --profile --ledger --steps 8",
      "vbd --ledger --jitter 1e-5 --seed 3 --steps 8", "vbd --iterations --profile --repeats 2 --steps 6");
  check_cut_runs(folder / "runs", "cloth_on_sphere --scale smoke --set frame_steps=2 --solver " + options, {"KILL"});
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
  refused({"leave out: SCENE|FILE.json|MESH, --steps"}, " --steps 9 -- twist");
  const std::string scene = compare::read_bytes(run / "scene/cloth_on_sphere.json"),
                    checkpoint = compare::read_bytes(run / "checkpoint.h5"),
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
  rewritten("steps.csv", "\n2,", "\n9,");
  refused({"steps.csv", "not every row"});
}

// A run constructs its simulation, audits and files from the result of resumed_run. So none of them exists yet when
// resumed_run throws.
TEST_CASE("what can't be resumed is refused before anything is computed, and the folder stays as it is", "[unit]") {
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  REQUIRE(run_ogc("run cloth_on_sphere --scale smoke --steps 3 --audit off --out " + run.string()).status == 0);
  const std::string manifest = compare::read_bytes(run / "run.json"), rows = compare::read_bytes(run / "steps.csv");
  const auto written = [&](const std::string& file, const std::string& from, const std::string& to) {
    std::string text = compare::read_bytes(run / file);
    REQUIRE(text.find(from) != std::string::npos);
    compare::write_bytes(run / file, text.replace(text.find(from), from.size(), to));
  };
  const auto refusal = [&] {
    const auto all = [&] {
      std::map<std::string, std::string> files;
      for (const auto& entry : fs::recursive_directory_iterator(run))
        if (entry.is_regular_file()) files[entry.path().string()] = compare::read_bytes(entry.path());
      return files;
    };
    const auto before = all();
    std::string message;
    try {
      experiments::resumed_run(run);
    } catch (const std::exception& error) {
      message = error.what();
    }
    CHECK(all() == before);
    return message;
  };
  CHECK_THAT(refusal(), ContainsSubstring("finished run (3 steps)"));
  written("run.json", "\"finished\"", "\"running\"");
  const std::string running = compare::read_bytes(run / "run.json");
  CHECK(refusal().empty());
  written("run.json", "\"backend\": \"cpu\"", "\"backend\": \"cuda\"");
  CHECK_THAT(refusal(), ContainsSubstring("was computed on ") && ContainsSubstring("Resume it there"));
  compare::write_bytes(run / "run.json", running);
  written("run.json", "\"compiler\": \"", "\"compiler\": \"other ");
  CHECK_THAT(refusal(), ContainsSubstring("another program") && ContainsSubstring("compiler"));
  compare::write_bytes(run / "run.json", running);
  written("steps.csv", "\n2,", "\n9,");
  CHECK_THAT(refusal(), ContainsSubstring("steps.csv") && ContainsSubstring("not every row"));
  compare::write_bytes(run / "steps.csv", rows);
  {
    const compare::LineAppender other(run / "steps.csv", rows.size());
    CHECK_THAT(refusal(), ContainsSubstring("another process writes to it"));
  }
  CHECK(refusal().empty());
}

TEST_CASE("the help of run says that every solver resumes", "[unit]") {
  const std::string help = run_ogc("run --help").out;
  CHECK(contains(help, {"all solvers, IPC, too", "before it computes anything"}));
  CHECK(!contains(help, {"Not with --solver ipc"}));
}

// The file size is limited to 1900 blocks of 512 bytes. Frames are smaller, the trajectory is larger.
TEST_CASE("a run that a full disk ended exits 3, names the file, and goes on to the same bits when there is room",
          "[property]") {
  const TemporaryFolder folder;
  const std::string command = "run cloth_on_sphere --scale smoke --audit off --set frame_steps=1 --out ";
  REQUIRE(run_ogc(command + (folder / "whole").string()).status == 0);
  const fs::path cut = folder / "cut";
  const ProgramResult full = run_ogc(command + cut.string(), "ulimit -f 1900; ");
  INFO(full.err);
  CHECK(full.status == 3);
  CHECK(contains(full.err, {"ogc: ", cut.string(), "can't reserve", "free space"}));
  const compare::RunReader reader(cut);
  CHECK(reader.provenance().status.starts_with("failed: "));
  REQUIRE(reader.frame_count() > 1);
  for (std::size_t i = 0; i < reader.frame_count(); ++i) CHECK_NOTHROW(reader.frame(i));
  const ProgramResult resumed = run_ogc("run --resume " + cut.string());
  INFO(resumed.err);
  REQUIRE(resumed.status == 0);
  check_same_run(folder / "whole", cut);
}

TEST_CASE("a run that is still going on is not resumed by a second program", "[unit]") {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string();
  const std::string first = "'" OGC_PROGRAM "' run twist --scale small --audit off --out " + run +
                            " > /dev/null 2>&1 & first=$!; ";
  const ProgramResult second = run_ogc(
      "run --resume " + run + "; status=$?; kill -9 $first; wait $first 2> /dev/null; exit $status",
      first + "while [ ! -e " + run + "/checkpoint.h5 ]; do sleep 0.05; done; ");
  INFO(second.err);
  CHECK(second.status == 2);
  CHECK(contains(second.err, {"steps.csv", "another process"}));
}
