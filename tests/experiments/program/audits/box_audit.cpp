#include "experiments/program/audits/box_audit.hpp"

#include <nlohmann/json.hpp>

#include "compare/contestant.hpp"
#include "compare/judge/cases/random.hpp"
#include "fast/contestant.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::experiments;
using namespace ogc::tests;

namespace {

constexpr float radius = 0.12F;

/// Four sheets of n × n vertices with spacing 0.1, 0.08 apart, shifted and uneven, so that all kinds of contacts occur
/// and few decisions are grey. The first two lines of the uppermost one are `pushed` down.
struct Stack {
  compare::Topology topology;
  std::vector<compare::Vec3f> positions;

  explicit Stack(compare::Index n, float pushed = 0) {
    compare::Random random("box_audit", "stack", 0, 0);
    const auto off = [&random] { return static_cast<float>(random.between(-0.004, 0.004)); };
    std::vector<compare::Triangle> triangles;
    for (compare::Index k = 0; k < 4; ++k) {
      const compare::Index first = static_cast<compare::Index>(positions.size());
      for (compare::Index i = 0; i < n; ++i)
        for (compare::Index j = 0; j < n; ++j)
          positions.push_back({0.1F * static_cast<float>(i) + 0.037F * static_cast<float>(k) + off(),
                               0.08F * static_cast<float>(k) - (k == 3 && i < 2 ? pushed : 0.0F) + off(),
                               0.1F * static_cast<float>(j) + 0.021F * static_cast<float>(k) + off()});
      for (compare::Index i = 0; i + 1 < n; ++i)
        for (compare::Index j = 0; j + 1 < n; ++j) {
          const compare::Index a = first + i * n + j, b = a + 1, c = a + n, d = c + 1;
          triangles.push_back({a, b, d});
          triangles.push_back({a, d, c});
        }
    }
    topology = compare::build_topology(static_cast<compare::Index>(positions.size()), triangles);
  }

  FoundContacts found() const {
    const compare::DetectIn in{&topology, {}, positions, radius, radius};
    const compare::Contestant cpu = fast::contestant(fast::Backend::cpu);
    return {cpu.detect_vertex_facet(in).contacts, cpu.detect_edge_edge(in).contacts};
  }

  BoxFindings audit(const FoundContacts& contacts, const BoxRequest& request) const {
    return audit_boxes(topology, positions, {}, contacts, radius, request);
  }
};

}  // namespace

TEST_CASE("boxes over all cells compare each contact, find none wrong, and name one that is missing or too many",
          "[unit]") {
  const Stack stack(12);
  const FoundContacts all = stack.found();
  const std::size_t count = all.vertex_facet.size() + all.edge_edge.size();
  REQUIRE(count > 2000);
  const BoxFindings clean = stack.audit(all, {.count = 1000, .side = 0.3});
  CHECK(clean.boxes == clean.cells);
  CHECK(clean.densest == clean.boxes / 2);
  CHECK(clean.contacts >= count);  // boxes overlap
  CHECK(clean.pairs_tested > 0);
  CHECK(clean.intersections + clean.missing + clean.extra == 0);
  CHECK(clean.first.empty());

  FoundContacts less = all;
  less.edge_edge.erase(less.edge_edge.begin() + 100);
  const BoxFindings missing = stack.audit(less, {.count = 1000, .side = 0.3});
  CHECK(missing.missing > 0);
  CHECK(missing.extra == 0);
  CHECK(contains(missing.first, {"missing edge–edge contact of vertices"}));

  FoundContacts more = all;
  more.vertex_facet.push_back(more.vertex_facet.back());
  CHECK(stack.audit(more, {.count = 1000, .side = 0.3}).extra > 0);
  more.vertex_facet.back().face = {compare::FaceKind::vertex, 0};
  more.vertex_facet.back().vertex = 1;
  CHECK(contains(stack.audit(more, {.count = 1000, .side = 0.3}).first, {"extra vertex–facet contact"}));
}

TEST_CASE("boxes: half are the cells with most contacts, the seed draws the others, and an intersection is found",
          "[unit]") {
  const Stack stack(12), pushed(12, 0.1F);
  const FoundContacts all = stack.found();
  const BoxFindings few = stack.audit(all, {.count = 6, .seed = 1, .side = 0.3}),
                    again = stack.audit(all, {.count = 6, .seed = 1, .side = 0.3}),
                    others = stack.audit(all, {.count = 6, .seed = 2, .side = 0.3});
  CHECK(few.boxes == 6);
  CHECK(few.densest == 3);
  CHECK(few.most_contacts >= few.least_of_densest);
  CHECK(few.most_contacts > all.edge_edge.size() / few.cells);
  CHECK(again.contacts == few.contacts);
  CHECK(others.contacts != few.contacts);
  const BoxFindings met = pushed.audit(pushed.found(), {.count = 1000, .side = 0.3});
  CHECK(met.intersections > 0);
  CHECK(contains(met.first, {" meets "}));
}

TEST_CASE("ogc audit --boxes audits the last state of a run, prints counts and seed, and takes no mesh", "[unit]") {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string();
  REQUIRE(run_ogc("run cloth_on_sphere --scale smoke --audit off --out " + run).status == 0);
  const ProgramResult text = run_ogc("audit " + run + " --boxes 4 --seed 9"),
                      json = run_ogc("audit " + run + " --boxes 4 --seed 9 --json");
  CHECK(text.status == 0);
  CHECK(contains(text.out, {"step 30 audited in 4 boxes", "the 2 with most contacts", "seed 9", "0 intersections",
                            "0 missing contacts"}));
  const nlohmann::json found = nlohmann::json::parse(json.out);
  CHECK(found.at("boxes") == 4);
  CHECK(found.at("densest_boxes") == 2);
  CHECK(found.at("seed") == 9);
  CHECK(found.at("pairs_tested") > 0);
  CHECK(found.at("contacts") > 0);
  const ProgramResult mesh = run_ogc("audit " + folder.write("parallel.obj", parallel_triangles_obj).string() +
                                     " --boxes 4");
  CHECK(mesh.status == 2);
  CHECK(contains(mesh.err, {"--boxes", "run folder"}));
}
