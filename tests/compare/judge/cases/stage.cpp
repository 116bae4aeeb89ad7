#include "compare/judge/cases/stage.hpp"

#include <set>
#include <string>

#include "compare/contestant.hpp"
#include "compare/judge/cases/stage_traits.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

TEST_CASE("the stages of a contestant are those of the judge, each once, under the same names", "[unit]") {
  std::set<std::string> names;
  visit_stages([&](const char* name, auto) { CHECK(names.insert(name).second); });
  CHECK(names.size() == stage_count);
  for (const Stage stage : all_stages) CHECK(names.contains(std::string(stage_name(stage))));
}

TEST_CASE("a stage is found by its name, which no other has", "[unit]") {
  for (const Stage stage : all_stages) {
    INFO(stage_name(stage));
    CHECK(find_stage(stage_name(stage)) == stage);
    CHECK(&traits_of(stage) == find_traits(stage));
    CHECK_FALSE(stage_info(stage).question.empty());
  }
  CHECK_FALSE(find_stage("closest_fece"));
}
