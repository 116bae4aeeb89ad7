#include <fstream>

#include <nlohmann/json.hpp>

#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc::tests;

namespace {

std::vector<std::string> lines_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("an ablation makes a run folder for each point of its grid and a table over all", "[figure]") {
  const TemporaryFolder folder;
  const std::filesystem::path out = folder / "grid";
  const ProgramResult result = run_ogc(
      "ablate cloth_on_sphere --scale smoke --steps 2 --vary solver=vbd,newton --vary contact_radius=0.01,0.02 --json "
      "--out " +
      out.string());
  INFO(result.err);
  REQUIRE(result.status == 0);
  CHECK(nlohmann::json::parse(result.out).size() == 4);
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
  for (const char* vary : {"activation=ogc,barrier", "activatoin=ogc", "activation", "iterations=5,",
                           "solver=newton,implicit", "backend=cpu,gpu"}) {
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
