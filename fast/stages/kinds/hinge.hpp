// Hinges at rest. Hinges without energy are left out: those of fixed bodies and solids, and those without a bending
// model.
#pragma once

#include "fast/stages/kinds/at_rest.hpp"

namespace ogc::fast {

template <>
struct AtRest<HingeKind> : PlainAtRest<HingeKind> {
  std::vector<HingeRest> hinges;
  std::vector<HingeWeights> weights;  ///< by hinge; empty if no model reads them

  const std::vector<HingeRest>& elements() const { return hinges; }
  const std::vector<HingeWeights>& rest_beside() const { return weights; }
  void add(const RestBuild& build);
  void add(const compare::RestStateIn& in, const compare::RestStateOut& out);
  void give(compare::RestStateOut& out) const;
  bool reads_beside(const RestShared&) const { return !weights.empty(); }
  IsometricStencil beside(int hinge, int role) const {
    return HingeKind::beside(hinges[as_index(hinge)], weights[as_index(hinge)], role);
  }
  bool damps(const RestShared& shared, int hinge) const {
    return shared.materials[as_index(hinges[as_index(hinge)].body)].bending_damping > 0;
  }
};

}  // namespace ogc::fast
