#include "compare/judge/loose.hpp"

#include "tests/catch.hpp"
#include "tests/compare/judge/loose_problems.hpp"

using namespace ogc::compare;
using ogc::tests::loose_problems;

namespace {

/// A report in which the largest error of each metric is this share of its tolerance.
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

TEST_CASE("each listed tolerance is one that there is, once, with a reason", "[unit]") {
  for (const LooseTolerance& listed : listed_loose) {
    INFO(stage_name(listed.stage) << " " << listed.metric);
    const auto infos = metrics(listed.stage);
    CHECK(std::any_of(infos.begin(), infos.end(), [&](const MetricInfo& info) { return info.name == listed.metric; }));
    CHECK(listed.reason.size() > 40);
    CHECK(reason_of_loose(listed.stage, listed.metric) == listed.reason);
  }
  CHECK_FALSE(reason_of_loose(Stage::spring, "force"));
}
