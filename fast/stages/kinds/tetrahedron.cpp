#include "fast/stages/kinds/tetrahedron.hpp"

#include <algorithm>

#include "fast/kernels/rest_state.hpp"

namespace ogc::fast {

void AtRest<TetrahedronKind>::add_materials(const compare::Scene& scene) {
  for (const compare::Body& body : scene.bodies)
    solids.push_back({static_cast<float>(body.material.solid_lambda), static_cast<float>(body.material.solid_mu),
                      static_cast<float>(body.material.solid_damping / scene.settings.time_step)});
}

void AtRest<TetrahedronKind>::add(const RestBuild& build) {
  add_materials(build.scene);
  const auto& p = build.scene.rest_positions;
  for (std::size_t number = 0; number < build.scene.bodies.size(); ++number) {
    const compare::Body& body = build.scene.bodies[number];
    if (body.fixed) continue;
    for (int t = body.first_tetrahedron; t < body.first_tetrahedron + body.tetrahedron_count; ++t) {
      const compare::Tetrahedron& corners = build.scene.mesh.tetrahedra[as_index(t)];
      const RestTetrahedron shape = rest_tetrahedron(p[as_index(corners[0])], p[as_index(corners[1])],
                                                     p[as_index(corners[2])], p[as_index(corners[3])]);
      for (const int corner : corners) build.mass[as_index(corner)] += body.material.solid_density * shape.volume / 4;
      TetrahedronRest tetrahedron;
      for (int k = 0; k < 4; ++k) tetrahedron.corner[k] = corners[as_index(k)];
      tetrahedron.body = static_cast<int>(number);
      for (int i = 0; i < 6; ++i) tetrahedron.weight[i] = static_cast<float>(shape.weight[i]);
      tetrahedron.inverse = static_cast<float>(1 / (6 * shape.volume));
      tetrahedron.volume = static_cast<float>(shape.volume);
      for (int k = 0; k < 3; ++k) {
        const RestVector& gradient = shape.gradient[k + 1];
        tetrahedron.gradient[k][0] = static_cast<float>(gradient.x);
        tetrahedron.gradient[k][1] = static_cast<float>(gradient.y);
        tetrahedron.gradient[k][2] = static_cast<float>(gradient.z);
      }
      tetrahedra.push_back(tetrahedron);
    }
  }
}

void AtRest<TetrahedronKind>::add(const compare::RestStateIn& in, const compare::RestStateOut& out) {
  add_materials(*in.scene);
  for (const compare::RestTetrahedron& t : out.tetrahedra) {
    TetrahedronRest shape{{t.corner[0], t.corner[1], t.corner[2], t.corner[3]}, t.body, {}, t.inverse, {}, t.volume};
    std::copy_n(t.weight.begin(), 6, shape.weight);
    for (std::size_t k = 0; k < 3; ++k) std::copy_n(t.gradient[k].begin(), 3, shape.gradient[k]);
    tetrahedra.push_back(shape);
  }
}

void AtRest<TetrahedronKind>::give(compare::RestStateOut& out) const {
  for (const TetrahedronRest& t : tetrahedra) {
    compare::RestTetrahedron shape{
        {t.corner[0], t.corner[1], t.corner[2], t.corner[3]}, t.body, t.volume, t.inverse, {}, {}};
    std::copy_n(t.weight, 6, shape.weight.begin());
    for (std::size_t k = 0; k < 3; ++k) std::copy_n(t.gradient[k], 3, shape.gradient[k].begin());
    out.tetrahedra.push_back(shape);
  }
}

}  // namespace ogc::fast
