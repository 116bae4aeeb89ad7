#include "compare/judge/legal.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>

#include "compare/judge/rest_cases.hpp"

namespace ogc::compare {

namespace {

/// The first problem that was met.
class FirstProblem {
 public:
  void number(const char* what, float value, float least, float most) {
    if (value >= least && value <= most) return;
    say(what, value);
  }
  void vector(const char* what, const Vec3f& v) {
    for (const float x : {v.x, v.y, v.z})
      if (!(std::abs(x) <= most_coordinate)) say(what, x);
  }
  void vectors(const char* what, std::span<const Vec3f> all) {
    for (const Vec3f& v : all) vector(what, v);
  }
  void require(bool holds, const char* otherwise) {
    if (!holds && text_.empty()) text_ = otherwise;
  }
  const std::string& text() const { return text_; }

 private:
  void say(const char* what, float value) {
    char buffer[128];
    std::snprintf(buffer, sizeof buffer, "%s of %.9g is out of range", what, value);
    require(false, buffer);
  }
  std::string text_;
};

constexpr float none = 0, least = 0x1p-20f, most = 0x1p20f, vast = 0x1p40f, tiny = 0x1p-100f;

/// Of the points of a stencil (compare/stages/force.hpp): none apart by less than `least_length`, but 0, nor all by
/// less than `least_longest`.
void check_lengths(FirstProblem& problem, std::span<const Vec3f> points, float least_length,
                   float least_longest = 0x1p-30f) {
  float longest = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const Vec3f &p = points[i], &q = points[j];
      const auto length = static_cast<float>(std::hypot(double{p.x} - q.x, double{p.y} - q.y, double{p.z} - q.z));
      if (length > 0) problem.number("a length", length, least_length, 0x1p22f);
      longest = std::max(longest, length);
    }
  if (longest > 0) problem.number("the longest length", longest, least_longest, 0x1p22f);
}

void check_damping(FirstProblem& problem, float damping) { problem.number("a damping", damping, none, most); }

/// No two vertices that an element or a spring holds together share a colour; exactly the free ones have one.
bool is_coloured(const SweepCase& c) {
  const Topology topology = build_topology(*c.scene);
  const std::vector<Index> groups = rigid_groups(*c.scene);
  const auto apart = [&](Index a, Index b) {
    return c.colour[static_cast<std::size_t>(a)] < 0 ||
           c.colour[static_cast<std::size_t>(a)] != c.colour[static_cast<std::size_t>(b)];
  };
  bool legal = c.colour.size() == groups.size();
  for (std::size_t v = 0; v < groups.size() && legal; ++v) legal = (c.colour[v] >= 0) == (groups[v] < 0);
  for (const Edge& e : topology.edges) legal = legal && apart(e[0], e[1]);
  for (const Hinge& hinge : topology.hinges) legal = legal && apart(hinge.opposite[0], hinge.opposite[1]);
  for (const Spring& spring : c.scene->springs) {
    legal = legal && apart(spring.first, spring.second);
    if (spring.third >= 0) legal = legal && apart(spring.first, spring.third) && apart(spring.second, spring.third);
  }
  return legal;
}

/// Rest shape, materials and settings are those of a valid scene. Where it stands may be anything: a run collapses
/// triangles that no scene may begin with.
std::string problem_of_scene(const std::shared_ptr<const Scene>& scene) {
  auto at_rest = std::make_shared<Scene>(*scene);
  at_rest->mesh.positions = at_rest->rest_positions;
  auto topology = std::make_shared<const Topology>(build_topology(*at_rest));
  return problems_of(RestStateCase{std::move(at_rest), std::move(topology)});
}

bool has_vertex(const Topology& topology, const Face& face, Index v) {
  const auto has = [v](const auto& vertices) {
    return std::find(vertices.begin(), vertices.end(), v) != vertices.end();
  };
  const auto i = static_cast<std::size_t>(face.index);
  switch (face.kind) {
    case FaceKind::vertex: return face.index == v;
    case FaceKind::edge: return has(topology.edges[i]);
    case FaceKind::triangle: return has(topology.triangles[i]);
  }
  return false;
}

bool is_question(const BlockCase& c, const BlockQuestion& question) {
  if (question.kind == BlockQuestion::Kind::vertex_in_surface)
    return !has_vertex(*c.topology, question.face, question.of);
  const Edge& e = c.topology->edges[static_cast<std::size_t>(question.of)];
  return question.face.kind != FaceKind::triangle && !has_vertex(*c.topology, question.face, e[0]) &&
         !has_vertex(*c.topology, question.face, e[1]);
}

struct Checked {
  FirstProblem problem{};

  void operator()(const ClosestFaceCase& c) {
    problem.vector("a coordinate", c.point);
    problem.vectors("a coordinate", c.triangle);
  }
  void operator()(const ClosestPointsCase& c) {
    problem.vectors("a coordinate", c.first);
    problem.vectors("a coordinate", c.second);
  }
  void operator()(const MeshCase& c) {
    const auto n = static_cast<std::size_t>(c.topology->vertex_count);
    problem.require(c.positions.size() == n && c.rigid_groups.size() == n,
                    "an array does not have one entry for each vertex");
    problem.vectors("a coordinate", c.positions);
    problem.number("a contact radius", c.contact_radius, 0x1p-60f, most);  // its square is a normal number
    problem.number("a query radius", c.query_radius, c.contact_radius, vast);
  }
  void operator()(const BlockCase& c) {
    problem.vectors("a coordinate", c.positions);
    for (const BlockQuestion& question : c.questions)
      problem.require(is_question(c, question), "a question is about a face that has a vertex of the asking one");
  }
  void operator()(const BoundCase& c) {
    problem.require(c.d_min_edge.size() == c.topology->edges.size() &&
                        c.d_min_triangle.size() == c.topology->triangles.size() &&
                        c.d_min_vertex.size() == static_cast<std::size_t>(c.topology->vertex_count),
                    "an array does not have one entry for each face");
    for (const auto* distances : {&c.d_min_vertex, &c.d_min_edge, &c.d_min_triangle})
      for (const float d : *distances) problem.number("a distance", d, none, vast);
    problem.number("a bound relaxation", c.bound_relaxation, 0x1p-10f, 0.5f);
  }
  void operator()(const ActivationCase& c) {
    problem.number("a contact radius", c.contact_radius, least, most);
    problem.number("a distance", c.distance, std::min(least, 0x1p-40f * c.contact_radius), most);
    problem.number("a stiffness", c.stiffness, 0x1p-30f, vast);
  }
  void operator()(const TruncateCase& c) {
    problem.vector("a coordinate", c.previous);
    problem.vector("a coordinate", c.position);
    problem.number("a bound", c.bound, none, std::numeric_limits<float>::max());
  }
  void operator()(const InitialGuessCase& c) {
    problem.vector("a coordinate", c.start);
    problem.vector("a coordinate", c.previous);
    problem.vector("a velocity", c.velocity);
    problem.vector("an acceleration", c.acceleration);
    problem.number("a time step", c.time_step, least, 1);
    problem.number("a bound", c.bound, none, vast);
    problem.require(c.held <= 1, "held is neither 0 nor 1");
  }
  void operator()(const MembraneCase& c) {
    problem.vectors("a coordinate", c.corner);
    problem.vectors("a coordinate at the start", c.start);
    check_lengths(problem, c.corner, 0x1p-50f, 0x1p-50f);
    check_lengths(problem, c.start, 0x1p-50f, 0x1p-50f);
    problem.number("an area", c.area, std::numeric_limits<float>::min(), vast);
    problem.number("a first Lamé constant", c.lame_lambda, none, vast);
    problem.number("a second Lamé constant", c.lame_mu, 0x1p-30f, vast);
    check_damping(problem, c.damping);
  }
  void operator()(const BendingCase& c) {
    problem.vectors("a coordinate", c.vertex);
    problem.vectors("a coordinate at the start", c.start);
    check_lengths(problem, c.vertex, 0x1p-30f);
    check_lengths(problem, c.start, 0x1p-30f);
    problem.number("a stiffness", c.stiffness, 0x1p-60f, vast);
    check_damping(problem, c.damping);
    problem.require(c.own >= 0 && c.own < 4, "no such vertex is asked about");
  }
  void operator()(const SpringCase& c) {
    problem.vectors("a coordinate", c.vertex);
    problem.vectors("a coordinate at the start", c.start);
    check_lengths(problem, std::span(c.vertex).first(c.ratio > 0 ? 3 : 2), 0x1p-63f, 0x1p-63f);
    check_lengths(problem, std::span(c.start).first(c.ratio > 0 ? 3 : 2), 0x1p-63f, 0x1p-63f);
    problem.number("a stiffness", c.stiffness, 0x1p-30f, vast);
    problem.number("a rest length", c.rest_length, none, most);
    check_damping(problem, c.damping);
    problem.number("a ratio", c.ratio, 0, 1);
    problem.require(c.own >= 0 && c.own <= (c.ratio > 0 ? 2 : 1), "no such vertex is asked about");
  }
  void operator()(const ContactForceCase& c) {
    problem.require(c.own >= 0 && c.own < vertex_count(c.sides), "no such vertex is asked about");
    problem.require(c.together < 16, "bits of more than four vertices are set");
    problem.vectors("a coordinate", c.vertex);
    problem.vectors("a coordinate at the detection", c.detected);
    const auto count = static_cast<std::size_t>(vertex_count(c.sides));
    // Of fourth powers triangles and pairs of edges have use alone.
    const float least_longest = count < 4 ? 0x1p-63f : 0x1p-30f;
    check_lengths(problem, std::span(c.vertex).first(count), 0x1p-63f, least_longest);
    check_lengths(problem, std::span(c.detected).first(count), 0x1p-63f, least_longest);
    problem.number("a contact radius", c.contact_radius, least, most);
    problem.number("a stiffness", c.stiffness, 0x1p-30f, vast);
    for (const float squared : c.rest_squared) problem.number("a squared rest length", squared, none, 0x1p42f);
  }
  void operator()(const FrictionForceCase& c) {
    (*this)(c.contact);
    problem.vectors("a coordinate at the start", c.start);
    problem.number("a friction coefficient", c.friction, none, 0x1p10f);
    problem.number("a slip limit", c.slip_limit, tiny, most);
  }
  void operator()(const RestStateCase& c) {
    const std::string why = problems_of(c);
    problem.require(why.empty(), why.c_str());
  }
  void operator()(const SweepCase& c) {
    const std::string why = problem_of_scene(c.scene);
    problem.require(why.empty(), why.c_str());
    problem.require(is_coloured(c), "two vertices of an element share a colour, or one that is held has any");
    for (const auto* positions : {&c.old, &c.start, &c.target, &c.previous})
      problem.vectors("a coordinate", *positions);
    for (const float bound : c.largest_bound) problem.number("a bound", bound, none, std::numeric_limits<float>::max());
    problem.number("a query radius", c.query_radius, static_cast<float>(c.scene->settings.contact_radius), vast);
  }
  void operator()(const StepCase& c) {
    const std::string why = problem_of_scene(c.scene);
    problem.require(why.empty(), why.c_str());
    problem.require(c.topology->triangles == c.scene->mesh.triangles, "the topology is another mesh's");
    problem.vectors("a coordinate", to_single(c.scene->mesh.positions));
    problem.vectors("a velocity", to_single(c.scene->velocities));
  }
};

}  // namespace

std::string problem_of(const CaseData& data) {
  Checked checked;
  std::visit([&](const auto& c) { checked(c); }, data);
  return checked.problem.text();
}

}  // namespace ogc::compare
