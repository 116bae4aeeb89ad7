#include <nlohmann/json.hpp>

#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc::tests;

TEST_CASE("ogc laws lists its laws with what they prove", "[unit]") {
  const ProgramResult result = run_ogc("laws --list");
  REQUIRE(result.status == 0);
  CHECK(contains(result.out, {"free_fall", "slope_slides", "falls", "x_n = x_0 + n h v_0"}));
}

TEST_CASE("ogc laws asks one law of one solver, with what it measured beside the answer", "[unit]") {
  const ProgramResult result = run_ogc("laws free_fall --solver vbd --bounds planes --quick");
  CHECK(result.status == 0);
  CHECK(
      contains(result.out, {"free_fall", "vbd", "cpu", "planes", "holds", "1 hold, 0 limits, 0 broken, 0 not asked"}));
  CHECK(contains(result.err, {"row"}));
}

TEST_CASE("ogc laws without options asks vbd with both bounds, newton and ipc", "[unit]") {
  const ProgramResult result = run_ogc("laws free_fall lets_go --quick --json");
  const nlohmann::json json = nlohmann::json::parse(result.out);
  std::vector<std::string> asked;
  for (const auto& row : json.at("rows"))
    asked.push_back(row.at("law").get<std::string>() + " " + row.at("solver").get<std::string>() + " " +
                    row.at("bounds").get<std::string>());
  CHECK(asked == std::vector<std::string>{"free_fall vbd ball", "free_fall vbd planes", "free_fall newton ball",
                                          "free_fall ipc ccd", "lets_go vbd ball", "lets_go vbd planes",
                                          "lets_go newton ball", "lets_go ipc ccd"});
  CHECK(json.at("rows").back().at("verdict") == "not asked");
  CHECK(json.at("rows").back().at("why") == "its contacts are barriers, no springs of method.md §4.2");
  CHECK(json.at("broken") == (result.status == 1));
}

TEST_CASE("ogc laws says that a row is a limit, why, and does not fail for it", "[unit]") {
  const ProgramResult result = run_ogc("laws bounces --solver vbd --bounds ball --quick");
  CHECK(result.status == 0);
  CHECK(
      contains(result.out, {"limit", "limit of bounces (vbd): contacts that are listed", "contact_margin", "1 limit"}));
}

TEST_CASE("ogc laws refuses unknown names and options that do not belong together", "[unit]") {
  ProgramResult result = run_ogc("laws free_fal");
  CHECK(result.status == 2);
  CHECK(contains(result.err, {"unknown law 'free_fal'", "did you mean 'free_fall'", "slope_slides"}));
  result = run_ogc("laws free_fall --solver newton --backend cuda");
  CHECK(result.status == 2);
  CHECK(contains(result.err, {"--backend belongs to --solver vbd"}));
  result = run_ogc("laws free_fall --solver ipc --bounds planes");
  CHECK(result.status == 2);
  CHECK(run_ogc("laws --solver penalty").status == 2);
}
