// Compares the list of stages with the folders and with compare/README.md. Tests that stages are deterministic as the
// list declares.
#include "experiments/program/stage_list.hpp"
#include "compare/stages/bound.hpp"

#include <filesystem>
#include <map>

#include "compare/files/bytes.hpp"
#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/engine/judge.hpp"
#include "reference/contestant.hpp"
#include "tests/catch.hpp"
#include "tests/compare/judge/faults.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::compare;

namespace {

const std::filesystem::path tree = OGC_SOURCE_DIR;

std::string read(const std::string& file) { return read_bytes(tree / file); }

/// Returns whether one of these folders contains a file with this name, without its extension.
bool has_stem(std::initializer_list<const char*> folders, const std::string& stem) {
  for (const char* folder : folders)
    for (const auto& entry : std::filesystem::directory_iterator(tree / folder))
      if (entry.path().stem() == stem) return true;
  return false;
}

}  // namespace

TEST_CASE("every stage has a contract, a reference, and a CPU and a CUDA implementation or a plug-in", "[unit]") {
  const Authority authority = reference::authority();
  const Contestant host = fast::contestant(fast::Backend::cpu);
  for (const Stage stage : all_stages) {
    const StageInfo& info = stage_info(stage);
    const std::string name(info.name);
    INFO(name);
    CHECK(std::filesystem::exists(tree / "compare/stages" / (name + ".hpp")));
    CHECK(std::filesystem::exists(tree / std::string(info.reference)));
    const bool is_ours = can_judge(stage, host, authority);
    // The fast path does not implement ccd and barrier, but has an example plug-in for each.
    // tests/experiments/plugins/build_plugins.sh judges the examples.
    CHECK(is_ours != (stage == Stage::ccd || stage == Stage::barrier));
    if (!is_ours) CHECK(has_stem({"experiments/plugins/examples"}, name));
    CHECK((!is_ours || has_stem({"fast/kernels", "fast/kernels/kinds", "fast/kernels/models", "fast/stages"}, name) ||
           has_stem({"fast/kernels/models"}, name + "_models")));
    if (fast::backend_info(fast::Backend::cuda).usable)
      CHECK(can_judge(stage, fast::contestant(fast::Backend::cuda), authority) == is_ours);
  }
  // Both backends instantiate the same contestant, so CUDA has every stage that the CPU has.
  for (const char* file : {"fast/cpu/instantiate.cpp", "fast/cuda/instantiate.cu"})
    CHECK(read(file).find("= probe_contestant(\"") != std::string::npos);
}

TEST_CASE("agreement tests of CPU and CUDA go over all stages", "[unit]") {
  for (const char* file : {"tests/experiments/compare.cpp", "tests/fast/cuda/agreement.cu"}) {
    const std::string text = read(file);
    const auto from = text.find("agrees with the reference in every stage");
    REQUIRE(from != std::string::npos);
    CHECK(text.find("all_stages", from) < text.find("\n}\n", from));
  }
}

TEST_CASE("the table of stages in compare/README.md is the one that ogc compare --list --markdown prints", "[unit]") {
  const std::string readme = read("compare/README.md"), begin = "<!-- ogc compare --list --markdown -->\n",
                    end = "<!-- end of the list -->";
  const auto from = readme.find(begin);
  REQUIRE(from != std::string::npos);
  const std::string table = readme.substr(from + begin.size(), readme.find(end) - from - begin.size());
  CHECK(table == experiments::stage_list_markdown());
  const tests::ProgramResult printed = tests::run_ogc("compare --list --markdown");
  CHECK(printed.status == 0);
  CHECK(printed.out == table);
}

// Other tests check that the judge catches each wrong form and each planted fault (tests/experiments/diagnose.cpp,
// compare.cpp).
TEST_CASE("every stage can be wrong in at least three ways that the judge is shown to catch", "[unit]") {
  std::map<Stage, std::size_t> by_stage;
  for (const tests::Fault& fault : tests::faults()) ++by_stage[fault.stage];
  for (const Stage stage : all_stages) {
    INFO(stage_name(stage));
    CHECK(by_stage[stage] + tests::answering_forms(stage).size() >= 3);
  }
}

TEST_CASE("the list of stages names generators and parameters of each", "[unit]") {
  const std::string list = experiments::stage_list_text();
  REQUIRE(tests::contains(
      list, {"detect_edge_edge", "ladder.strands", "parameters: r, r_q", "parameters: none", "cpu_to_gpu"}));
}

TEST_CASE("the CPU gives the same bits again, on one and two threads, shuffled and in small batches, in every stage",
          "[agreement]") {
  for (const DeterminismReport& report : experiments::determinism_of(fast::Backend::cpu, all_stages, 1000, 5)) {
    INFO(stage_name(report.stage) << (report.changed.empty() ? "" : ": " + report.changed[0]));
    CHECK(report.skipped == (report.stage == Stage::ccd || report.stage == Stage::barrier));
    CHECK((report.skipped || report.cases > 0));
    CHECK(report.changed.empty());
  }
}

TEST_CASE("answers that depend on their company, or change from call to call, are noticed", "[agreement]") {
  const Authority authority = reference::authority();
  Contestant odd = tests::exact_contestant(authority);
  odd.truncate = [right = odd.truncate](const TruncateIn& in) {
    TruncateOut out = right(in);
    out.position[0].x = in.position.size() > 50 ? out.position[0].x : -out.position[0].x;
    return out;
  };
  int call = 0;
  odd.bound = [right = odd.bound, &call](const BoundIn& in) {
    BoundOut out = right(in);
    if (++call % 7 == 0 && !out.bound.empty()) out.bound[0] = -out.bound[0];
    return out;
  };
  odd.detect_vertex_facet = [right = odd.detect_vertex_facet](const DetectIn& in) {
    DetectVertexFacetOut out = right(in);
    if (!out.contacts.empty() && out.contacts[0].vertex < 3) out.contacts.erase(out.contacts.begin());
    return out;
  };
  odd.detect_edge_edge = [right = odd.detect_edge_edge](const DetectIn& in) {
    DetectEdgeEdgeOut out = right(in);
    std::erase_if(out.contacts, [](const EdgeEdgeContact& c) { return c.first_edge == 0; });
    return out;
  };
  for (const Stage stage : {Stage::detect_vertex_facet, Stage::detect_edge_edge}) {
    const auto by_number = check_determinism(stage, 100, 1, odd, authority, {});
    REQUIRE(by_number.changed.size() == 1);
    CHECK(by_number.changed[0].starts_with("renumbered: "));
  }
  const auto company = check_determinism(Stage::truncate, 200, 1, odd, authority, {});
  CHECK(company.changed.size() >= 3);
  CHECK(check_determinism(Stage::bound, 60, 1, odd, authority, {}).changed.size() >= 1);
}

TEST_CASE("at least half of a stage's cases lie within 1024 ulp of a decision boundary, where it has one",
          "[agreement]") {
  const Authority authority = reference::authority();
  const Contestant exact = tests::exact_contestant(authority);
  for (const Stage stage : all_stages) {
    if (!stage_info(stage).has_boundary) continue;
    JudgeOptions options;
    // With this many cases, the shares of the generators hardly depend on sizes of meshes and batches.
    options.cases = is_mesh_stage(stage) ? 30000 : 5000;
    const StageReport report = judge_stage(stage, exact, authority, options);
    INFO(stage_name(stage));
    CHECK(report.tally.near_share() >= 0.5);
  }
}

TEST_CASE(
    "of the meshes that large runs are made of half of the cases lie within 1024 ulp of a boundary too, and the "
    "reference passes",
    "[agreement]") {
  const Authority authority = reference::authority();
  const Contestant exact = tests::exact_contestant(authority);
  for (const Stage stage : {Stage::block, Stage::detect_vertex_facet, Stage::detect_edge_edge}) {
    JudgeOptions options;
    options.cases = 20000;
    options.generator = "ladder.field";
    const StageReport report = judge_stage(stage, exact, authority, options);
    INFO(stage_name(stage));
    CHECK(report.passed());
    CHECK(report.tally.questions < 40);  // each mesh has more than a thousand cases
    CHECK(report.tally.near_share() >= 0.5);
  }
}
