// Keeps a solver of your own free of intersections. The solver here is as simple as can be: an upper triangle falls
// towards a lower one and drifts along it. The guard returns how far each vertex may go.
#include <cstdio>
#include <vector>

#include "fast/guard.hpp"

int main() {
  const std::vector<ogc::compare::Triangle> triangles{{0, 1, 2}, {3, 4, 5}};
  std::vector<ogc::compare::Vec3f> x{{0.0f, 0.0f, 0.0f},     {0.1f, 0.0f, 0.0f},     {0.0f, 0.1f, 0.0f},
                                     {0.02f, 0.02f, 0.003f}, {0.12f, 0.02f, 0.003f}, {0.02f, 0.12f, 0.003f}};
  std::vector<ogc::compare::Vec3f> dx(x.size());
  for (std::size_t v = 3; v < 6; ++v) dx[v] = {0.001f, 0.0f, -0.01f};

  const ogc::fast::Mesh mesh(static_cast<ogc::compare::Index>(x.size()), triangles);
  // For positions in device memory add Backend::cuda here and call step_resident(x, dx, x) below.
  ogc::fast::Guard guard(mesh, x, {.query_radius = 0.01f, .bounds = ogc::compare::Bounds::planes});
  for (int step = 0; step < 4; ++step) {
    const ogc::fast::GuardReport report = guard.step(x, dx, x);
    std::printf("%s, %d vertices cut, %.1f %% of the motion lost, vertex 3 at x = %.4g m, %.3g m above the triangle\n",
                report.detected ? "detected" : "no detection", report.cut, 100 * report.lost, double{x[3].x},
                double{x[3].z});
  }
}
