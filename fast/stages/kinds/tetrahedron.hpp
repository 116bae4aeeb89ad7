// Tetrahedra at rest.
#pragma once

#include <algorithm>

#include "fast/kernels/rest_state.hpp"
#include "fast/stages/kinds/at_rest.hpp"

namespace ogc::fast {

template <>
struct AtRest<TetrahedronKind> : PlainAtRest<TetrahedronKind> {
  std::vector<TetrahedronRest> tetrahedra;
  std::vector<SolidMaterial> solids;  ///< by body

  const std::vector<TetrahedronRest>& elements() const { return tetrahedra; }
  void add(const RestBuild& build);
  void add(const compare::RestStateIn& in, const compare::RestStateOut& out);
  void give(compare::RestStateOut& out) const;
  /// Returns whether a solid is damped, because only damping reads the gradients.
  bool reads_beside(const RestShared&) const {
    for (const SolidMaterial& solid : solids)
      if (solid.damping > 0) return true;
    return false;
  }
  TetrahedronGradients beside(int tetrahedron, int corner) const {
    return TetrahedronKind::beside(tetrahedra[as_index(tetrahedron)], {}, corner);
  }
  bool damps(const RestShared&, int tetrahedron) const {
    return solids[as_index(tetrahedra[as_index(tetrahedron)].body)].damping > 0;
  }
  const std::vector<SolidMaterial>& by_body(const RestShared&) const { return solids; }

 private:
  void add_materials(const compare::Scene& scene);
};

inline void AtRest<TetrahedronKind>::add_materials(const compare::Scene& scene) {
  for (const compare::Body& body : scene.bodies)
    solids.push_back({static_cast<float>(body.material.solid_lambda), static_cast<float>(body.material.solid_mu),
                      static_cast<float>(body.material.solid_damping / scene.settings.time_step)});
}

inline void AtRest<TetrahedronKind>::add(const RestBuild& build) {
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

inline void AtRest<TetrahedronKind>::add(const compare::RestStateIn& in, const compare::RestStateOut& out) {
  add_materials(*in.scene);
  for (const compare::RestTetrahedron& t : out.tetrahedra) {
    TetrahedronRest shape{{t.corner[0], t.corner[1], t.corner[2], t.corner[3]}, t.body, {}, t.inverse, {}, t.volume};
    std::copy_n(t.weight.begin(), 6, shape.weight);
    for (std::size_t k = 0; k < 3; ++k) std::copy_n(t.gradient[k].begin(), 3, shape.gradient[k]);
    tetrahedra.push_back(shape);
  }
}

inline void AtRest<TetrahedronKind>::give(compare::RestStateOut& out) const {
  for (const TetrahedronRest& t : tetrahedra) {
    compare::RestTetrahedron shape{
        {t.corner[0], t.corner[1], t.corner[2], t.corner[3]}, t.body, t.volume, t.inverse, {}, {}};
    std::copy_n(t.weight, 6, shape.weight.begin());
    for (std::size_t k = 0; k < 3; ++k) std::copy_n(t.gradient[k], 3, shape.gradient[k].begin());
    out.tetrahedra.push_back(shape);
  }
}

}  // namespace ogc::fast
