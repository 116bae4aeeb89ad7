#include "compare/judge/generators.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "compare/judge/corpus.hpp"
#include "compare/judge/rest_cases.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/validate.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

bool finite(const Vec3f& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

struct IsLegal {
  bool operator()(const ClosestFaceCase& c) const { return finite(c.point) && finite(c.triangle[0]) && finite(c.triangle[1]) && finite(c.triangle[2]); }
  bool operator()(const ClosestPointsCase& c) const { return finite(c.first[0]) && finite(c.first[1]) && finite(c.second[0]) && finite(c.second[1]); }
  bool operator()(const MeshCase& c) const {
    const auto n = static_cast<std::size_t>(c.topology->vertex_count);
    return c.positions.size() == n && c.rigid_groups.size() == n && c.contact_radius > 0 && c.query_radius >= c.contact_radius &&
           std::all_of(c.positions.begin(), c.positions.end(), finite);
  }
  bool operator()(const BoundCase& c) const {
    return c.d_min_edge.size() == c.topology->edges.size() && c.d_min_triangle.size() == c.topology->triangles.size() &&
           c.d_min_vertex.size() == static_cast<std::size_t>(c.topology->vertex_count) && c.bound_relaxation > 0 && c.bound_relaxation <= 0.5f;
  }
  bool operator()(const ActivationCase& c) const { return c.distance > 0 && c.contact_radius > 0 && c.stiffness > 0 && std::isfinite(c.distance); }
  template <class Points>
  static bool all_finite(const Points& points) {
    return std::all_of(points.begin(), points.end(), finite);
  }
  bool operator()(const MembraneCase& c) const {
    return all_finite(c.corner) && all_finite(c.start) && c.area > 0 && c.lame_lambda >= 0 && c.lame_mu > 0 && c.damping >= 0;
  }
  bool operator()(const BendingCase& c) const { return all_finite(c.vertex) && all_finite(c.start) && c.stiffness > 0 && c.damping >= 0 && c.own >= 0 && c.own < 4; }
  bool operator()(const SpringCase& c) const {
    return all_finite(c.vertex) && all_finite(c.start) && c.stiffness > 0 && c.rest_length >= 0 && c.damping >= 0 && c.ratio >= 0 && c.ratio <= 1 &&
           c.own >= 0 && c.own <= (c.ratio > 0 ? 2 : 1);
  }
  bool operator()(const SweepCase& c) const {
    const Topology topology = build_topology(*c.scene);
    const std::vector<Index> groups = rigid_groups(*c.scene);
    const auto coloured = [&](Index a, Index b) { return c.colour[a] < 0 || c.colour[a] != c.colour[b]; };
    bool legal = validate(*c.scene).empty() && c.query_radius >= static_cast<float>(c.scene->settings.contact_radius);
    for (std::size_t v = 0; v < groups.size(); ++v) legal = legal && (c.colour[v] >= 0) == (groups[v] < 0) && c.largest_bound[v] >= 0;
    for (const Edge& e : topology.edges) legal = legal && coloured(e[0], e[1]);
    for (const Hinge& hinge : topology.hinges) legal = legal && coloured(hinge.opposite[0], hinge.opposite[1]);
    for (const Spring& spring : c.scene->springs) {
      legal = legal && coloured(spring.first, spring.second);
      if (spring.third >= 0) legal = legal && coloured(spring.first, spring.third) && coloured(spring.second, spring.third);
    }
    return legal && all_finite(c.old) && all_finite(c.start) && all_finite(c.target) && all_finite(c.previous);
  }
  bool operator()(const StepCase& c) const {
    Scene rounded = *c.scene;
    round_to_single(rounded);
    return validate(*c.scene).empty() && rounded == *c.scene && c.topology->triangles == c.scene->mesh.triangles;
  }
  bool operator()(const ContactForceCase& c) const {
    return all_finite(c.vertex) && all_finite(c.detected) && c.own >= 0 && c.own < vertex_count(c.sides) && c.contact_radius > 0 && c.stiffness > 0 &&
           c.rest_squared[0] >= 0 && c.rest_squared[1] >= 0;
  }
  bool operator()(const FrictionForceCase& c) const { return (*this)(c.contact) && all_finite(c.start) && c.friction >= 0 && c.slip_limit > 0; }
  bool operator()(const RestStateCase& c) const { return problems_of(c).empty(); }
  static bool has_vertex(const BlockCase& c, const BlockQuestion& question, Index v) {
    const auto has = [v](const auto& vertices) { return std::find(vertices.begin(), vertices.end(), v) != vertices.end(); };
    const auto i = static_cast<std::size_t>(question.face.index);
    if (question.face.kind == FaceKind::vertex) return question.face.index == v;
    return question.face.kind == FaceKind::edge ? has(c.topology->edges[i]) : has(c.topology->triangles[i]);
  }
  bool operator()(const BlockCase& c) const {
    return all_finite(c.positions) && std::all_of(c.questions.begin(), c.questions.end(), [&](const BlockQuestion& question) {
             if (question.kind == BlockQuestion::Kind::vertex_in_surface) return !has_vertex(c, question, question.of);
             const Edge& e = c.topology->edges[static_cast<std::size_t>(question.of)];
             return question.face.kind != FaceKind::triangle && !has_vertex(c, question, e[0]) && !has_vertex(c, question, e[1]);
           });
  }
  static bool within(const Vec3f& p, float least, float most) {
    const auto inside = [&](float x) { return x == 0 || (std::abs(x) >= least && std::abs(x) <= most); };
    return inside(p.x) && inside(p.y) && inside(p.z);
  }
  bool operator()(const InitialGuessCase& c) const {
    constexpr float least = 0x1p-100f, most = 0x1p20f;
    return within(c.start, least, most) && within(c.velocity, least, most) && within(c.acceleration, least, most) && within(c.previous, least, most) &&
           c.time_step >= 0x1p-20f && c.time_step <= 1 && (c.bound == 0 || (c.bound >= least && c.bound <= 0x1p40f)) && c.held <= 1;
  }
  bool operator()(const TruncateCase& c) const { return finite(c.previous) && finite(c.position) && c.bound >= 0; }
};

double area_squared(const std::array<Vec3f, 3>& t) {
  const double ux = double{t[1].x} - t[0].x, uy = double{t[1].y} - t[0].y, uz = double{t[1].z} - t[0].z;
  const double vx = double{t[2].x} - t[0].x, vy = double{t[2].y} - t[0].y, vz = double{t[2].z} - t[0].z;
  return std::pow(uy * vz - uz * vy, 2) + std::pow(uz * vx - ux * vz, 2) + std::pow(ux * vy - uy * vx, 2);
}

struct VertexCount {
  Index operator()(const MeshCase& c) const { return c.topology->vertex_count; }
  Index operator()(const BoundCase& c) const { return c.topology->vertex_count; }
  Index operator()(const BlockCase& c) const { return c.topology->vertex_count; }
  Index operator()(const RestStateCase& c) const { return c.topology->vertex_count; }
  Index operator()(const StepCase& c) const { return c.topology->vertex_count; }
  Index operator()(const SweepCase& c) const { return static_cast<Index>(c.old.size()); }
  template <class Case>
  Index operator()(const Case&) const {
    return 1;
  }
};

}  // namespace

TEST_CASE("every case of every generator is a legal question", "[property]") {
  for (const Stage stage : all_stages)
    for (const Generator& generator : generators(stage))
      for (std::uint64_t i = 0; i < (generator.least > 0 ? 2u : is_mesh_stage(stage) ? 60u : 400u); ++i) {
        const CaseName name{stage, std::string(generator.name), 3, i, "", {}};
        INFO(print_problem(name));
        const TestCase test = generate(name);
        const auto* of_scene = std::get_if<SweepCase>(&test.data);
        INFO((of_scene != nullptr ? describe(validate(*of_scene->scene)) : ""));
        REQUIRE(std::visit(IsLegal{}, test.data));
      }
}

TEST_CASE("a case depends on its name alone, whatever is made before it, in any order", "[property]") {
  for (const Stage stage : all_stages)
    for (const Generator& generator : generators(stage)) {
      if (generator.least > 0) continue;
      std::vector<std::string> forwards, backwards;
      const auto text = [&](std::uint64_t i) { return case_to_json(generate({stage, std::string(generator.name), 11, i, "", {}}), "").dump(); };
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
        for (std::uint64_t index = 0; index < 100; ++index, ++count) seen.insert(Random(stage, generator, seed, index).bits());
  REQUIRE(seen.size() == static_cast<std::size_t>(count));
}

TEST_CASE("at least half of a stage's cases lie close to a decision boundary", "[unit]") {
  for (const Stage stage : all_stages) {
    if (stage == Stage::bound) continue;  // a minimum has no boundary
    double near = 0, all = 0;
    for (const Generator& generator : generators(stage)) {
      all += generator.share;
      if (generator.name == "lattice" || generator.name.starts_with("ladder.")) near += generator.share;
    }
    INFO(stage_name(stage));
    REQUIRE(near >= all / 2);
  }
}

TEST_CASE("each degeneracy has the ladders that compare/README.md names", "[unit]") {
  const std::string readme = read_bytes(OGC_SOURCE_DIR "/compare/README.md");
  const auto table = readme.substr(readme.find("<!-- ladders -->"), readme.find("<!-- end of the ladders -->") - readme.find("<!-- ladders -->"));
  REQUIRE(std::count(table.begin(), table.end(), '\n') > 10);
  // `stage` `ladder.x` `ladder.y`, `stage` …
  std::optional<Stage> stage;
  int named = 0;
  for (std::size_t begin = table.find('`'); begin != std::string::npos;) {
    const std::size_t end = table.find('`', begin + 1);
    const std::string word = table.substr(begin + 1, end - begin - 1);
    INFO(word);
    if (find_stage(word)) stage = find_stage(word);
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
    REQUIRE(area_squared(std::get<ClosestFaceCase>(generate({Stage::closest_face, "ladder.zero_area", 1, i, "", {}}).data).triangle) == 0);
}

TEST_CASE("meshes of 0, 1, 2, 3, 5, 10 and 50 vertices are among the cases, scenes from 3 on, and of detection some thousand", "[property]") {
  for (const Stage stage : all_stages) {
    if (!is_mesh_stage(stage)) continue;
    std::set<Index> sizes;
    for (const Generator& generator : generators(stage))
      for (std::uint64_t i = 0; i < (generator.least > 0 ? 1u : 200u); ++i)
        sizes.insert(std::visit(VertexCount{}, generate({stage, std::string(generator.name), 1, i, "", {}}).data));
    const bool is_scene = stage == Stage::rest_state || stage == Stage::sweep || stage == Stage::step;  // which validate asks for a face
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
  using Catch::Matchers::Contains;
  REQUIRE_THROWS_WITH(generate({Stage::truncate, "unifrom", 1, 1, "", {}}), Contains("unifrom") && Contains("uniform"));
  REQUIRE_THROWS_WITH(generate({Stage::truncate, "states", 1, 1, "", {}}), Contains("states=RUN"));
}

TEST_CASE("fine random numbers climb the lower rungs only", "[property]") {
  Random random("closest_face", "test", 1, 1);
  random.be_fine();
  for (int i = 0; i < 1000; ++i) REQUIRE(std::abs(random.rung()) <= 1.1e-5);
}
