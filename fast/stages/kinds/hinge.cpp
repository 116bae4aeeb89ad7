#include "fast/stages/kinds/hinge.hpp"

#include <algorithm>

#include "fast/kernels/rest_state.hpp"

namespace ogc::fast {

namespace {

bool has_weights(const compare::Body& body) { return !body.fixed && reads_weights(body.material.bending); }

bool any_has_weights(const compare::Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), has_weights);
}

}  // namespace

void AtRest<HingeKind>::add(const RestBuild& build) {
  const auto& p = build.scene.rest_positions;
  const bool weighted = any_has_weights(build.scene);
  for (const compare::Hinge& hinge : build.topology.hinges) {
    const compare::Edge& edge = build.topology.edges[as_index(hinge.edge)];
    const int number = build.shared.body[as_index(edge[0])];
    const compare::Body& body = build.scene.bodies[as_index(number)];
    if (body.fixed || body.is_solid() || body.material.bending == compare::BendingModel::none) continue;
    const RestHinge shape = rest_hinge(p[as_index(edge[0])], p[as_index(edge[1])], p[as_index(hinge.opposite[0])],
                                       p[as_index(hinge.opposite[1])]);
    hinges.push_back({{edge[0], edge[1], hinge.opposite[0], hinge.opposite[1]},
                      number,
                      static_cast<float>(shape.angle),
                      static_cast<float>(body.material.bending_stiffness * shape.factor)});
    if (!weighted) continue;
    weights.emplace_back();
    if (!has_weights(body)) continue;
    for (int k = 0; k < 3; ++k) weights.back().weight[k] = static_cast<float>(shape.weight[k]);
  }
}

void AtRest<HingeKind>::add(const compare::RestStateIn& in, const compare::RestStateOut& out) {
  const bool weighted = any_has_weights(*in.scene);
  for (const compare::RestHinge& h : out.hinges) {
    hinges.push_back({{h.vertex[0], h.vertex[1], h.vertex[2], h.vertex[3]}, h.body, h.rest_angle, h.stiffness});
    if (weighted) weights.push_back({{h.weight[0], h.weight[1], h.weight[2]}});
  }
}

void AtRest<HingeKind>::give(compare::RestStateOut& out) const {
  for (std::size_t i = 0; i < hinges.size(); ++i) {
    const HingeRest& h = hinges[i];
    out.hinges.push_back({{h.vertex[0], h.vertex[1], h.vertex[2], h.vertex[3]}, h.body, h.angle, h.stiffness, {}});
    if (weights.empty()) continue;
    for (std::size_t k = 0; k < 3; ++k) out.hinges.back().weight[k] = weights[i].weight[k];
  }
}

}  // namespace ogc::fast
