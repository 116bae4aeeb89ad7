// Judges all planted faults in one program. `planted_faults` judges each and prints a table of how many cases each
// needed; `planted_faults NUMBER` judges one on 1,000 cases and prints the judge's report. The exit status is 1 if the
// judge misses a fault: in 10⁵ cases of all, in 1,000 of one.
#include <cstdio>
#include <string>
#include <vector>

#include "compare/judge/engine/judge.hpp"
#include "compare/judge/report/report.hpp"
#include "reference/contestant.hpp"
#include "tests/compare/judge/faults.hpp"

namespace {

using namespace ogc;
using namespace ogc::compare;

constexpr std::uint64_t most_cases = 100000;

StageReport judged(const tests::Fault& fault, const Authority& authority, std::uint64_t cases) {
  Contestant wrong = tests::exact_contestant(authority);
  fault.plant(wrong, authority);
  JudgeOptions options;
  options.cases = cases;
  options.batch = 1000;
  options.generator = fault.generator;
  return judge_stage(fault.stage, wrong, authority, options);
}

/// Judges runs of 10, 20, 50, 100, … cases until one finds the fault. Returns how many cases that run counted, 0 if
/// none finds it.
std::uint64_t cases_needed(const tests::Fault& fault, const Authority& authority) {
  for (std::uint64_t decade = 10; decade <= most_cases; decade *= 10)
    for (const std::uint64_t step : {1u, 2u, 5u}) {
      if (decade * step > most_cases) return 0;
      const StageReport report = judged(fault, authority, decade * step);
      if (report.tally.mismatched > 0) return report.tally.total().cases;
    }
  return 0;
}

int judge_one(const tests::Fault& fault, const Authority& authority) {
  const StageReport report = judged(fault, authority, 1000);
  std::printf("%s\n%s", fault.name.c_str(), report_mismatches(report, 3).c_str());
  return report.tally.mismatched > 0 ? 0 : 1;
}

int judge_all(const std::vector<tests::Fault>& faults, const Authority& authority) {
  std::size_t missed = 0;
  std::printf("| no. | stage | fault | cases |\n|---|---|---|---|\n");
  for (std::size_t i = 0; i < faults.size(); ++i) {
    const std::uint64_t cases = cases_needed(faults[i], authority);
    missed += cases == 0;
    const std::string name = faults[i].name.substr(faults[i].name.find(": ") + 2);
    std::printf("| %zu | %s | %s | %s |\n", i + 1, std::string(stage_name(faults[i].stage)).c_str(), name.c_str(),
                cases == 0 ? "not found" : std::to_string(cases).c_str());
    std::fflush(stdout);
  }
  std::printf("\n%zu faults, %zu found\n", faults.size(), faults.size() - missed);
  return missed == 0 ? 0 : 1;
}

}  // namespace

int main(int count, char** words) {
  const std::vector<tests::Fault> faults = tests::faults();
  const Authority authority = reference::authority();
  if (count < 2) return judge_all(faults, authority);
  const std::size_t number = std::stoul(words[1]);
  if (number < 1 || number > faults.size()) {
    std::fprintf(stderr, "there are faults 1 to %zu\n", faults.size());
    return 2;
  }
  return judge_one(faults[number - 1], authority);
}
