#include "tests/catch.hpp"
#include "tests/compare/judge/engine/loose_problems.hpp"

using namespace ogc::compare;
using ogc::tests::loose_problems;

namespace {

/// Returns a report in which the largest error of each metric is `share` of its tolerance.
StageReport report_with(Stage stage, double share) {
  StageReport report{Tally(stage)};
  for (std::size_t i = 0; i < report.tally.metrics.size(); ++i)
    report.tally.metrics[i].errors.add(share * metrics(stage)[i].tolerance);
  return report;
}

}  // namespace

TEST_CASE("a loose tolerance that is not listed is a problem, with numbers, and so is a listed one that is not loose",
          "[unit]") {
  CHECK(loose_problems(std::vector{report_with(Stage::spring, 0.021), report_with(Stage::bound, 0)}).empty());
  const auto loose = loose_problems(std::vector{report_with(Stage::spring, 0.019)});
  REQUIRE(loose.size() == 2);
  CHECK_THAT(loose[1], ContainsSubstring("spring force: loose, and not listed"));
  CHECK_THAT(loose[1], ContainsSubstring("largest error 0.228, accepted 12"));
  const auto rotten = loose_problems(std::vector{report_with(Stage::bound, 0.5)});
  REQUIRE(rotten.size() == 1);
  CHECK_THAT(rotten[0], ContainsSubstring("bound bound: listed"));
}

TEST_CASE("reports of one stage count together, and a metric without errors says nothing", "[unit]") {
  CHECK(loose_problems(std::vector{report_with(Stage::spring, 0), report_with(Stage::spring, 0.5)}).empty());
  CHECK(loose_problems(std::vector{StageReport{Tally(Stage::spring)}}).empty());
}

TEST_CASE("a tolerance that may be loose says why at length", "[unit]") {
  std::size_t listed = 0;
  for (const Stage stage : all_stages)
    for (const MetricInfo& info : metrics(stage)) {
      if (info.loose_because.empty()) continue;
      ++listed;
      INFO(stage_name(stage) << " " << info.name);
      CHECK(info.loose_because.size() > 40);
    }
  CHECK(listed == 2);
}
