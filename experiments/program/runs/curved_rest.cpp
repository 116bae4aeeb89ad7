#include "experiments/program/runs/curved_rest.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "compare/stages/rest_state.hpp"
#include "experiments/program/output.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

namespace {

/// Holds a body's hinges that are not flat at rest.
struct Bent {
  std::size_t hinges = 0;
  double degrees = 0;        ///< largest |θ₀|
  compare::Edge edge{0, 0};  ///< edge of the hinge with the largest angle, by vertices of the scene
};

bool is_isometric(const compare::Body& body) {
  return !body.fixed && body.material.bending == compare::BendingModel::isometric_quadratic &&
         body.material.bending_stiffness > 0;
}

/// Returns the bent hinges of each body. The rest state has no hinges of fixed bodies.
std::vector<Bent> bent_hinges(const compare::Scene& scene) {
  const compare::Topology topology = build_topology(scene);
  std::vector<Bent> bent(scene.bodies.size());
  for (const compare::RestHinge& hinge : fast::contestant(fast::Backend::cpu).rest_state({&scene, &topology}).hinges) {
    const double degrees = std::abs(double{hinge.rest_angle}) * 180 / std::numbers::pi;
    if (degrees <= flat_degrees) continue;
    Bent& of_body = bent[static_cast<std::size_t>(hinge.body)];
    ++of_body.hinges;
    if (degrees > of_body.degrees) of_body.degrees = degrees, of_body.edge = {hinge.vertex[0], hinge.vertex[1]};
  }
  return bent;
}

}  // namespace

std::string curved_rest_warning(const compare::Scene& scene) {
  if (std::ranges::none_of(scene.bodies, is_isometric)) return "";
  const std::vector<Bent> bent = bent_hinges(scene);
  const compare::Body* body = nullptr;
  Bent worst;
  for (std::size_t b = 0; b < bent.size(); ++b)
    if (is_isometric(scene.bodies[b]) && bent[b].degrees > worst.degrees) worst = bent[b], body = &scene.bodies[b];
  if (body == nullptr) return "";
  const auto own = [&](compare::Index v) { return std::to_string(v - body->first_vertex); };
  return "body '" + body->name + "' has bending=isometric_quadratic, which knows flat rest shapes alone, and " +
         counted(worst.hinges, "hinge") + " bent at rest, by up to " + number(worst.degrees) +
         " degrees (edge of its " + "vertices " + own(worst.edge[0]) + " and " + own(worst.edge[1]) +
         "): it unfolds as if it were made flat; take bending=discrete_hinge";
}

}  // namespace ogc::experiments
