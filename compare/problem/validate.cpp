// Lists everything that is wrong with a scene: its mesh (validate_mesh.cpp), then the rest of it.
#include "compare/problem/validate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>
#include <span>

#include "compare/problem/material_table.hpp"
#include "compare/problem/problem_kind.hpp"
#include "compare/problem/ranges.hpp"
#include "compare/problem/rods.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/validate_mesh.hpp"
#include "compare/problem/volumes.hpp"

namespace ogc::compare {
namespace {

std::string quoted(const char* kind, const std::string& name) { return std::string(kind) + " '" + name + "'"; }

bool usable_name(const std::string& name) {
  constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  return !name.empty() && name.find_first_not_of(letters) == std::string::npos;
}

void check_settings(std::vector<Problem>& problems, const Scene& scene) {
  const Settings& settings = scene.settings;
  for (const SettingInfo& info : setting_table()) {
    const double value = get_setting(settings, info);
    if (!in_range(info, value)) {
      problems.push_back(
          {quoted("setting", std::string(info.name)), "is " + shortest(value), "give " + describe_range(info)});
    }
  }
  // A twist runs along a rod while its vertices rest.
  if (settings.settled_move > 0 && has_rods(scene))
    problems.push_back({quoted("setting", "settled_move"),
                        "is " + shortest(as_typed(settings.settled_move)) + " in a scene with rods",
                        "give 0: segments may still turn where no vertex moves"});
}

void check_names(std::vector<Problem>& problems, const Scene& scene) {
  const std::string remedy = "use letters, digits, '_' and '-' (names become file names), each name once";
  if (!usable_name(scene.name)) problems.push_back({"scene", "name '" + scene.name + "' can't be used", remedy});
  std::set<std::string> bodies, motions;
  for (const Body& body : scene.bodies) {
    if (!usable_name(body.name) || !bodies.insert(body.name).second)
      problems.push_back({quoted("body", body.name), "name can't be used", remedy});
  }
  for (const PrescribedMotion& motion : scene.motions) {
    if (!usable_name(motion.name) || !motions.insert(motion.name).second) {
      problems.push_back({quoted("motion", motion.name), "name can't be used", remedy});
    }
  }
}

void check_materials(std::vector<Problem>& problems, const Scene& scene) {
  for (const Body& body : scene.bodies) {
    for (const MaterialInfo& info : material_table()) {
      const double value = body.material.*info.field;
      if (in_range(info, value)) continue;
      problems.push_back({quoted("body", body.name), std::string(info.name) + " is " + shortest(value),
                          "give " + describe_range(info)});
    }
  }
}

/// Returns "a, b and c".
std::string listed(const std::vector<std::string>& items) {
  std::string text = items.front();
  for (std::size_t i = 1; i < items.size(); ++i) text += (i + 1 < items.size() ? ", " : " and ") + items[i];
  return text;
}

/// Visits the mesh's lists in which each body has a range: visit.operator()<List, number>().
template <class Visit>
void each_range(Visit visit) {
  for_each_of<MeshLists>([&]<class List, std::size_t number>() {
    if constexpr (HasRange<List>) visit.template operator()<List, number>();
  });
}

// Returns whether the bodies are consecutive ranges that end at the last vertex and triangle; lists the first gap.
bool check_cover(std::vector<Problem>& problems, const Scene& scene) {
  std::vector<std::string> kinds{"vertices"};
  each_range([&]<class List, std::size_t>() { kinds.emplace_back(List::key); });
  const std::string remedy = "bodies are consecutive ranges that cover all " + listed(kinds);
  std::int64_t vertex = 0;
  std::array<std::int64_t, std::tuple_size_v<MeshLists>> next{};
  for (const Body& body : scene.bodies) {
    bool follows = body.first_vertex == vertex && body.vertex_count > 0;
    vertex += body.vertex_count;
    each_range([&]<class List, std::size_t number>() {
      follows = follows && body.*List::first == next[number] && body.*List::count >= 0;
      next[number] += body.*List::count;
    });
    if (follows) continue;
    problems.push_back({quoted("body", body.name), "does not begin where the one before it ends, or is empty", remedy});
    return false;
  }
  bool complete = true;
  std::vector<std::string> shares;
  const auto add = [&](std::int64_t covered, std::size_t all, const std::string& kind) {
    complete = complete && covered == static_cast<std::int64_t>(all);
    shares.push_back(std::to_string(covered) + " of " + std::to_string(all) + " " + kind);
  };
  add(vertex, scene.mesh.positions.size(), "vertices");
  each_range([&]<class List, std::size_t number>() { add(next[number], (scene.mesh.*List::list).size(), List::key); });
  if (!complete) problems.push_back({"scene", "bodies cover " + listed(shares), remedy});
  return complete;
}

void check_ownership(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names, std::size_t limit) {
  ProblemKind foreign(problems, limit, "has vertices of another body", "give each body faces on its own vertices");
  const std::vector<Index> owner = body_of_vertex(scene);
  const auto owner_of = [&](Index v) { return owner[static_cast<std::size_t>(v)]; };
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    const auto& all = scene.mesh.*List::list;
    const auto check = [&](std::size_t i, Index wanted, const std::string& of) {
      if (!std::ranges::all_of(all[i], [&](Index v) { return owner_of(v) == wanted; }))
        foreign.add(std::invoke(List::named, names, static_cast<Index>(i), all[i]), of);
    };
    if constexpr (HasRange<List>) {
      for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const Body& body = scene.bodies[b];
        for (Index i = body.*List::first; i < body.*List::first + body.*List::count; ++i)
          check(static_cast<std::size_t>(i), static_cast<Index>(b), quoted("of body", body.name));
      }
    } else {
      for (std::size_t i = 0; i < all.size(); ++i) check(i, owner_of(all[i][0]), {});
    }
  });
}

// Checks that the triangles of each solid are exactly the boundary of its tetrahedra.
void check_boundaries(std::vector<Problem>& problems, const Scene& scene) {
  for (const Body& body : scene.bodies) {
    if (!body.is_solid()) continue;
    const auto range = [&]<class List>() {
      return std::span(scene.mesh.*List::list)
          .subspan(static_cast<std::size_t>(body.*List::first), static_cast<std::size_t>(body.*List::count));
    };
    std::vector<Triangle> boundary;
    each_range([&]<class List, std::size_t>() {
      if constexpr (HasVolume<List>) {
        const std::vector<Triangle> faces = List::boundary(range.template operator()<List>());
        boundary.insert(boundary.end(), faces.begin(), faces.end());
      }
    });
    const auto own = range.template operator()<TrianglesOfMesh>();
    if (!std::equal(boundary.begin(), boundary.end(), own.begin(), own.end()))
      problems.push_back({quoted("body", body.name), "has tetrahedra and triangles that are not their boundary",
                          "give sheets a body of their own"});
  }
}

void check_keyframes(std::vector<Problem>& problems, const PrescribedMotion& motion, const ElementNames& names,
                     const std::string& where) {
  const Keyframes& frames = motion.keyframes;
  if (frames.empty() && frames.positions.empty()) return;
  if (frames.times.size() < 2)
    problems.push_back({where, "has " + std::to_string(frames.times.size()) + " keyframes", "give at least two"});
  const bool rising = std::adjacent_find(frames.times.begin(), frames.times.end(),
                                         [](double a, double b) { return !(a < b); }) == frames.times.end();
  const bool finite = std::all_of(frames.times.begin(), frames.times.end(), [](double t) { return std::isfinite(t); });
  if (!rising || !finite)
    problems.push_back({where, "has keyframes whose times do not rise", "give finite, ascending times [s]"});
  if (frames.positions.size() != frames.times.size() * motion.vertices.size())
    problems.push_back({where,
                        "has " + std::to_string(frames.positions.size()) + " positions in " +
                            std::to_string(frames.times.size()) + " keyframes of " +
                            std::to_string(motion.vertices.size()) + " vertices",
                        "give one for each vertex in each keyframe"});
  // If the first coordinate is NaN, std::max returns NaN, and the comparison is false. is_finite finds the other NaNs.
  const auto usable = [](const Vec3f& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) <= most_length;
  };
  const auto bad = std::find_if_not(frames.positions.begin(), frames.positions.end(), [&](const Vec3f& p) {
    return is_finite(Vec3{p.x, p.y, p.z}) && usable(p);
  });
  if (bad != frames.positions.end() && !motion.vertices.empty()) {
    const auto index = static_cast<std::size_t>(bad - frames.positions.begin());
    problems.push_back({where + ", keyframe " + std::to_string(index / motion.vertices.size()) + ", " +
                            names.vertex(motion.vertices[index % motion.vertices.size()]),
                        "position is not finite or beyond 2²⁰ m", "give three finite numbers [m]"});
  }
  if (motion.angular_velocity != 0 || motion.velocity != Vec3{})
    problems.push_back({where, "has keyframes and velocities", "give one of them"});
}

void check_motion_numbers(std::vector<Problem>& problems, const PrescribedMotion& motion, const ElementNames& names) {
  const std::string where = quoted("motion", motion.name);
  const auto numbers = {motion.angular_velocity, motion.start, motion.end};
  const bool finite = is_finite(motion.centre) && is_finite(motion.axis) && is_finite(motion.velocity) &&
                      std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
  if (!finite)
    problems.push_back({where, "has a number that is not finite", "give finite centre, axis, velocities and times"});
  const auto above = [](const Vec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) > most_length;
  };
  if (above(motion.centre) || above(motion.velocity) || std::abs(motion.angular_velocity) > most_length)
    problems.push_back({where, "has a centre, velocity or angular velocity above 2²⁰", "give metres, m/s and rad/s"});
  if (motion.axis == Vec3{}) problems.push_back({where, "has a zero axis", "give a direction, e.g. [1, 0, 0]"});
  if (!(motion.start <= motion.end)) problems.push_back({where, "ends before it starts", "give start ≤ end [s]"});
  if (motion.vertices.empty()) problems.push_back({where, "moves no vertex", "list vertices or remove the motion"});
  check_keyframes(problems, motion, names, where);
}

void check_motions(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names, bool covered,
                   std::size_t limit) {
  const std::string last = std::to_string(scene.mesh.positions.size() - 1);
  ProblemKind unknown(problems, limit, "names a vertex that does not exist", "vertices are numbered from 0 to " + last);
  ProblemKind fixed(problems, limit, "moves a vertex of a fixed body", "leave the vertex out or make the body free");
  ProblemKind twice(problems, limit, "moves a vertex that is prescribed already",
                    "list each vertex once, in one motion");
  const std::vector<Index> body = covered ? body_of_vertex(scene) : std::vector<Index>{};
  std::vector<bool> prescribed(scene.mesh.positions.size());
  for (const PrescribedMotion& motion : scene.motions) {
    check_motion_numbers(problems, motion, names);
    for (const Index v : motion.vertices) {
      const auto i = static_cast<std::size_t>(v);
      if (v < 0 || i >= prescribed.size()) {
        unknown.add(quoted("motion", motion.name) + ", vertex " + std::to_string(v) + " of the scene");
        continue;
      }
      const std::string where = quoted("motion", motion.name) + ", " + names.vertex(v);
      if (covered && scene.bodies[static_cast<std::size_t>(body[i])].fixed) fixed.add(where);
      if (prescribed[i]) twice.add(where);
      prescribed[i] = true;
    }
  }
}

/// Returns the name of a vertex whose number may be invalid.
std::string point_name(const Scene& scene, const ElementNames& names, Index v) {
  const bool exists = v >= 0 && static_cast<std::size_t>(v) < scene.mesh.positions.size();
  return exists ? names.vertex(v) : "vertex " + std::to_string(v) + " of the scene, which does not exist";
}

void check_excluded(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names, std::size_t limit) {
  ProblemKind unknown(problems, limit, "does not name two vertices", "give two different vertices of the scene");
  const auto count = static_cast<Index>(scene.mesh.positions.size());
  for (std::size_t i = 0; i < scene.excluded_pairs.size(); ++i) {
    const auto& [a, b] = scene.excluded_pairs[i];
    if (std::min(a, b) >= 0 && std::max(a, b) < count && a != b) continue;
    unknown.add(numbered("excluded pair", i), point_name(scene, names, a) + ", " + point_name(scene, names, b));
  }
}

bool check_lengths(std::vector<Problem>& problems, const Scene& scene) {
  const std::size_t expected = scene.mesh.positions.size();
  const auto check = [&](const char* name, std::size_t count) {
    if (count == expected) return true;
    problems.push_back({name, std::to_string(count) + " entries for " + std::to_string(expected) + " vertices",
                        "give one for each vertex"});
    return false;
  };
  const bool rest = check("rest positions", scene.rest_positions.size());
  return check("velocities", scene.velocities.size()) && rest;
}

void check_velocities(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names,
                      std::size_t limit) {
  ProblemKind bad(problems, limit, "velocity is not finite or above 2²⁰ m/s", "give three finite numbers [m/s]");
  const auto usable = [](const Vec3& v) {
    return is_finite(v) && std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) <= most_length;
  };
  for (std::size_t v = 0; v < scene.velocities.size(); ++v) {
    if (!usable(scene.velocities[v])) bad.add(names.vertex(static_cast<Index>(v)), printed(scene.velocities[v]));
  }
  if (!usable(scene.gravity)) bad.add("gravity", printed(scene.gravity));
}

}  // namespace

/// Checks springs; the ranges are as in the table of material constants.
void SpringsOfScene::check(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names,
                           std::size_t limit) {
  ProblemKind unknown(problems, limit, "does not join two vertices", "give two different vertices of the scene");
  ProblemKind range(problems, limit, "has a number out of range",
                    "give a stiffness up to 2⁴⁰ N/m, a rest length of 0 or from 2⁻²⁰ to 2²⁰ m and a damping up to 2⁴⁰ "
                    "s, none below 0");
  const auto count = static_cast<Index>(scene.mesh.positions.size());
  const auto within = [](double x, double most) { return x >= 0 && x <= most; };
  ProblemKind no_point(problems, limit, "has no such point on the line of its second and third vertex",
                       "give a third vertex, another than both, and a ratio from 0 to 1");
  for (std::size_t i = 0; i < scene.springs.size(); ++i) {
    const Spring& s = scene.springs[i];
    const bool known = std::min(s.first, s.second) >= 0 && std::max(s.first, s.second) < count && s.first != s.second;
    if (!known)
      unknown.add(numbered("spring", i), point_name(scene, names, s.first) + ", " + point_name(scene, names, s.second));
    const bool has_third = s.third >= 0 && s.third < count && s.third != s.first && s.third != s.second;
    if (s.third == -1 ? s.ratio != 0 : !(has_third && s.ratio >= 0 && s.ratio <= 1))
      no_point.add(numbered("spring", i),
                   (s.third == -1 ? "no third vertex" : "third " + point_name(scene, names, s.third)) + ", ratio " +
                       shortest(s.ratio));
    const bool length_is_legal = s.rest_length == 0 || (s.rest_length >= least_length && s.rest_length <= most_length);
    if (!length_is_legal || !within(s.stiffness, 0x1p40) || !within(s.damping, 0x1p40))
      range.add(numbered("spring", i),
                shortest(s.stiffness) + " N/m, " + shortest(s.rest_length) + " m, " + shortest(s.damping) + " s");
  }
}

std::vector<Problem> validate(const Scene& scene, std::size_t limit) {
  return validate(scene, limit, ElementNames(scene));
}

std::vector<Problem> validate(const Scene& scene, std::size_t limit, const ElementNames& names) {
  std::vector<Problem> problems = validate(scene.mesh, limit, names);
  check_names(problems, scene);
  check_settings(problems, scene);
  check_materials(problems, scene);
  if (scene.mesh.positions.empty()) return problems;
  std::vector<Problem> known;
  const bool indices_are_valid = check_indices({scene.mesh, names, 0, known});
  const bool has_lengths = check_lengths(problems, scene);
  if (indices_are_valid && has_lengths) {
    const MeshCheck check{scene.mesh, names, limit, problems};
    if (scene.rest_positions != scene.mesh.positions) check_positions(check, scene.rest_positions, "rest ");
    check_volumes(check, scene.rest_positions);
  }
  check_velocities(problems, scene, names, limit);
  const bool covered = check_cover(problems, scene);
  if (covered && indices_are_valid) {
    check_ownership(problems, scene, names, limit);
    check_boundaries(problems, scene);
    check_volume_bodies(problems, scene, names, limit);
    if (has_lengths) check_rods(problems, scene, names, limit);
  }
  check_motions(problems, scene, names, covered, limit);
  for_each_of<SceneLists>([&]<class List, std::size_t>() { List::check(problems, scene, names, limit); });
  check_excluded(problems, scene, names, limit);
  return problems;
}

std::string describe(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += problem.where + ": " + problem.what;
    if (!problem.remedy.empty()) text += "; " + problem.remedy;
  }
  return text;
}

}  // namespace ogc::compare
