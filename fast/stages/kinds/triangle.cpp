#include "fast/stages/kinds/triangle.hpp"

#include "fast/kernels/rest_state.hpp"

namespace ogc::fast {

namespace {

// Computes ∇N₀ from the stored ∇N₁ and ∇N₂. A contestant's answer to the judge contains only these two.
void complete_gradient(TriangleRest& triangle) {
  for (int axis = 0; axis < 2; ++axis)
    triangle.gradient[0][axis] = -(triangle.gradient[1][axis] + triangle.gradient[2][axis]);
}

}  // namespace

void AtRest<TriangleKind>::add(const RestBuild& build) {
  const auto& p = build.scene.rest_positions;
  for (std::size_t number = 0; number < build.scene.bodies.size(); ++number) {
    const compare::Body& body = build.scene.bodies[number];
    if (body.fixed || body.is_solid()) continue;
    for (int t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t) {
      const compare::Triangle& corners = build.scene.mesh.triangles[as_index(t)];
      const RestTriangle shape = rest_triangle(p[as_index(corners[0])], p[as_index(corners[1])],
                                               p[as_index(corners[2])]);
      for (const int corner : corners) build.mass[as_index(corner)] += body.material.density * shape.area / 3;
      if (body.material.membrane == compare::MembraneModel::none) continue;
      TriangleRest triangle;
      for (int k = 0; k < 3; ++k) triangle.corner[k] = corners[as_index(k)];
      for (int k = 1; k < 3; ++k) {
        for (int axis = 0; axis < 2; ++axis) triangle.gradient[k][axis] = static_cast<float>(shape.gradient[k][axis]);
      }
      complete_gradient(triangle);
      triangle.body = static_cast<int>(number);
      triangle.area = static_cast<float>(shape.area);
      triangles.push_back(triangle);
    }
  }
}

void AtRest<TriangleKind>::add(const compare::RestStateIn&, const compare::RestStateOut& out) {
  for (const compare::RestTriangle& t : out.triangles) {
    TriangleRest triangle{{t.corner[0], t.corner[1], t.corner[2]},
                          t.body,
                          {{}, {t.gradient[0][0], t.gradient[0][1]}, {t.gradient[1][0], t.gradient[1][1]}},
                          t.area};
    complete_gradient(triangle);
    triangles.push_back(triangle);
  }
}

void AtRest<TriangleKind>::give(compare::RestStateOut& out) const {
  for (const TriangleRest& t : triangles)
    out.triangles.push_back({{t.corner[0], t.corner[1], t.corner[2]},
                             t.body,
                             t.area,
                             {{{t.gradient[1][0], t.gradient[1][1]}, {t.gradient[2][0], t.gradient[2][1]}}}});
}

}  // namespace ogc::fast
