// Tetrahedra at rest.
#pragma once

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

}  // namespace ogc::fast
