// Kills runs on the device as tests/experiments/program/runs/resume.cpp does on the CPU.
#include "tests/catch.hpp"
#include "tests/experiments/cut_runs.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc::tests;

TEST_CASE("a run on the device that kill -9, SIGINT or SIGTERM cut off ends with the bits of one that was left alone",
          "[gpu]") {
  const TemporaryFolder folder;
  check_cut_runs(folder / "runs", "cloth_on_sphere --scale small --backend cuda --audit frame --set frame_steps=2",
                 {"KILL", "INT", "TERM"});
}
