// Tests the device against the reference, with the judge and the cases of the CPU's tests.
#include "tests/catch.hpp"

#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/engine/judge.hpp"
#include "compare/judge/report/report.hpp"
#include "experiments/program/stage_list.hpp"
#include "fast/contestant.hpp"
#include "reference/contestant.hpp"

using namespace ogc;
using namespace ogc::compare;

TEST_CASE("the fast path on CUDA agrees with the reference in every stage", "[gpu]") {
  const Authority authority = reference::authority();
  const Contestant device = fast::contestant(fast::Backend::cuda);
  for (const Stage stage : all_stages) {
    JudgeOptions options;
    options.cases = is_mesh_stage(stage) ? 10000 : 40000;
    options.seed = 5;
    const StageReport report = judge_stage(stage, device, authority, options);
    INFO(stage_name(stage) << "\n" << report_mismatches(report, 1));
    // tests/experiments/program/stage_list.cpp checks which stages `fast` has
    CHECK((report.passed() || report.skipped));
  }
}

TEST_CASE(
    "the device gives the same bits again, shuffled, in small batches, with other blocks and as on devices of other "
    "sizes",
    "[gpu]") {
  for (const DeterminismReport& report : experiments::determinism_of(fast::Backend::cuda, all_stages, 1000, 5)) {
    INFO(stage_name(report.stage) << (report.changed.empty() ? "" : ": " + report.changed[0]));
    CHECK(report.changed.empty());
  }
}

#if defined(OGC_STRICT)
TEST_CASE("in the strict build every stage has the host's bits that promises them", "[gpu]") {
  const auto host = experiments::determinism_of(fast::Backend::cpu, all_stages, 1000, 5);
  const auto device = experiments::determinism_of(fast::Backend::cuda, all_stages, 1000, 5);
  for (std::size_t i = 0; i < host.size(); ++i) {
    INFO(stage_name(host[i].stage));
    if (stage_info(host[i].stage).determinism == Determinism::cpu_to_gpu) CHECK(host[i].digest == device[i].digest);
  }
}
#endif
