#include "compare/judge/cases/generators.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/judge/cases/legal.hpp"
#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/report/corpus.hpp"
#include "compare/judge/report/inputs.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/material_table.hpp"
#include "compare/problem/names.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

double area_squared(const std::array<Vec3f, 3>& t) {
  const double ux = double{t[1].x} - t[0].x, uy = double{t[1].y} - t[0].y, uz = double{t[1].z} - t[0].z;
  const double vx = double{t[2].x} - t[0].x, vy = double{t[2].y} - t[0].y, vz = double{t[2].z} - t[0].z;
  return std::pow(uy * vz - uz * vy, 2) + std::pow(uz * vx - ux * vz, 2) + std::pow(ux * vy - uy * vx, 2);
}

/// Returns the number of vertices of a mesh stage's case, read from its inputs.
Index vertex_count(const TestCase& test) {
  for (const Quantity& quantity : inputs_of(test))
    if (quantity.name == "vertices") return static_cast<Index>(quantity.numbers.at(0));
  return -1;
}

/// Returns whether any of the stage's first 20 cases has coordinates that the judge may make tiny (dust.hpp).
bool has_coordinates(Stage stage) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    TestCase test = generate({stage, std::string(generators(stage)[0].name), 1, i, "", {}});
    if (!traits_of(stage).coordinates(test.data).empty()) return true;
  }
  return false;
}

/// Collects the models in the cases of a stage, one set for each enumeration.
struct ModelsSeen {
  std::set<std::size_t> membrane, bending, activation, damping;
  void add(const Scene& scene) {
    activation.insert(static_cast<std::size_t>(scene.settings.contact_activation));
    damping.insert(static_cast<std::size_t>(scene.settings.damping));
    for (const Body& body : scene.bodies) {
      membrane.insert(static_cast<std::size_t>(body.material.membrane));
      bending.insert(static_cast<std::size_t>(body.material.bending));
    }
  }
};

}  // namespace

TEST_CASE("every case of every generator is a legal question", "[property]") {
  for (const Stage stage : all_stages)
    for (const Generator& generator : generators(stage))
      for (std::uint64_t i = 0; i < (generator.least > 0 ? 2u : is_mesh_stage(stage) ? 60u : 400u); ++i) {
        const CaseName name{stage, std::string(generator.name), 3, i, "", {}};
        INFO(print_problem(name));
        REQUIRE(problem_of(generate(name)) == "");
      }
}

TEST_CASE("what no contract allows is told by its number", "[unit]") {
  TestCase far = generate({Stage::closest_face, "uniform", 1, 1, "", {}});
  case_of<ClosestFaceCase>(far.data).point.y = 0x1p31f;
  CHECK(problem_of(far) == "a coordinate of 2.14748365e+09 is out of range");
  case_of<ClosestFaceCase>(far.data).point.y = std::nanf("");
  CHECK(problem_of(far) == "a coordinate of nan is out of range");
  case_of<ClosestFaceCase>(far.data).point.y = 0x1p-149f;
  CHECK(problem_of(far).empty());
  TestCase spring = generate({Stage::spring, "uniform", 1, 1, "", {}});
  case_of<SpringCase>(spring.data).own = 2;
  CHECK(problem_of(spring) == "no such vertex is asked about");
}

TEST_CASE("dust has coordinates down to 10^-17 and below, in every stage that has coordinates of its own but friction",
          "[property]") {
  for (const Stage stage : all_stages) {
    const auto rows = generators(stage);
    const bool has = std::any_of(rows.begin(), rows.end(), [](const Generator& row) { return row.name == "dust"; });
    INFO(stage_name(stage));
    CHECK(has == (has_coordinates(stage) && stage != Stage::friction_force));
  }
  float smallest = 1;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const auto c = case_of<ClosestFaceCase>(generate({Stage::closest_face, "dust", 1, i, "", {}}).data);
    for (const float x : {c.point.x, c.point.y, c.point.z})
      if (x != 0) smallest = std::min(smallest, std::abs(x));
  }
  CHECK(smallest < 0x1p-55f);
}

TEST_CASE("a case depends on its name alone, whatever is made before it, in any order", "[property]") {
  for (const Stage stage : all_stages)
    for (const Generator& generator : generators(stage)) {
      if (generator.least > 0) continue;
      std::vector<std::string> forwards, backwards;
      const auto text = [&](std::uint64_t i) {
        return case_to_json(generate({stage, std::string(generator.name), 11, i, "", {}}), "").dump();
      };
      for (std::uint64_t i = 0; i < 6; ++i) forwards.push_back(text(i));
      generate({stage, std::string(generator.name), 12, 6, "", {}});
      for (std::uint64_t i = 6; i-- > 0;) backwards.insert(backwards.begin(), text(i));
      INFO(stage_name(stage) << " " << generator.name);
      REQUIRE(forwards == backwards);
    }
}

TEST_CASE("seed, index, stage and generator each give other numbers", "[property]") {
  std::set<std::uint64_t> seen;
  int count = 0;
  for (const char* stage : {"closest_face", "bound"})
    for (const char* generator : {"uniform", "bits"})
      for (std::uint64_t seed = 0; seed < 10; ++seed)
        for (std::uint64_t index = 0; index < 100; ++index, ++count)
          seen.insert(Random(stage, generator, seed, index).bits());
  REQUIRE(seen.size() == static_cast<std::size_t>(count));
}

// Fails if a model is added to an enumeration and its names, but no case has it.
TEST_CASE("each model that has a name is among the cases of the stages that read it", "[property]") {
  const auto all = [](std::span<const std::string_view> names) {
    std::set<std::size_t> numbers;
    for (std::size_t i = 0; i < names.size(); ++i) numbers.insert(i);
    return numbers;
  };
  const auto without_none = [&](std::span<const std::string_view> names) {
    std::set<std::size_t> numbers = all(names);
    numbers.erase(static_cast<std::size_t>(std::ranges::find(names, "none") - names.begin()));
    return numbers;
  };
  for (const Stage stage : {Stage::membrane, Stage::bending, Stage::activation, Stage::contact_force,
                            Stage::friction_force, Stage::sweep, Stage::step}) {
    ModelsSeen seen;
    for (const Generator& generator : generators(stage))
      for (std::uint64_t i = 0; i < (is_mesh_stage(stage) ? 20u : 100u); ++i) {
        const TestCase test = generate({stage, std::string(generator.name), 1, i, "", {}});
        if (stage == Stage::sweep) seen.add(*case_of<SweepCase>(test.data).scene);
        if (stage == Stage::step) seen.add(*case_of<StepCase>(test.data).scene);
        if (stage == Stage::membrane) {
          const auto& c = case_of<MembraneCase>(test.data);
          seen.membrane.insert(static_cast<std::size_t>(c.model));
          seen.damping.insert(static_cast<std::size_t>(c.damping_form));
        }
        if (stage == Stage::bending)
          seen.bending.insert(static_cast<std::size_t>(case_of<BendingCase>(test.data).model));
        if (stage == Stage::activation)
          seen.activation.insert(static_cast<std::size_t>(case_of<ActivationCase>(test.data).activation));
        if (stage == Stage::contact_force)
          seen.activation.insert(static_cast<std::size_t>(case_of<ContactForceCase>(test.data).activation));
        if (stage == Stage::friction_force)
          seen.activation.insert(static_cast<std::size_t>(case_of<FrictionForceCase>(test.data).contact.activation));
      }
    INFO(stage_name(stage));
    const bool has_scene = stage == Stage::sweep || stage == Stage::step;
    const auto wanted = [&](std::span<const std::string_view> names) {
      // bodies of a step have membrane and bending energy
      return stage == Stage::sweep ? all(names) : without_none(names);
    };
    if (has_scene || stage == Stage::membrane) CHECK(seen.membrane == wanted(choice_names<MembraneModel>));
    if (has_scene || stage == Stage::bending) CHECK(seen.bending == wanted(choice_names<BendingModel>));
    if (has_scene || stage == Stage::membrane) CHECK(seen.damping == all(choice_names<DampingForm>));
    if (stage != Stage::membrane && stage != Stage::bending)
      CHECK(seen.activation == all(choice_names<ContactActivation>));
  }
}

TEST_CASE("at least half of a stage's cases lie close to a decision boundary", "[unit]") {
  for (const Stage stage : all_stages) {
    if (stage == Stage::bound) continue;  // a minimum has no decision boundary
    double near = 0, all = 0;
    for (const Generator& generator : generators(stage)) {
      all += generator.share;
      if (generator.name == "lattice" || generator.name.starts_with("ladder.")) near += generator.share;
    }
    INFO(stage_name(stage));
    REQUIRE(near >= all / 2);
  }
}

TEST_CASE("each degeneracy has the ladders that compare/judge/README.md names", "[unit]") {
  const std::string readme = read_bytes(OGC_SOURCE_DIR "/compare/judge/README.md");
  const auto table = readme.substr(readme.find("<!-- ladders -->"),
                                   readme.find("<!-- end of the ladders -->") - readme.find("<!-- ladders -->"));
  REQUIRE(std::count(table.begin(), table.end(), '\n') > 10);
  // In the table, the names of a stage's ladders follow the name of the stage.
  std::optional<Stage> stage;
  int named = 0;
  for (std::size_t begin = table.find('`'); begin != std::string::npos;) {
    const std::size_t end = table.find('`', begin + 1);
    const std::string word = table.substr(begin + 1, end - begin - 1);
    INFO(word);
    if (find_stage(word))
      stage = find_stage(word);
    else if (word.starts_with("ladder.") || word == "lattice") {
      REQUIRE(stage);
      CHECK_NOTHROW(find_generator(*stage, word));
      ++named;
    }
    begin = table.find('`', end + 1);
  }
  CHECK(named > 30);
}

TEST_CASE("the zero-area ladder gives triangles without area, exactly", "[property]") {
  for (std::uint64_t i = 0; i < 500; ++i)
    REQUIRE(
        area_squared(case_of<ClosestFaceCase>(generate({Stage::closest_face, "ladder.zero_area", 1, i, "", {}}).data)
                         .triangle) == 0);
}

TEST_CASE(
    "meshes of 0, 1, 2, 3, 5, 10 and 50 vertices are among the cases, scenes from 3 on, and of detection some thousand",
    "[property]") {
  for (const Stage stage : all_stages) {
    if (!is_mesh_stage(stage)) continue;
    std::set<Index> sizes;
    for (const Generator& generator : generators(stage))
      for (std::uint64_t i = 0; i < (generator.least > 0 ? 1u : 200u); ++i)
        sizes.insert(vertex_count(generate({stage, std::string(generator.name), 1, i, "", {}})));
    // Scenes have at least one triangle.
    const bool is_scene = stage == Stage::rest_state || stage == Stage::sweep || stage == Stage::step;
    const bool detects = stage == Stage::detect_vertex_facet || stage == Stage::detect_edge_edge;
    INFO(stage_name(stage));
    for (const Index size : {0, 1, 2, 3, 5, 10, 50}) {
      INFO(size << " vertices");
      if (!is_scene || size >= 3) CHECK(sizes.contains(size));
    }
    if (detects) CHECK(*sizes.rbegin() > 1000);
  }
}

TEST_CASE("an unknown generator is refused with the known names", "[unit]") {
  REQUIRE_THROWS_WITH(generate({Stage::truncate, "unifrom", 1, 1, "", {}}),
                      ContainsSubstring("unifrom") && ContainsSubstring("uniform"));
  REQUIRE_THROWS_WITH(generate({Stage::truncate, "states", 1, 1, "", {}}), ContainsSubstring("states=RUN"));
}

TEST_CASE("fine random numbers climb the lower rungs only", "[property]") {
  Random random("closest_face", "test", 1, 1);
  random.be_fine();
  for (int i = 0; i < 1000; ++i) REQUIRE(std::abs(random.rung()) <= 1.1e-5);
}
