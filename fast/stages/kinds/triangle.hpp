// Holds the triangles at rest. Triangles without energy are left out: those of fixed bodies, and those without a
// membrane model.
#pragma once

#include "fast/stages/kinds/at_rest.hpp"

namespace ogc::fast {

template <>
struct AtRest<TriangleKind> : PlainAtRest<TriangleKind> {
  std::vector<TriangleRest> triangles;

  const std::vector<TriangleRest>& elements() const { return triangles; }
  void add(const RestBuild& build);
  void add(const compare::RestStateIn& in, const compare::RestStateOut& out);
  void give(compare::RestStateOut& out) const;
  bool damps(const RestShared& shared, int t) const {
    return shared.materials[as_index(triangles[as_index(t)].body)].membrane_damping > 0;
  }
};

}  // namespace ogc::fast
