// Tests cases from states of runs: frames of each scene give every stage only cases that its contract allows, and
// contestant and reference agree about them.
#include "compare/judge/cases/states.hpp"

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/legal.hpp"
#include "compare/judge/engine/judge.hpp"
#include "experiments/scenes/registry.hpp"
#include "fast/contestant.hpp"
#include "reference/contestant.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::compare;

namespace {

constexpr std::uint64_t frames = 6;

/// Returns whether these states give cases of the stage. Cases of rest_state do not come from frames.
bool is_asked(Stage stage, const States& states) { return stage != Stage::rest_state && states.missing(stage).empty(); }

}  // namespace

TEST_CASE("every question that frames of any scene lead to is legal, and the CPU agrees with the reference about it",
          "[agreement]") {
  const Authority authority = reference::authority();
  const Contestant fast = fast::contestant(fast::Backend::cpu);
  for (const experiments::SceneInfo& info : experiments::scenes()) {
    const tests::TemporaryFolder folder;
    const std::string run = (folder / "run").string();
    const tests::ProgramResult made = tests::run_ogc("run " + std::string(info.name) + " --scale smoke --steps " +
                                                     std::to_string(frames - 1) +
                                                     " --set frame_steps=1 --audit off --out " + run);
    INFO(info.name << ": " << made.err);
    REQUIRE(made.status == 0);
    const States states(run, authority);
    for (const Stage stage : all_stages) {
      if (!is_asked(stage, states)) continue;
      const bool whole = is_mesh_stage(stage);
      for (std::uint64_t i = 0; i < (whole ? frames : 20 * frames); ++i)
        for (const std::string generator : {"states", "mutated"}) {
          const CaseName name{stage, generator, 1, i, states.folder(), {}};
          INFO(print_problem(name));
          CHECK(problem_of(generate(name, &states)) == "");
        }
      if (whole) continue;
      JudgeOptions options;
      options.cases = 200;
      options.generator = "states";
      options.states = &states;
      const StageReport report = judge_stage(stage, fast, authority, options);
      INFO(stage_name(stage) << (report.tally.mismatches.empty() ? "" : ": " + report.tally.mismatches[0].message));
      CHECK(report.tally.mismatched == 0);
    }
  }
}
