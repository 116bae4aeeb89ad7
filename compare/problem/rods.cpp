// Checks rods exactly: a segment reverses onto its neighbour if both leave their common vertex on one line
// (zero_area.hpp) in the same direction.
#include "compare/problem/rods.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "compare/problem/element_names.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/problem_kind.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/zero_area.hpp"

namespace ogc::compare {
namespace {

constexpr double least = 0x1p-30, most = 0x1p40;

constexpr std::array<RodInfo, 5> table{{
    {"density", "kg/m", "rod: mass per rest length", least, most, &RodMaterial::density},
    {"stretch", "N", "rod: stiffness k_s = EA of stretch and shear", least, most, &RodMaterial::stretch},
    {"bend", "N m²", "rod: stiffness k_b = EI = GJ of bend and twist", 0, most, &RodMaterial::bend},
    {"damping", "s", "rod: stiffness-proportional damping k_d", 0, most, &RodMaterial::damping},
    {"diameter", "m", "rod: as it is drawn", 0, 0x1p20, &RodMaterial::diameter},
}};

std::string quoted_body(const Body& body) { return "body '" + body.name + "'"; }

void check_constants(std::vector<Problem>& problems, const Body& body) {
  for (const RodInfo& info : rod_table()) {
    const double value = (*body.material.rod).*info.field;
    if (in_range(info, value)) continue;
    problems.push_back({quoted_body(body), "rod: " + std::string(info.name) + " is " + shortest(value),
                        "give " + describe_range(info)});
  }
}

/// Holds for each vertex whether it is on an element other than a loose edge, and whether it moves freely.
struct Vertices {
  std::vector<bool> has_mass, is_free;

  explicit Vertices(const Scene& scene) : has_mass(scene.mesh.positions.size()), is_free(has_mass.size(), true) {
    for_each_of<MeshLists>([&]<class List, std::size_t>() {
      if constexpr (HasRange<List>)
        for (const auto& element : scene.mesh.*List::list)
          for (const Index v : element) has_mass[at(v)] = true;
    });
    for (const Body& body : scene.bodies)
      if (body.fixed) std::fill_n(is_free.begin() + body.first_vertex, body.vertex_count, false);
    for (const PrescribedMotion& motion : scene.motions)
      for (const Index v : motion.vertices)
        if (v >= 0 && at(v) < is_free.size()) is_free[at(v)] = false;
  }
};

/// Returns whether the segments from `from` to `a` and to `b` have the same direction at rest. Only signs decide, so
/// the result is exact.
bool leaves_to_one_side(const Vec3& from, const Vec3& a, const Vec3& b) {
  if (!has_zero_area(from, a, b)) return false;
  // on one line the products of x, y and z coordinates all have the same sign, or are 0
  return (a.x - from.x) * (b.x - from.x) + (a.y - from.y) * (b.y - from.y) + (a.z - from.z) * (b.z - from.z) > 0;
}

void check_turns(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names, std::size_t limit,
                 std::span<const Index> segments) {
  ProblemKind reversed(problems, limit, "reverses onto its neighbour at rest, where a rod has no orientation",
                       "bend the rest shape there, or let the curve end");
  std::vector<std::array<Index, 2>> seen(scene.mesh.positions.size(), {-1, -1});  // segments at the vertex
  std::vector<Index> count(seen.size());
  for (const Index e : segments)
    for (const Index v : scene.mesh.loose_edges[at(e)])
      if (Index& n = count[at(v)]; n++ < 2) seen[at(v)][at(n - 1)] = e;
  for (std::size_t v = 0; v < seen.size(); ++v) {
    if (count[v] != 2) continue;
    const auto far_end = [&](Index e) {
      const Edge& ends = scene.mesh.loose_edges[at(e)];
      return at(at(ends[0]) == v ? ends[1] : ends[0]);
    };
    const auto& x = scene.rest_positions;
    const auto [first, second] = seen[v];
    if (leaves_to_one_side(x[v], x[far_end(first)], x[far_end(second)]))
      reversed.add(names.loose_edge(second, scene.mesh.loose_edges[at(second)]),
                   names.loose_edge(first, scene.mesh.loose_edges[at(first)]));
  }
}

void check_orientations(std::vector<Problem>& problems, const Scene& scene, std::size_t segments) {
  if (scene.orientations.empty()) return;
  if (scene.orientations.size() != segments)
    problems.push_back(
        {"orientations",
         std::to_string(scene.orientations.size()) + " entries for " + std::to_string(segments) + " segments of rods",
         "give one for each segment"});
  if (const std::ptrdiff_t wrong = find_no_unit(scene.orientations); wrong >= 0)
    problems.push_back({numbered("orientation", static_cast<std::size_t>(wrong)), "is no unit quaternion",
                        "give four numbers x, y, z, w whose squares add up to 1"});
}

}  // namespace

std::span<const RodInfo> rod_table() { return table; }

std::vector<Index> rod_segments(const Scene& scene) {
  const std::vector<Index> owner = body_of_vertex(scene);
  std::vector<Index> segments;
  for (std::size_t e = 0; e < scene.mesh.loose_edges.size(); ++e) {
    const Index body = owner[at(scene.mesh.loose_edges[e][0])];
    if (body >= 0 && scene.bodies[at(body)].material.rod) segments.push_back(static_cast<Index>(e));
  }
  return segments;
}

bool has_rods(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [](const Body& body) { return body.material.rod.has_value(); });
}

std::vector<Index> segment_groups(const Scene& scene, std::span<const Index> segments) {
  const std::vector<Index> groups = rigid_groups(scene);
  std::vector<Index> held;
  for (const Index e : segments) {
    const Edge& ends = scene.mesh.loose_edges[at(e)];
    const Index first = groups[at(ends[0])];
    held.push_back(first == groups[at(ends[1])] ? first : -1);
  }
  return held;
}

bool says_turn(const PrescribedMotion& motion) { return motion.keyframes.empty() || motion.keyframes.is_rigid; }

Quaternion prescribed_turn(const PrescribedMotion& motion, double from, double to) {
  const auto elapsed = [&](double t) { return std::clamp(t, motion.start, motion.end) - motion.start; };
  // The half angle is rounded first, so that the rotation does not depend on the origin of times.
  const auto half = static_cast<float>(motion.angular_velocity * (elapsed(to) - elapsed(from)) / 2);
  const double size = std::hypot(motion.axis.x, motion.axis.y, motion.axis.z), sine = std::sin(double{half});
  return {static_cast<float>(sine * motion.axis.x / size), static_cast<float>(sine * motion.axis.y / size),
          static_cast<float>(sine * motion.axis.z / size), static_cast<float>(std::cos(double{half}))};
}

std::ptrdiff_t find_no_unit(std::span<const Quaternion> orientations) {
  const auto wrong = std::ranges::find_if_not(orientations, [](const Quaternion& q) {
    double squared = 0;
    for (const float x : q) squared += double{x} * x;
    return std::abs(squared - 1) <= unit_quaternion_slack;
  });
  return wrong == orientations.end() ? -1 : wrong - orientations.begin();
}

void check_rods(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names, std::size_t limit) {
  const std::vector<Index> owner = body_of_vertex(scene);
  std::vector<bool> has_segments(scene.bodies.size());
  const Vertices vertices(scene);
  {
    ProblemKind massless(problems, limit, "moves and is on loose edges alone, of a body that is no rod: it has no mass",
                         "give the body's material a 'rod', make the body fixed, or prescribe the vertex");
    std::vector<bool> told(scene.mesh.positions.size());
    for (const Edge& ends : scene.mesh.loose_edges) {
      const std::size_t body = at(owner[at(ends[0])]);
      has_segments[body] = true;
      if (scene.bodies[body].material.rod) continue;
      for (const Index v : ends)
        if (!vertices.has_mass[at(v)] && vertices.is_free[at(v)] && !told[at(v)]) {
          massless.add(names.vertex(v));
          told[at(v)] = true;
        }
    }
  }
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    if (!body.material.rod) continue;
    check_constants(problems, body);
    if (!has_segments[b])
      problems.push_back({quoted_body(body), "has a rod's material and no loose edge",
                          "give it edges that belong to no triangle, or leave 'rod' out"});
  }
  const std::vector<Index> segments = rod_segments(scene);
  check_turns(problems, scene, names, limit, segments);
  check_orientations(problems, scene, segments.size());
}

}  // namespace ogc::compare
