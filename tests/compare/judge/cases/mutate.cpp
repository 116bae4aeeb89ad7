#include "compare/judge/cases/mutate.hpp"

#include <algorithm>
#include <cmath>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/legal.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

TEST_CASE("mutated points stay legal, and most mutations change something", "[property]") {
  int changed = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    TestCase test = generate({Stage::detect_vertex_facet, "cloth", 3, i % 7, "", {}});
    const std::vector<Vec3f> before = case_of<MeshCase>(test.data).positions;
    Random random("detect_vertex_facet", "mutated", 1, i);
    mutate(random, test);
    const std::vector<Vec3f>& after = case_of<MeshCase>(test.data).positions;
    changed += !(before == after);
    REQUIRE(after.size() == before.size());
    REQUIRE(problem_of(test).empty());
  }
  REQUIRE(changed > 350);
}

TEST_CASE("no points are not touched", "[unit]") {
  Random random("none", "none", 1, 1);
  mutate_points(random, {});
}
