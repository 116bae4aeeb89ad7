// Simulates a cloth that your program has as arrays, without scene files: a square sheet falls on a fixed triangle.
#include <cstdio>
#include <string>

#include "compare/problem/scene.hpp"
#include "compare/problem/validate.hpp"
#include "fast/contestant.hpp"

namespace {

/// Returns a sheet of n × n vertices, `side` [m] wide, in the plane y = height [m].
ogc::compare::Mesh sheet(int n, double side, double height) {
  ogc::compare::Mesh mesh;
  for (int i = 0; i < n * n; ++i) {
    mesh.positions.push_back({side * (i % n) / (n - 1.0), height, side * (i / n) / (n - 1.0)});
    if (i % n == n - 1 || i / n == n - 1) continue;
    mesh.triangles.insert(mesh.triangles.end(), {{i, i + n, i + 1}, {i + 1, i + n, i + n + 1}});
  }
  return mesh;
}

}  // namespace

int main() {
  ogc::compare::Scene scene;
  scene.name = "cloth_from_arrays";
  scene.settings.time_step = 1 / 300.0;
  scene.settings.iterations = 10;
  ogc::compare::append_body(scene, {.name = "cloth"}, sheet(20, 0.2, 0.03));
  ogc::compare::append_body(scene, {.name = "floor", .fixed = true},
                            {{{-1, 0, -1}, {3, 0, -1}, {-1, 0, 3}}, {{0, 1, 2}}, {}});
  ogc::compare::round_to_single(scene);
  // `validate` looks for everything but intersections, which `ogc audit` finds.
  const std::string problems = ogc::compare::describe(ogc::compare::validate(scene));
  if (!problems.empty()) {
    std::fprintf(stderr, "%s\n", problems.c_str());
    return 1;
  }

  // For a device: Backend::cuda.
  const auto simulation = ogc::fast::contestant(ogc::fast::Backend::cpu).start(scene, {});
  for (int frame = 0; frame < 5; ++frame) {
    const auto rows = simulation->advance(10);
    const auto& last = rows.back();
    std::printf("%s after %d steps: vertex 0 at y = %.4g m, %lld contacts\n", last.status == 0 ? "clean" : "stopped",
                10 * (frame + 1), double{simulation->snapshot().positions[0].y},
                static_cast<long long>(last.vertex_facet_contacts + last.edge_edge_contacts));
  }
}
