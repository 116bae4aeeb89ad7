#include "compare/judge/mutate.hpp"

#include <algorithm>
#include <cmath>

#include "compare/judge/generators.hpp"
#include "compare/judge/legal.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

TEST_CASE("mutated points stay legal, and most mutations change something", "[property]") {
  int changed = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    CaseData data = generate({Stage::detect_vertex_facet, "cloth", 3, i % 7, "", {}}).data;
    const std::vector<Vec3f> before = std::get<MeshCase>(data).positions;
    Random random("detect_vertex_facet", "mutated", 1, i);
    mutate(random, data);
    const std::vector<Vec3f>& after = std::get<MeshCase>(data).positions;
    changed += !(before == after);
    REQUIRE(after.size() == before.size());
    REQUIRE(problem_of(data).empty());
  }
  REQUIRE(changed > 350);
}

TEST_CASE("no points are not touched", "[unit]") {
  Random random("none", "none", 1, 1);
  mutate_points(random, {});
}
