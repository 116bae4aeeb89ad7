#include "compare/judge/cases/cases.hpp"

#include <algorithm>

#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/parameters.hpp"
#include "compare/problem/error.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

TEST_CASE("a problem string is printed canonically and read back", "[unit]") {
  const CaseName name{Stage::closest_face, "ladder.needle", 7, 1234, "", {}};
  REQUIRE(print_problem(name) == "stage=closest_face gen=ladder.needle seed=7 index=1234");
  REQUIRE(parse_problem(print_problem(name)) == name);
  REQUIRE(parse_problem(" index=1234  seed=7 gen=ladder.needle stage=closest_face") == name);
}

TEST_CASE("the run folder of a problem string may hold spaces", "[unit]") {
  const CaseName name{Stage::detect_edge_edge, "states", 1, 3, "runs/my twist=2", {{"r", 0.002f}}};
  REQUIRE(parse_problem(print_problem(name)) == name);
}

TEST_CASE("parameters of a problem string are printed in the stage's order, in the shortest text, and read back",
          "[unit]") {
  const CaseName name = parse_problem("gen=few r_q=4e-3 index=12 r=2e-3 seed=7 stage=detect_edge_edge");
  REQUIRE(print_problem(name) == "stage=detect_edge_edge gen=few seed=7 index=12 r=0.002 r_q=0.004");
  REQUIRE(parse_problem(print_problem(name)) == name);
}

TEST_CASE("every parameter of every stage takes the ends of its range and comes back from the printed line to the bit",
          "[property]") {
  for (const Stage stage : all_stages)
    for (const ParameterInfo& info : parameters(stage))
      for (const float value :
           {info.minimum, info.maximum, std::min(info.maximum, std::max(info.minimum, 0x1.23456p-3f))}) {
        const CaseName name{stage, std::string(generators(stage)[0].name), 3, 5, "", {{std::string(info.name), value}}};
        INFO(print_problem(name));
        REQUIRE(parse_problem(print_problem(name)) == name);
      }
}

TEST_CASE("a parameter is put into the case after it is made, and nothing else changes", "[unit]") {
  const TestCase plain = generate(parse_problem("stage=friction_force gen=uniform seed=2 index=9"));
  const TestCase changed = generate(
      parse_problem("stage=friction_force gen=uniform seed=2 index=9 r=0.5 k_c=7 mu=0.25"));
  FrictionForceCase expected = case_of<FrictionForceCase>(plain.data);
  expected.contact.contact_radius = 0.5f;
  expected.contact.stiffness = 7;
  expected.friction = 0.25f;
  const FrictionForceCase& got = case_of<FrictionForceCase>(changed.data);
  REQUIRE(got.contact.vertex == expected.contact.vertex);
  REQUIRE(got.start == expected.start);
  REQUIRE(got.contact.contact_radius == expected.contact.contact_radius);
  REQUIRE(got.contact.stiffness == expected.contact.stiffness);
  REQUIRE(got.friction == expected.friction);
  REQUIRE(got.slip_limit == expected.slip_limit);
  const TestCase step = generate(
      parse_problem("stage=step gen=" + std::string(generators(Stage::step)[0].name) + " seed=2 index=0 mu=0.75"));
  REQUIRE(case_of<StepCase>(step.data).scene->bodies.at(0).material.friction == 0.75);
}

TEST_CASE("parameters that a stage lacks, out of range, twice, or that leave no legal question are refused", "[unit]") {
  REQUIRE_THROWS_WITH(parse_problem("stage=block gen=few r=1"),
                      ContainsSubstring("no parameter 'r'") && ContainsSubstring("none"));
  REQUIRE_THROWS_WITH(parse_problem("stage=bound gen=few gamma=0.4"), ContainsSubstring("gamma_p"));
  REQUIRE_THROWS_WITH(parse_problem("stage=bound gen=few gamma_p=0.5"), ContainsSubstring("Eq. 21"));
  REQUIRE_THROWS_WITH(parse_problem("stage=truncate gen=bits b=1 b=2"), ContainsSubstring("twice"));
  REQUIRE_THROWS_WITH(parse_problem("stage=truncate gen=bits b=1x"), ContainsSubstring("b=1x"));
  REQUIRE_THROWS_WITH(parse_problem("stage=truncate gen=bits b"), ContainsSubstring("no key=value"));
  REQUIRE_THROWS_WITH(generate(parse_problem("stage=detect_edge_edge gen=soup seed=1 index=1 r=1000 r_q=1")),
                      ContainsSubstring("r_q"));
}

TEST_CASE("a wrong problem string is refused by name", "[unit]") {
  REQUIRE_THROWS_WITH(parse_problem("stage=closest_fece gen=uniform"),
                      ContainsSubstring("closest_fece") && ContainsSubstring("closest_face"));
  REQUIRE_THROWS_WITH(parse_problem("stage=bound gen=few colour=red"), ContainsSubstring("colour"));
  REQUIRE_THROWS_WITH(parse_problem("stage=bound gen=few seed=-1"), ContainsSubstring("seed=-1"));
  REQUIRE_THROWS_WITH(parse_problem("stage=bound gen=few index=1x"), ContainsSubstring("index=1x"));
  REQUIRE_THROWS_AS(parse_problem("gen=uniform"), InputError);
  REQUIRE_THROWS_AS(parse_problem("stage=bound"), InputError);
  REQUIRE_THROWS_AS(parse_problem(""), InputError);
}
