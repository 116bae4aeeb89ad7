// Holds small meshes for the tests of the fast path.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "compare/problem/mesh.hpp"
#include "fast/mesh.hpp"

namespace ogc::tests {

struct TestMesh {
  std::vector<compare::Vec3f> positions;
  std::vector<compare::Triangle> triangles;
  std::vector<compare::Edge> loose_edges;

  compare::Topology topology() const {
    return compare::build_topology(static_cast<compare::Index>(positions.size()), triangles, loose_edges);
  }
  /// Returns the same connectivity as solvers outside this project give it.
  fast::Mesh connectivity() const {
    return fast::Mesh(static_cast<compare::Index>(positions.size()), triangles, loose_edges);
  }
  /// Adds another surface as a separate component.
  void add(const TestMesh& other) {
    const auto first = static_cast<compare::Index>(positions.size());
    positions.insert(positions.end(), other.positions.begin(), other.positions.end());
    for (const auto& t : other.triangles) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    for (const auto& e : other.loose_edges) loose_edges.push_back({e[0] + first, e[1] + first});
  }
};

/// Returns n × n vertices in the xz plane at height y, spacing `step`, diagonals alternating.
inline TestMesh sheet(int n, float step, float y) {
  TestMesh surface;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i)
      surface.positions.push_back({static_cast<float>(i) * step, y, static_cast<float>(j) * step});
  }
  for (int j = 0; j + 1 < n; ++j) {
    for (int i = 0; i + 1 < n; ++i) {
      const int a = j * n + i, b = a + 1, c = a + n, d = c + 1;
      if ((i + j) % 2 == 0) {
        surface.triangles.insert(surface.triangles.end(), {{a, b, d}, {a, d, c}});
      } else {
        surface.triangles.insert(surface.triangles.end(), {{a, b, c}, {b, d, c}});
      }
    }
  }
  return surface;
}

/// Moves every coordinate by up to `by`, with a fixed seed.
inline TestMesh jittered(TestMesh surface, float by, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> amount(-by, by);
  for (auto& x : surface.positions) x = {x.x + amount(random), x.y + amount(random), x.z + amount(random)};
  return surface;
}

inline std::vector<compare::Vec3f> scaled(std::vector<compare::Vec3f> positions, float factor) {
  for (auto& x : positions) x = {x.x * factor, x.y * factor, x.z * factor};
  return positions;
}

}  // namespace ogc::tests
