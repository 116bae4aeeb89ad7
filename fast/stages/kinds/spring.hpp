// Springs at rest. Their rest lengths and stiffnesses are given by the scene, not computed from the rest shape.
#pragma once

#include "fast/stages/kinds/at_rest.hpp"

namespace ogc::fast {

template <>
struct AtRest<SpringKind> : PlainAtRest<SpringKind> {
  std::vector<SpringRest> springs;

  const std::vector<SpringRest>& elements() const { return springs; }
  void add(const RestBuild& build) { add(build.scene); }
  void add(const compare::RestStateIn& in, const compare::RestStateOut&) { add(*in.scene); }
  void give(compare::RestStateOut&) const {}
  bool damps(const RestShared&, int spring) const { return springs[as_index(spring)].damping > 0; }

 private:
  void add(const compare::Scene& scene) {
    for (const compare::Spring& spring : scene.springs) {
      const int third = spring.ratio > 0 ? spring.third : spring.second;
      springs.push_back({{spring.first, spring.second, third},
                         static_cast<float>(spring.stiffness),
                         static_cast<float>(spring.rest_length),
                         static_cast<float>(spring.damping / scene.settings.time_step),
                         static_cast<float>(spring.ratio)});
    }
  }
};

}  // namespace ogc::fast
