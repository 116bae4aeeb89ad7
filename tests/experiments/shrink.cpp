// Tests how the judge shrinks failing cases, with planted faults: at least three quarters of the shrunk cases must have
// at most two primitives.
#include <algorithm>

#include "compare/judge/engine/judge.hpp"
#include "compare/judge/engine/shrink.hpp"
#include "reference/contestant.hpp"
#include "tests/catch.hpp"
#include "tests/compare/judge/faults.hpp"

using namespace ogc;
using namespace ogc::compare;

TEST_CASE("failing cases of planted faults in the detections shrink to two primitives, as a rule, and still fail",
          "[agreement]") {
  const Authority authority = reference::authority();
  std::vector<std::size_t> counts;
  for (const tests::Fault& fault : tests::set_faults()) {
    if (fault.stage != Stage::detect_vertex_facet && fault.stage != Stage::detect_edge_edge) continue;
    Contestant wrong = tests::exact_contestant(authority);
    fault.plant(wrong, authority);
    JudgeOptions options;
    options.cases = 1000;
    options.seed = 5;
    const StageReport report = judge_stage(fault.stage, wrong, authority, options);
    if (report.tally.mismatches.empty()) continue;
    const Mismatch& mismatch = report.tally.mismatches[0];
    const TestCase small = shrink_failure(generate(mismatch.name), mismatch.message, wrong, authority,
                                          {.tries = 1000, .seconds = 2});
    INFO(fault.name << ": " << primitive_count(small));
    const auto again = judge_cases({&small, 1}, wrong, authority);
    // A stale answer depends on the previous case, so a case alone does not reveal this fault.
    if (fault.name.find("stale") == std::string::npos) CHECK(again[0].tally.mismatched > 0);
    counts.push_back(primitive_count(small));
  }
  REQUIRE(counts.size() > 10);
  std::sort(counts.begin(), counts.end());
  CHECK(counts[counts.size() / 2] <= 2);
  CHECK(std::count_if(counts.begin(), counts.end(), [](std::size_t n) { return n <= 2; }) >=
        static_cast<std::ptrdiff_t>(counts.size() * 3 / 4));
}
