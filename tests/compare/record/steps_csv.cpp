#include "compare/record/steps_csv.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <set>

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/record/small_run.hpp"

using namespace ogc::compare;
using namespace ogc::tests;

namespace {

StepTable read_text(const Scratch& folder, const std::string& text) {
  std::ofstream(folder / "steps.csv", std::ios::binary) << text;
  return read_steps(folder / "");
}

/// Returns a row in which no two columns have the same value.
StepMetrics distinct_metrics() {
  StepMetrics row;
  int k = 1;
  for (const StepColumn& column : step_columns())
    std::visit([&](auto field) { row.*field = static_cast<std::remove_reference_t<decltype(row.*field)>>(k++); },
               column.field);
  return row;
}

}  // namespace

TEST_CASE("each column has a name of its own, a unit and a field of its own", "[unit]") {
  std::set<std::string_view> names;
  std::string values;
  for (const StepColumn& column : step_columns()) {
    names.insert(column.name);
    CHECK_FALSE(column.unit.empty());
    values += (values.empty() ? "" : ",") + std::to_string(names.size());
  }
  CHECK(names.size() == step_columns().size());
  CHECK(step_lines(std::array{distinct_metrics()}, 0) == values + "\n");
  CHECK(step_header({}).starts_with("step [1],wall [ms],"));
}

TEST_CASE("rows come back as the same numbers, whatever they are", "[unit]") {
  const Scratch folder;
  std::vector<StepMetrics> rows{recorded_metrics(1), distinct_metrics()};
  rows[0].wall_ms = 0.1 + 0.2;
  rows[0].kinetic_energy = std::numeric_limits<double>::denorm_min();
  rows[0].elastic_energy = std::numeric_limits<double>::infinity();
  rows[0].largest_lag = -std::nan("");
  rows[0].repeats = std::numeric_limits<std::int64_t>::max();
  rows[0].status = 0xFFFFFFFF;
  rows[1].stage_ms = {0.25, 1e-300};
  const std::vector<std::string> stages{"detect", "sweep"};
  const StepTable table = read_text(folder, step_header(stages) + step_lines(rows, 2));
  CHECK(table.stage_names == stages);
  REQUIRE(table.rows.size() == 2);
  CHECK(table.rows[0].wall_ms == 0.1 + 0.2);
  CHECK(table.rows[0].kinetic_energy == std::numeric_limits<double>::denorm_min());
  CHECK(std::isinf(table.rows[0].elastic_energy));
  CHECK(std::isnan(table.rows[0].largest_lag));
  CHECK(table.rows[0].repeats == std::numeric_limits<std::int64_t>::max());
  CHECK(table.rows[0].status == 0xFFFFFFFF);
  CHECK(std::isnan(table.rows[0].stage_ms.at(1)));
  CHECK(table.rows[1].stage_ms == rows[1].stage_ms);
  CHECK(step_lines(table.rows, 2) == step_lines(rows, 2));
}

TEST_CASE("a ledger's columns come back, each in a field of its own, behind all others but stages", "[unit]") {
  const Scratch folder;
  const std::vector<std::string> stages{"sweep"};
  const StepGroups all{.solids = true, .volumes = true, .sheets = true, .ledger = true},
      common{.solids = true, .volumes = true, .sheets = true};
  const std::string header = step_header(stages, all);
  CHECK(
      header.starts_with(step_header({}, common).substr(0, step_header({}, common).size() - 1) + ",energy_start [J],"));
  CHECK(header.ends_with(",vertices_held [1],stage_sweep [ms]\n"));
  std::string line = "1";
  const auto count = std::ranges::count(header, ',') + 1;
  for (std::ptrdiff_t k = 2; k <= count; ++k) line += "," + std::to_string(k);
  const StepTable table = read_text(folder, header + line + "\n");
  REQUIRE(table.rows.size() == 1);
  CHECK(table.groups == all);
  REQUIRE(table.rows[0].ledger);
  CHECK(table.rows[0].inverted_tetrahedra == 24);
  CHECK(table.rows[0].volume_contacts == 25);
  CHECK(table.rows[0].vertices_inside == 26);
  CHECK(table.rows[0].deepest == 27);
  CHECK(table.rows[0].depth_unresolved == 28);
  CHECK(table.rows[0].ledger->energy_start == 29);
  CHECK(table.rows[0].ledger->vertices_held == 53);
  CHECK(table.rows[0].stage_ms == std::vector<double>{54});
  CHECK(step_lines(table.rows, 1, all) == line + "\n");
  CHECK(read_text(folder, step_header(stages, common)).groups == common);
  CHECK(read_text(folder, step_header(stages, {.volumes = true})).groups == StepGroups{.volumes = true});
  for (const StepGroups& groups : {StepGroups{.rods = true}, StepGroups{.solids = true, .volumes = true, .rods = true},
                                   StepGroups{.rods = true, .ledger = true}})
    CHECK(read_text(folder, step_header(stages, groups)).groups == groups);
  const auto refuses_without = [&](const std::string& title, const StepGroups& groups) {
    const std::string whole = step_header({}, groups);
    CHECK_THROWS_WITH(read_text(folder, whole.substr(0, whole.find("," + title)) + "\n"),
                      ContainsSubstring("is expected"));
  };
  refuses_without("vertices_inside", {.volumes = true});
  refuses_without("momentum_sweep_z", {.ledger = true});
  refuses_without("mean_stretch", {.rods = true});
}

TEST_CASE(
    "meetings come back in a column of their own behind volumes and before a ledger, not-a-number where not asked",
    "[unit]") {
  const Scratch folder;
  const StepGroups groups{.volumes = true, .meetings = true, .ledger = true};
  const std::string header = step_header({}, groups);
  CHECK(header.find(",deepest [m],meetings [1],energy_start [J],") != std::string::npos);
  StepMetrics asked;
  asked.meetings = 3;
  const std::array rows{asked, StepMetrics{}};
  const StepTable table = read_text(folder, header + step_lines(rows, 0, groups));
  CHECK(table.groups == groups);
  REQUIRE(table.rows.size() == 2);
  CHECK(table.rows[0].meetings == 3);
  CHECK(std::isnan(table.rows[1].meetings));
}

TEST_CASE("how far a step was solved comes back behind all but a ledger, and files without it are read", "[unit]") {
  const Scratch folder;
  const StepGroups groups{.rods = true, .meetings = true, .convergence = true, .ledger = true};
  const std::string header = step_header({}, groups);
  CHECK(header.find(
            ",meetings [1],last_motion [1],left_residual [1],left_rounding [1],left_held [1],energy_start [J],") !=
        std::string::npos);
  StepMetrics measured;
  measured.last_motion = 0.5, measured.left_residual = 0.25, measured.left_rounding = 0.125, measured.left_held = 3;
  const std::array rows{measured, StepMetrics{}};
  const StepTable table = read_text(folder, header + step_lines(rows, 0, groups));
  CHECK(table.groups == groups);
  REQUIRE(table.rows.size() == 2);
  CHECK(std::array{table.rows[0].last_motion, table.rows[0].left_residual, table.rows[0].left_rounding,
                   table.rows[0].left_held} == std::array{0.5, 0.25, 0.125, 3.0});
  CHECK(std::isnan(table.rows[1].left_residual));
  CHECK(read_text(folder, step_header({}, {.rods = true})).groups == StepGroups{.rods = true});
}

TEST_CASE("a row without a ledger has not-a-number in each of its columns", "[unit]") {
  const Scratch folder;
  const StepTable table = read_text(
      folder, step_header({}, {.ledger = true}) + step_lines(std::array{StepMetrics{}}, 0, {.ledger = true}));
  REQUIRE(table.rows.size() == 1);
  CHECK(std::isnan(table.rows[0].ledger->energy_start));
  CHECK(std::isnan(table.rows[0].ledger->vertices_held));
}

TEST_CASE("a row with times for another number of stages is refused", "[unit]") {
  StepMetrics row;
  row.stage_ms = {1, 2};
  CHECK_THROWS_AS(step_lines(std::array{row}, 3), std::invalid_argument);
}

TEST_CASE("the half line of a killed run is left out", "[unit]") {
  const Scratch folder;
  const std::string lines = step_lines(std::array{recorded_metrics(1), recorded_metrics(2)}, 0);
  CHECK(read_text(folder, step_header({}) + lines).rows.size() == 2);
  CHECK(read_text(folder, step_header({}) + lines.substr(0, lines.size() - 1)).rows.size() == 1);
  CHECK(read_text(folder, step_header({})).rows.empty());
}

TEST_CASE("a damaged table is refused with file and line", "[unit]") {
  const Scratch folder;
  const std::string header = step_header({}), line = step_lines(std::array{recorded_metrics(1)}, 0);
  CHECK_THROWS_WITH(read_text(folder, header + line + "1,2,x\n"), ContainsSubstring("steps.csv: line 3"));
  CHECK_THROWS_WITH(read_text(folder, header + "x" + line), ContainsSubstring("line 2"));
  CHECK_THROWS_WITH(read_text(folder, "step,wall\n"), ContainsSubstring("'step [1]' is expected"));
  CHECK_THROWS_WITH(read_text(folder, header.substr(0, header.size() - 1) + ",mood\n"), ContainsSubstring("'mood'"));
  CHECK_THROWS_AS(read_text(folder, ""), InputError);
  CHECK_THROWS_AS(read_steps(folder / "nowhere"), InputError);
}

TEST_CASE("rows of run format 1, with the former names of two columns, come back as rows of today", "[unit]") {
  const Scratch folder;
  std::string header = step_header({});
  const auto rename = [&](const std::string& name, const std::string& former) {
    const std::size_t at = header.find("," + name + " [");
    REQUIRE(at != std::string::npos);
    header.replace(at + 1, name.size(), former);
  };
  rename("vertices_cut", "vertices_at_bound");
  rename("share_cut", "share_at_bound");
  const StepMetrics row = distinct_metrics();
  const StepTable table = read_text(folder, header + step_lines(std::array{row}, 0));
  REQUIRE(table.rows.size() == 1);
  CHECK(table.rows[0].vertices_cut == row.vertices_cut);
  CHECK(table.rows[0].share_cut == row.share_cut);
  rename("vertices_at_bound", "vertices_held");
  CHECK_THROWS_AS(read_text(folder, header + step_lines(std::array{row}, 0)), InputError);
}
