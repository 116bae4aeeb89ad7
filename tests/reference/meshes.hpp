// Makes small meshes whose contacts can be derived by hand, and maps that move them exactly: integer coordinates stay
// exact in single precision.
#pragma once

#include <array>
#include <random>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "compare/stages/detect.hpp"

namespace ogc::tests {

using compare::Index;
using compare::Vec3f;

struct Surface {
  std::vector<Vec3f> positions;
  std::vector<compare::Triangle> triangles;
  std::vector<compare::Edge> loose_edges;
  std::vector<Index> groups;

  compare::Topology topology() const {
    return compare::build_topology(static_cast<Index>(positions.size()), triangles, loose_edges);
  }
};

/// Returns a detection question about a surface. The surface and the topology must outlive the question.
inline compare::DetectIn question(const Surface& surface, const compare::Topology& topology, float r, float r_q) {
  return {&topology, surface.groups, surface.positions, r, r_q};
}

/// Returns n × n vertices; vertex i + n j lies at (i, j, z) · spacing. Each cell is cut from its lower right to its
/// upper left corner, so inner vertices have six neighbours.
inline Surface grid(int n, float z = 0, float spacing = 1) {
  Surface surface;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i)
      surface.positions.push_back({static_cast<float>(i) * spacing, static_cast<float>(j) * spacing, z});
  }
  for (int j = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i) {
      const int a = j * n + i;
      surface.triangles.push_back({a, a + 1, a + n});
      surface.triangles.push_back({a + 1, a + n + 1, a + n});
    }
  }
  return surface;
}

/// Returns both surfaces in one; the vertices of `b` follow those of `a`.
inline Surface together(Surface a, const Surface& b) {
  const auto shift = static_cast<Index>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const auto& t : b.triangles) a.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  for (const auto& e : b.loose_edges) a.loose_edges.push_back({e[0] + shift, e[1] + shift});
  return a;
}

template <class Map>
Surface mapped(Surface surface, Map map) {
  for (Vec3f& x : surface.positions) x = map(x);
  return surface;
}

/// Moves every coordinate by at most `amount`.
inline Surface jittered(const Surface& surface, std::mt19937& random, float amount) {
  std::uniform_real_distribution<float> move(-amount, amount);
  return mapped(surface, [&](Vec3f x) { return Vec3f{x.x + move(random), x.y + move(random), x.z + move(random)}; });
}

/// Applies a similarity with integer entries that maps no axis to an axis. Integer coordinates stay exact.
inline Vec3f turned(const Vec3f& x) {
  const Vec3f a{3 * x.x - 4 * x.y, 4 * x.x + 3 * x.y, 5 * x.z};
  return {5 * a.x, 3 * a.y - 4 * a.z, 4 * a.y + 3 * a.z};
}
inline constexpr float turned_scale = 25;

/// Adds a vertex that belongs to no triangle.
inline Surface with_vertex(Surface surface, const Vec3f& x) {
  surface.positions.push_back(x);
  return surface;
}

/// Returns a jittered grid that is folded in half, with self-contact of all kinds.
inline Surface folded(int n, float gap, std::mt19937& random, float amount) {
  Surface surface = mapped(grid(n), [&](Vec3f x) {
    const float middle = static_cast<float>(n) / 2;
    return x.y < middle ? x : Vec3f{x.x, static_cast<float>(n - 1) - x.y, gap};
  });
  return jittered(surface, random, amount);
}

/// Returns random triangles in a unit cube that share random vertices: non-manifold edges, boundaries, intersections.
inline Surface soup(int vertices, int triangles, std::mt19937& random) {
  Surface surface;
  std::uniform_real_distribution<float> coordinate(0, 1);
  for (int v = 0; v < vertices; ++v)
    surface.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
  std::uniform_int_distribution<Index> pick(0, vertices - 1);
  while (static_cast<int>(surface.triangles.size()) < triangles) {
    const Index a = pick(random), b = pick(random), c = pick(random);
    if (a < b && b < c) surface.triangles.push_back({a, b, c});
  }
  return surface;
}

}  // namespace ogc::tests
