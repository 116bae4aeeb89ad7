#include "compare/judge/stages/parameter_ranges.hpp"

namespace ogc::compare::ranges {

namespace {

void set_in_scene(Scene& scene, const Override& parameter) {
  const double value = parameter.value;
  if (parameter.name == contact_radius.name) scene.settings.contact_radius = value;
  if (parameter.name == time_step.name) scene.settings.time_step = value;
  if (parameter.name == bounds_relaxation.name) scene.settings.bounds_relaxation = value;
  for (Body& body : scene.bodies) {
    if (parameter.name == contact_stiffness.name) body.material.contact_stiffness = value;
    if (parameter.name == friction.name) body.material.friction = value;
  }
}

}  // namespace

std::shared_ptr<const Scene> with_parameters(const Scene& scene, std::span<const Override> values) {
  auto changed = std::make_shared<Scene>(scene);
  for (const Override& parameter : values) set_in_scene(*changed, parameter);
  return changed;
}

}  // namespace ogc::compare::ranges
