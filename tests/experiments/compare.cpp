// Tests the judge with a contestant and the reference: it passes the exact contestant, catches every planted fault, and
// `ogc compare` reports both.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "compare/judge/engine/judge.hpp"
#include "compare/judge/report/corpus.hpp"
#include "compare/judge/report/explanation.hpp"
#include "compare/stages/bound.hpp"
#include "fast/contestant.hpp"
#include "reference/contestant.hpp"
#include "reference/solvers/step.hpp"
#include "tests/catch.hpp"
#include "tests/compare/judge/engine/loose_problems.hpp"
#include "tests/compare/judge/faults.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::compare;

namespace {

JudgeOptions few_cases(Stage stage) {
  JudgeOptions options;
  options.cases = is_mesh_stage(stage) ? 1000 : 4000;
  options.batch = 1000;
  options.seed = 5;
  return options;
}

std::string first_mismatch(const StageReport& report) {
  if (report.tally.mismatches.empty()) return "no mismatch";
  return print_problem(report.tally.mismatches[0].name) + ": " + report.tally.mismatches[0].message;
}

/// Selects planted faults:
/// - in_any_way: all
/// - by_any: faults that a mix of all generators' cases reveals
/// - by_its_own: faults that need the cases of one named generator
enum class Shown { in_any_way, by_any, by_its_own };

/// Checks that the judge catches the faults planted in these stages.
void check_caught(const std::vector<Stage>& stages, Shown shown = Shown::in_any_way) {
  const Authority authority = reference::authority();
  for (const tests::Fault& fault : tests::faults()) {
    if (std::ranges::find(stages, fault.stage) == stages.end()) continue;
    if (shown == (fault.generator.empty() ? Shown::by_its_own : Shown::by_any)) continue;
    Contestant wrong = tests::exact_contestant(authority);
    fault.plant(wrong, authority);
    JudgeOptions options = few_cases(fault.stage);
    options.generator = fault.generator;
    // A fault that only one generator reveals needs more cases, because few of them come from this generator.
    const std::uint64_t most = (fault.generator.empty() ? 1 : 20) * options.cases;
    std::uint64_t found = 0;
    // Most faults appear in a twentieth of the cases. For the others, more cases are tried.
    for (options.cases /= 20; found == 0 && options.cases <= most; options.cases *= 20)
      found = judge_stage(fault.stage, wrong, authority, options).tally.mismatched;
    INFO(fault.name);
    CHECK(found > 0);
  }
}

}  // namespace

TEST_CASE("the exact answers pass their own judge", "[agreement]") {
  const Authority authority = reference::authority();
  const Contestant exact = tests::exact_contestant(authority);
  for (const Stage stage : all_stages) {
    const StageReport report = judge_stage(stage, exact, authority, few_cases(stage));
    INFO(first_mismatch(report));
    REQUIRE(report.passed());
  }
}

TEST_CASE("the judge catches every planted fault of a step that any generator shows", "[agreement]") {
  check_caught({Stage::step}, Shown::by_any);
}
TEST_CASE("the judge catches every planted fault of a step that needs a generator of its own", "[agreement]") {
  check_caught({Stage::step}, Shown::by_its_own);
}

// A wrong guess also makes the sweep wrong, but the judge must name the guess.
TEST_CASE("the judge says of a wrong rule for what contacts leave that it is the guess that is wrong", "[agreement]") {
  const Authority authority = reference::authority();
  int asked = 0;
  for (const tests::Fault& fault : tests::faults()) {
    if (fault.stage != Stage::step || !fault.name.ends_with(" in the guess loop")) continue;
    Contestant wrong = tests::exact_contestant(authority);
    fault.plant(wrong, authority);
    const StageReport report = judge_stage(Stage::step, wrong, authority, few_cases(Stage::step));
    INFO(fault.name);
    CHECK(std::ranges::any_of(report.tally.mismatches, [](const Mismatch& mismatch) {
      return mismatch.message.find(", which touches, is ") != std::string::npos;
    }));
    ++asked;
  }
  CHECK(asked == 2);
}

TEST_CASE("the judge catches every planted fault of a sweep", "[agreement]") { check_caught({Stage::sweep}); }

TEST_CASE("the judge catches every planted fault of all other stages", "[agreement]") {
  std::vector<Stage> others(std::begin(all_stages), std::end(all_stages));
  std::erase_if(others, [](Stage stage) { return stage == Stage::step || stage == Stage::sweep; });
  check_caught(others);
}

TEST_CASE("a report does not depend on the number of threads", "[agreement]") {
  const Authority authority = reference::authority();
  const Contestant fast = fast::contestant(fast::Backend::cpu);
  for (const Stage stage : {Stage::closest_face, Stage::detect_edge_edge}) {
    JudgeOptions options = few_cases(stage);
    options.threads = 1;
    const StageReport one = judge_stage(stage, fast, authority, options);
    options.threads = 3;
    const StageReport three = judge_stage(stage, fast, authority, options);
    REQUIRE(one.tally.total().cases == three.tally.total().cases);
    REQUIRE(one.tally.total().decisions == three.tally.total().decisions);
    REQUIRE(one.tally.mismatched == three.tally.mismatched);
    for (std::size_t i = 0; i < one.tally.metrics.size(); ++i) {
      REQUIRE(one.tally.metrics[i].errors.maximum() == three.tally.metrics[i].errors.maximum());
      REQUIRE(one.tally.metrics[i].worst == three.tally.metrics[i].worst);
    }
  }
}

TEST_CASE("threads without work begin no batches beyond the last", "[agreement]") {
  const Authority authority = reference::authority();
  Contestant slow = tests::exact_contestant(authority);
  slow.truncate = [right = slow.truncate](const TruncateIn& in) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return right(in);
  };
  JudgeOptions options;
  options.cases = 100;
  options.batch = 40;
  options.threads = 6;
  options.generator = "uniform";
  int batches = 0;
  options.progress = [&](std::uint64_t, std::uint64_t) { ++batches; };
  const StageReport report = judge_stage(Stage::truncate, slow, authority, options);
  CHECK(batches == 3);
  CHECK(report.tally.questions == 100);
}

TEST_CASE("of a mesh stage no thread begins more than one batch that nobody wants", "[agreement]") {
  const Authority authority = reference::authority();
  Contestant counting = tests::exact_contestant(authority);
  std::atomic<std::uint64_t> asked = 0;
  counting.bound = [right = counting.bound, &asked](const BoundIn& in) {
    ++asked;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return right(in);
  };
  JudgeOptions options;
  options.cases = 3000;
  options.threads = 6;
  options.generator = "soup";
  const StageReport report = judge_stage(Stage::bound, counting, authority, options);
  constexpr std::uint64_t meshes = 4;  // meshes of a batch
  CHECK(report.tally.total().cases >= options.cases);
  CHECK(asked <= report.tally.questions + meshes * options.threads);
}

TEST_CASE(
    "the fast path on the CPU agrees with the reference in every stage, and no tolerance is loose without a reason",
    "[agreement]") {
  const Authority authority = reference::authority();
  const Contestant fast = fast::contestant(fast::Backend::cpu);
  std::vector<TestCase> nearest;
  for (const CaseName& name : load_batch(OGC_SOURCE_DIR "/tests/experiments/nearest.txt"))
    nearest.push_back(generate(name));
  std::vector<StageReport> reports = judge_cases(nearest, fast, authority);
  for (const Stage stage : all_stages) {
    JudgeOptions options = few_cases(stage);
    options.cases *= 10;
    reports.push_back(judge_stage(stage, fast, authority, options));
  }
  for (const StageReport& report : reports) {
    INFO(first_mismatch(report));
    CHECK(report.tally.mismatched == 0);
    // With few cases the share of grey cases has no meaning.
    CHECK((report.passed() || report.tally.total().cases < few_cases(report.tally.stage).cases));
  }
  CHECK(tests::loose_problems(reports) == std::vector<std::string>{});
}

TEST_CASE("cases that once told the two sides apart no longer do", "[agreement]") {
  std::vector<TestCase> cases;
  for (const CaseName& name : load_batch(OGC_SOURCE_DIR "/tests/experiments/corpus.txt"))
    cases.push_back(generate(name));
  REQUIRE(cases.size() > 10);
  for (const StageReport& report : judge_cases(cases, fast::contestant(fast::Backend::cpu), reference::authority())) {
    INFO(first_mismatch(report));
    REQUIRE(report.tally.mismatched == 0);
  }
}

TEST_CASE("coordinates of 10^-28 beside an axis decide which face is closest", "[agreement]") {
  const Vec3f a{0, 0, 0.25f}, b{1.1920929e-07f, 0, 0}, c{0, 4.03896783e-28f, 0};
  const CaseName name{Stage::closest_face, "dust", 1, 0, "", {}};
  const std::vector<TestCase> cases{{name, ClosestFaceCase{{}, {a, b, c}}},
                                    {name, ClosestFaceCase{{}, {b, c, a}}},
                                    {name, ClosestFaceCase{{}, {b, a, c}}}};
  const std::vector<StageReport> reports = judge_cases(cases, fast::contestant(fast::Backend::cpu),
                                                       reference::authority());
  INFO(first_mismatch(reports[0]));
  CHECK(reports[0].tally.mismatched == 0);
}

TEST_CASE("what a contestant throws reaches the caller", "[agreement]") {
  const Authority authority = reference::authority();
  Contestant broken = tests::exact_contestant(authority);
  broken.closest_face = [](const ClosestFaceIn&) -> ClosestFaceOut { throw std::runtime_error("no device"); };
  REQUIRE_THROWS_WITH(judge_stage(Stage::closest_face, broken, authority, few_cases(Stage::closest_face)), "no device");
  broken.bound = nullptr;
  REQUIRE(judge_stage(Stage::bound, broken, authority, few_cases(Stage::bound)).skipped);
}

TEST_CASE("ogc compare judges stages and writes a report", "[agreement]") {
  const tests::TemporaryFolder folder;
  const std::string report = (folder / "report").string();
  const tests::ProgramResult result = tests::run_ogc("compare bound truncate --cases 1000 --seed 3 --json --report " +
                                                     report);
  REQUIRE(result.status == 0);
  const auto json = nlohmann::json::parse(result.out);
  REQUIRE(json.at("stages").size() == 2);
  REQUIRE(json.at("stages").at(1).at("stage") == "truncate");
  // The number of cases is rounded up for each generator.
  const auto cases = json.at("stages").at(1).at("cases").get<std::size_t>();
  REQUIRE(cases >= 1000);
  REQUIRE(cases <= 1000 + generators(Stage::truncate).size());
  REQUIRE(json.at("stages").at(1).at("mismatches") == 0);
  REQUIRE(std::filesystem::exists(folder / "report" / "report.jsonl"));
  REQUIRE(std::filesystem::exists(folder / "report" / "report.txt"));
}

TEST_CASE("ogc compare says which stages the fast path does not have, and passes without them", "[agreement]") {
  const tests::ProgramResult all = tests::run_ogc("compare --cases 20");
  INFO(all.out << all.err);
  CHECK(all.status == 0);
  CHECK(tests::contains(all.out, {"\nccd: skipped, for the contestant does not have this stage\n",
                                  "\nbarrier: skipped, for the contestant does not have this stage\n"}));
  CHECK_FALSE(tests::contains(all.out, {"truncate: skipped"}));
  const tests::ProgramResult one = tests::run_ogc("compare --problem 'stage=ccd gen=uniform seed=1 index=0'");
  CHECK(one.status == 1);
  CHECK(tests::contains(one.out, {"ccd: skipped"}));
}

TEST_CASE("ogc compare reports the end of a stage once", "[agreement]") {
  const tests::ProgramResult result = tests::run_ogc("compare truncate --cases 50000");
  const std::string end = "50000/50000";
  const std::size_t first = result.err.find(end);
  REQUIRE(first != std::string::npos);
  REQUIRE(result.err.find(end, first + 1) == std::string::npos);
}

TEST_CASE("ogc compare takes a problem string, a batch file and a saved case", "[agreement]") {
  const tests::TemporaryFolder folder;
  const std::string problem = "stage=truncate gen=ladder.bound seed=7 index=12";
  const tests::ProgramResult one = tests::run_ogc("compare --problem \"" + problem + "\"");
  REQUIRE(one.status == 0);
  REQUIRE(tests::contains(one.out, {"truncate", problem}));
  const auto batch = folder.write("corpus.txt", problem + "\nstage=bound gen=few seed=1 index=4\n");
  REQUIRE(tests::run_ogc("compare --batch " + batch.string()).status == 0);
  const auto saved = save_case(folder / "saved", generate(parse_problem(problem)), "by hand");
  REQUIRE(tests::run_ogc("compare --replay " + saved.string()).status == 0);
}

TEST_CASE(
    "a case of any stage is told whole: inputs by name and unit, both answers of one shape, right where the judge "
    "finds nothing",
    "[agreement]") {
  const Authority authority = reference::authority();
  const Contestant fast = fast::contestant(fast::Backend::cpu);
  const Contestant right = tests::exact_contestant(authority);
  for (const Stage stage : all_stages)
    for (std::uint64_t index = 0; index < 3; ++index) {
      const TestCase test = generate({stage, std::string(generators(stage)[0].name), 5, index, "", {}});
      const Explanation told = explain(test, can_judge(stage, fast, authority) ? fast : right, authority);
      INFO(explanation_text(told));
      CHECK(told.messages.empty());
      std::size_t units = 0;
      for (const Quantity& input : told.inputs) {
        CHECK_FALSE(input.name.empty());
        CHECK((input.labels.empty() || input.labels.size() == input.entries()));
        units += !input.unit.empty();
      }
      CHECK(units > 0);
      REQUIRE_FALSE(told.answers.outputs.empty());
      for (const auto& [given, exact] : told.answers.outputs) {
        CHECK(given.name == exact.name);
        CHECK(given.unit == exact.unit);
        CHECK(given.numbers.size() == exact.numbers.size());
        CHECK(given.words.size() == exact.words.size());
        for (std::size_t k = 0; k < exact.numbers.size(); ++k)
          if (stage == Stage::ccd)  // an impact may be reported early (compare/stages/ccd.hpp)
            CHECK(given.numbers[k] <= exact.numbers[k]);
          else
            CHECK(given.numbers[k] == Approx(exact.numbers[k]).epsilon(1e-2).margin(1e-2));
      }
      const auto json = explanation_json(told);
      CHECK(json.at("inputs").size() == told.inputs.size());
      CHECK(json.at("answers").size() == told.answers.outputs.size());
    }
}

TEST_CASE("ogc compare --problem prints the case by name and unit, and the whole of it as JSON", "[agreement]") {
  const std::string problem = "--problem 'stage=detect_vertex_facet gen=cloth seed=7 index=2'";
  const tests::ProgramResult text = tests::run_ogc("compare " + problem),
                             whole = tests::run_ogc("compare --json " + problem);
  REQUIRE(text.status == 0);
  CHECK(tests::contains(text.out, {"  right\n", "inputs\n", "  contact_radius [m]: ", "  positions [m]:\n    0: (",
                                   "your answer, and the exact one\n", "  d_min_vertex [m]"}));
  const auto told = nlohmann::json::parse(whole.out).at("explained").at(0);
  const TestCase test = generate(parse_problem("stage=detect_vertex_facet gen=cloth seed=7 index=2"));
  const auto& mesh = case_of<MeshCase>(test.data);
  for (const auto& input : told.at("inputs")) {
    if (input.at("name") == "contact_radius") CHECK(input.at("value").get<float>() == mesh.contact_radius);
    if (input.at("name") != "positions") continue;
    CHECK(input.at("unit") == "m");
    REQUIRE(input.at("value").size() == mesh.positions.size());
    CHECK(input.at("value").back().at(1).get<float>() == mesh.positions.back().y);
  }
  for (const auto& answer : told.at("answers"))
    if (answer.at("name") == "d_min_vertex") CHECK(answer.at("given").size() == mesh.positions.size());
}

TEST_CASE("ogc compare refuses unknown stages, generators, backends and files with exit status 2", "[agreement]") {
  const auto refuses = [](const std::string& arguments, const std::string& what) {
    const tests::ProgramResult result = tests::run_ogc("compare " + arguments);
    INFO(arguments << ": " << result.err);
    REQUIRE(result.status == 2);
    REQUIRE(tests::contains(result.err, {what}));
  };
  refuses("closest_fce", "closest_face");
  refuses("bound --generator unifrom", "ladder.fan");
  refuses("--backend vulkan", "cuda");
  refuses("--cases 0", "--cases");
  refuses("--replay nothing.json", "nothing.json");
  refuses("--batch nothing.txt", "nothing.txt");
  refuses("--problem \"stage=bound\"", "gen");
  refuses("--states nothing", "nothing");
  refuses("ccd", "the fast path does not have the stage ccd");
}
