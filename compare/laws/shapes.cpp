#include "compare/laws/shapes.hpp"

#include <utility>

namespace ogc::compare::law_shapes {

Mesh sheet(Index rows, Index columns, double spacing, double height) {
  Mesh mesh;
  for (Index i = 0; i < rows; ++i)
    for (Index j = 0; j < columns; ++j)
      mesh.positions.push_back({(i - 0.5 * (rows - 1)) * spacing, height, (j - 0.5 * (columns - 1)) * spacing});
  for (Index i = 0; i + 1 < rows; ++i)
    for (Index j = 0; j + 1 < columns; ++j) {
      const Index a = i * columns + j, b = a + 1, c = a + columns, d = c + 1;
      if ((i + j) % 2 == 0) {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({a, d, c});
      } else {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({b, d, c});
      }
    }
  return mesh;
}

Mesh floor_triangle(double reach, double height) {
  // An equilateral triangle's corners are twice as far from its centre as its edges are. The further factor 3/2 keeps
  // the edges away from bodies.
  const double corner = 3 * reach;
  return {.positions = {{corner, height, 0},
                        {-corner / 2, height, -corner * std::numbers::sqrt3 / 2},
                        {-corner / 2, height, corner * std::numbers::sqrt3 / 2}},
          .triangles = {{0, 1, 2}},
          .loose_edges = {}};
}

Mesh box(const std::array<Index, 3>& cells, double spacing, const Vec3& low) {
  // The six orders of axes along which a path leads from a cube's lowest to its highest corner. Odd permutations come
  // last; two corners of their tetrahedra are exchanged below.
  constexpr std::array<std::array<std::size_t, 3>, 6> orders{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  const std::array<Index, 3> count{cells[0] + 1, cells[1] + 1, cells[2] + 1};
  const auto number = [&](const std::array<Index, 3>& at) { return (at[0] * count[1] + at[1]) * count[2] + at[2]; };
  Mesh mesh;
  for (Index i = 0; i < count[0]; ++i)
    for (Index j = 0; j < count[1]; ++j)
      for (Index k = 0; k < count[2]; ++k) {
        mesh.positions.push_back({low.x + i * spacing, low.y + j * spacing, low.z + k * spacing});
        if (i == cells[0] || j == cells[1] || k == cells[2]) continue;
        for (std::size_t way = 0; way < orders.size(); ++way) {
          std::array<Index, 3> at{i, j, k};
          Tetrahedron corners{number(at)};
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[orders[way][step]];
            corners[step + 1] = number(at);
          }
          if (way >= 3) std::swap(corners[1], corners[2]);
          mesh.tetrahedra.push_back(corners);
        }
      }
  return mesh;
}

Mesh chain(std::vector<Vec3> points) {
  Mesh mesh;
  mesh.positions = std::move(points);
  for (Index k = 1; k < static_cast<Index>(mesh.positions.size()); ++k) mesh.loose_edges.push_back({k - 1, k});
  return mesh;
}

Scene empty_scene(const char* name, double time_step, std::int64_t steps, std::int64_t iterations) {
  Scene scene;
  scene.name = name;
  scene.gravity = {0, 0, 0};
  scene.settings.time_step = time_step;
  scene.settings.steps = steps;
  scene.settings.iterations = iterations;
  scene.settings.contact_radius = 0.01;
  return scene;
}

Material cloth(double friction) {
  Material material;
  material.density = 1;
  material.lame_mu = material.lame_lambda = 1000;
  material.bending = BendingModel::none;
  material.contact_stiffness = 1000;
  material.friction = friction;
  return material;
}

Scene stacked_sheets(const char* name, int sheets, std::int64_t steps) {
  Scene scene = empty_scene(name, 0.005, steps, 40);
  constexpr double spacing = 0.05, vertices = 25, reach = 0.5;
  scene.gravity = {0, -standard_gravity, 0};
  Material material = cloth(0.2);
  material.bending = BendingModel::discrete_hinge;
  material.bending_stiffness = 1e-3;
  const double each = 16 * spacing * spacing * standard_gravity / (vertices * material.contact_stiffness);
  double height = 0;
  for (int k = 0; k < sheets; ++k) {
    height += scene.settings.contact_radius - (sheets - k) * each;
    Mesh mesh = sheet(5, 5, spacing, height);
    // Each sheet is shifted by a fraction of a cell, so that no vertex lies above another one.
    for (Vec3& x : mesh.positions) x = {x.x + 0.3 * k * spacing, x.y, x.z + 0.2 * k * spacing};
    append_body(scene, {.name = "sheet", .material = material}, mesh);
  }
  append_body(scene, {.name = "floor", .fixed = true, .material = material}, floor_triangle(reach, 0));
  round_to_single(scene);
  return scene;
}

void set_velocity(Scene& scene, std::size_t body, const Vec3& velocity) {
  const Body& of = scene.bodies[body];
  for (Index v = of.first_vertex; v < of.first_vertex + of.vertex_count; ++v)
    scene.velocities[static_cast<std::size_t>(v)] = velocity;
}

void pin(Scene& scene, std::vector<Index> vertices) {
  scene.motions.push_back({.name = "pin", .vertices = std::move(vertices), .keyframes = {}});
}

}  // namespace ogc::compare::law_shapes
