#include "compare/judge/cases.hpp"

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

TEST_CASE("a problem string is printed canonically and read back", "[unit]") {
  const CaseName name{Stage::closest_face, "ladder.needle", 7, 1234, ""};
  REQUIRE(print_problem(name) == "stage=closest_face gen=ladder.needle seed=7 index=1234");
  REQUIRE(parse_problem(print_problem(name)) == name);
  REQUIRE(parse_problem(" index=1234  seed=7 gen=ladder.needle stage=closest_face") == name);
}

TEST_CASE("the run folder of a problem string may hold spaces", "[unit]") {
  const CaseName name{Stage::detect_edge_edge, "states", 1, 3, "runs/my twist=2"};
  REQUIRE(parse_problem(print_problem(name)) == name);
}

TEST_CASE("a wrong problem string is refused by name", "[unit]") {
  using Catch::Matchers::Contains;
  REQUIRE_THROWS_WITH(parse_problem("stage=closest_fece gen=uniform"), Contains("closest_fece") && Contains("closest_face"));
  REQUIRE_THROWS_WITH(parse_problem("stage=bound gen=few colour=red"), Contains("colour"));
  REQUIRE_THROWS_WITH(parse_problem("stage=bound gen=few seed=-1"), Contains("seed=-1"));
  REQUIRE_THROWS_WITH(parse_problem("stage=bound gen=few index=1x"), Contains("index=1x"));
  REQUIRE_THROWS_AS(parse_problem("gen=uniform"), InputError);
  REQUIRE_THROWS_AS(parse_problem("stage=bound"), InputError);
  REQUIRE_THROWS_AS(parse_problem(""), InputError);
}
