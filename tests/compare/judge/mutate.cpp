#include "compare/judge/mutate.hpp"

#include <algorithm>
#include <cmath>

#include "compare/judge/generators.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

TEST_CASE("mutated points stay finite and 0 or at least 2^-20, and most mutations change something", "[property]") {
  int changed = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    CaseData data = generate({Stage::detect_vertex_facet, "cloth", 3, i % 7, "", {}}).data;
    const std::vector<Vec3f> before = std::get<MeshCase>(data).positions;
    Random random("detect_vertex_facet", "mutated", 1, i);
    mutate(random, data);
    const std::vector<Vec3f>& after = std::get<MeshCase>(data).positions;
    changed += !(before == after);
    REQUIRE(after.size() == before.size());
    for (std::size_t v = 0; v < after.size(); ++v)
      for (const float x : {after[v].x, after[v].y, after[v].z}) REQUIRE((std::isfinite(x) && (x == 0 || std::abs(x) >= 0x1p-20f || before[v] == after[v])));
  }
  REQUIRE(changed > 350);
}

TEST_CASE("every stage that can be mutated has points, and no points are not touched", "[unit]") {
  for (const Stage stage : all_stages) {
    bool changed = false;
    for (std::uint64_t i = 0; i < 20 && !changed; ++i) {
      TestCase test = generate({stage, std::string(generators(stage)[0].name), 1, i, "", {}});
      const TestCase before = test;
      Random random(stage_name(stage), "mutated", 1, i);
      mutate(random, test.data);
      std::visit(
          [&](const auto& c) {
            using Case = std::decay_t<decltype(c)>;
            if constexpr (std::is_same_v<Case, ClosestFaceCase>) changed = !(c.triangle == std::get<Case>(before.data).triangle);
            else if constexpr (requires { c.positions; }) changed = !(c.positions == std::get<Case>(before.data).positions);
            else if constexpr (requires { c.contact.vertex; }) changed = !(c.contact.vertex == std::get<Case>(before.data).contact.vertex);
            else if constexpr (requires { c.detected; }) changed = !(c.vertex == std::get<Case>(before.data).vertex);
            else if constexpr (requires { c.second; }) changed = !(c.second == std::get<Case>(before.data).second);
            else if constexpr (requires { c.previous.x; }) changed = !(c.previous == std::get<Case>(before.data).previous);
          },
          test.data);
    }
    INFO(stage_name(stage));
    REQUIRE(changed == can_mutate(stage));
  }
  Random random("none", "none", 1, 1);
  mutate_points(random, {});
}
