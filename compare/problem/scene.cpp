// Does the bookkeeping of scenes, and computes the targets of prescribed motions, once for all contestants.
#include "compare/problem/scene.hpp"

#include <algorithm>
#include <cmath>

#include "compare/problem/material_table.hpp"
#include "compare/problem/rods.hpp"

namespace ogc::compare {
namespace {

// The value goes through memory. Otherwise g++ 12.2 at -O2 omits the conversions double → float → double if it
// vectorises two neighbouring values (basic-block vectorisation).
double rounded(double value) {
  const volatile float single = static_cast<float>(value);
  return single;
}

Vec3 rounded(const Vec3& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

Vec3f narrowed(const Vec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Evaluates x(t) as x + (R − I)(x − c) + u τ, τ s after the motion's start. R − I is sin θ K + 2 sin²(θ/2) K². So x(t)
// is exactly the start position before the motion starts.
struct RigidMotion {
  Vec3 centre, axis, shift;
  double sine, versine;

  RigidMotion(const PrescribedMotion& motion, double t) : centre(motion.centre) {
    const double elapsed = std::clamp(t, motion.start, motion.end) - motion.start;
    const double length = std::hypot(motion.axis.x, motion.axis.y, motion.axis.z);
    axis = {motion.axis.x / length, motion.axis.y / length, motion.axis.z / length};
    shift = {motion.velocity.x * elapsed, motion.velocity.y * elapsed, motion.velocity.z * elapsed};
    const double angle = motion.angular_velocity * elapsed, half = std::sin(angle / 2);
    sine = std::sin(angle);
    versine = 2 * half * half;
  }

  Vec3 operator()(const Vec3& x) const {
    const Vec3 once = cross(axis, {x.x - centre.x, x.y - centre.y, x.z - centre.z}), twice = cross(axis, once);
    return {x.x + sine * once.x + versine * twice.x + shift.x, x.y + sine * once.y + versine * twice.y + shift.y,
            x.z + sine * once.z + versine * twice.z + shift.z};
  }
};

Vec3 widened(const Vec3f& v) { return {v.x, v.y, v.z}; }

/// Returns the positions of `count` vertices at time `t`, interpolated between two keyframes in double. At a keyframe's
/// time they are exactly the keyframe's positions.
std::vector<Vec3f> between(const Keyframes& frames, std::size_t count, double t) {
  const std::vector<double>& times = frames.times;
  const auto after = static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), t) - times.begin());
  const std::size_t next = std::clamp<std::size_t>(after, 1, times.size() - 1), last = next - 1;
  const double share = std::clamp((t - times[last]) / (times[next] - times[last]), 0.0, 1.0);
  std::vector<Vec3f> targets;
  targets.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3 a = widened(frames.positions[last * count + k]), b = widened(frames.positions[next * count + k]);
    const Vec3 between{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)};
    targets.push_back(share == 1 ? frames.positions[next * count + k] : narrowed(between));
  }
  return targets;
}

}  // namespace

bool has_volume(const Mesh& mesh) {
  bool has = false;
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (HasVolume<List>) has = has || !(mesh.*List::list).empty();
  });
  return has;
}

std::vector<Triangle> surface_triangles(const Mesh& mesh) {
  if (!has_volume(mesh)) return mesh.triangles;
  std::vector<Triangle> surface;
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (HasVolume<List>) {
      const std::vector<Triangle> own = List::boundary(mesh.*List::list);
      surface.insert(surface.end(), own.begin(), own.end());
    }
  });
  return surface;
}

std::size_t append_body(Scene& scene, Body body, const Mesh& mesh) {
  const auto first = static_cast<Index>(scene.mesh.positions.size());
  body.first_vertex = first;
  body.vertex_count = static_cast<Index>(mesh.positions.size());
  const std::vector<Triangle> surface = surface_triangles(mesh);
  scene.mesh.positions.insert(scene.mesh.positions.end(), mesh.positions.begin(), mesh.positions.end());
  scene.rest_positions.insert(scene.rest_positions.end(), mesh.positions.begin(), mesh.positions.end());
  scene.velocities.resize(scene.mesh.positions.size());
  for_each_of<MeshLists>([&]<class List, std::size_t number>() {
    const auto& added = [&]() -> const auto& {
      if constexpr (number == 0)
        return surface;
      else
        return mesh.*List::list;
    }
    ();
    auto& all = scene.mesh.*List::list;
    if constexpr (HasRange<List>) {
      body.*List::first = static_cast<Index>(all.size());
      body.*List::count = static_cast<Index>(added.size());
    }
    for (ElementOf<List> element : added) {
      for (Index& v : element) v += first;
      all.push_back(element);
    }
  });
  scene.bodies.push_back(std::move(body));
  return scene.bodies.size() - 1;
}

void round_to_single(Scene& scene) {
  for (auto* vectors : {&scene.mesh.positions, &scene.rest_positions, &scene.velocities}) {
    for (Vec3& v : *vectors) v = rounded(v);
  }
  for (Body& body : scene.bodies) {
    for (const MaterialInfo& info : material_table()) body.material.*info.field = rounded(body.material.*info.field);
    if (!body.material.rod) continue;
    for (const RodInfo& info : rod_table())
      (*body.material.rod).*info.field = rounded((*body.material.rod).*info.field);
  }
  for_each_of<SceneLists>([&]<class List, std::size_t>() {
    for (auto& element : scene.*List::list)
      for (const auto& field : List::fields)
        if (field.number != nullptr) element.*field.number = rounded(element.*field.number);
  });
  scene.gravity = rounded(scene.gravity);
  for (const SettingInfo& info : setting_table()) {
    if (kind_of(info) == SettingKind::real)
      set_setting(scene.settings, info, rounded(get_setting(scene.settings, info)));
  }
}

std::vector<Index> rigid_groups(const Scene& scene) {
  std::vector<Index> groups(scene.mesh.positions.size(), -1);
  for (const Body& body : scene.bodies) {
    if (body.fixed) std::fill_n(groups.begin() + body.first_vertex, body.vertex_count, 0);
  }
  for (std::size_t k = 0; k < scene.motions.size(); ++k) {
    for (const Index v : scene.motions[k].vertices) groups[static_cast<std::size_t>(v)] = static_cast<Index>(k + 1);
  }
  return groups;
}

Index bounded_count(const Topology& topology, std::span<const Index> groups) {
  Index count = 0;
  for (std::size_t v = 0; v < groups.size(); ++v) count += groups[v] != 0 && topology.on_surface(static_cast<Index>(v));
  return count;
}

Exclusions exclusions(const Scene& scene) {
  return {rigid_groups(scene), partner_rows(scene.mesh.positions.size(), scene.excluded_pairs)};
}

void add_stitch(Scene& scene, Index first, Index second, Index third, double ratio, double stiffness) {
  if (ratio == 1) std::swap(second, third), ratio = 0;
  if (ratio == 0) third = -1;
  scene.springs.push_back({first, second, stiffness, 0, 0, third, ratio});
  scene.excluded_pairs.push_back({first, second});
  if (third >= 0) scene.excluded_pairs.push_back({first, third});
}

std::vector<Vec3f> prescribed_targets(const Scene& scene, const PrescribedMotion& motion, double t) {
  if (!motion.keyframes.empty()) return between(motion.keyframes, motion.vertices.size(), t);
  const RigidMotion moved(motion, t);
  std::vector<Vec3f> targets;
  targets.reserve(motion.vertices.size());
  for (const Index v : motion.vertices)
    targets.push_back(narrowed(moved(scene.mesh.positions[static_cast<std::size_t>(v)])));
  return targets;
}

std::vector<Index> body_of_vertex(const Scene& scene) {
  std::vector<Index> result(scene.mesh.positions.size(), -1);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    std::fill_n(result.begin() + body.first_vertex, body.vertex_count, static_cast<Index>(b));
  }
  return result;
}

Topology build_topology(const Scene& scene) {
  Topology topology = build_topology(scene.mesh);
  for (const Body& body : scene.bodies) {
    if (!body.is_volume()) continue;
    topology.off_surface.resize(scene.mesh.positions.size());
    std::fill_n(topology.off_surface.begin() + body.first_vertex, body.vertex_count, std::uint8_t{1});
  }
  return topology;
}

std::vector<Vec3f> to_single(const std::vector<Vec3>& positions) {
  std::vector<Vec3f> result(positions.size());
  std::transform(positions.begin(), positions.end(), result.begin(), [](const Vec3& v) { return narrowed(v); });
  return result;
}

std::vector<Vec3> to_double(const std::vector<Vec3f>& positions) {
  std::vector<Vec3> result(positions.size());
  std::transform(positions.begin(), positions.end(), result.begin(), [](const Vec3f& v) {
    return Vec3{v.x, v.y, v.z};
  });
  return result;
}

}  // namespace ogc::compare
