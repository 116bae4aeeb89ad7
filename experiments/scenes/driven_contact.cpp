#include "experiments/scenes/driven_contact.hpp"

#include <algorithm>

#include "compare/problem/error.hpp"

namespace ogc::experiments {

std::vector<std::size_t> driven_bodies(const compare::Scene& scene) {
  const std::vector<compare::Index> groups = rigid_groups(scene);
  std::vector<std::size_t> driven;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const compare::Body& body = scene.bodies[b];
    const auto first = groups.begin() + body.first_vertex;
    const bool is_driven = std::all_of(first, first + body.vertex_count,
                                       [](compare::Index group) { return group > 0; });
    if (is_driven && body.vertex_count > 0 && body.triangle_count > 0 && !body.is_solid()) driven.push_back(b);
  }
  return driven;
}

void set_body_contact(compare::Scene& scene, compare::BodyContact contact) {
  const std::vector<std::size_t> driven = driven_bodies(scene);
  bool is_any = !driven.empty();
  for (const std::size_t b : driven) scene.bodies[b].contact = contact;
  for (compare::Body& body : scene.bodies) {
    if (!body.is_solid()) continue;
    body.contact = contact;
    is_any = true;
  }
  if (!is_any)
    throw compare::InputError("body_contact: no body of '" + scene.name +
                              "' is moved whole by a motion, and none has tetrahedra; leave it out, or give a body of "
                              "a scene file its body_contact");
  if (driven.empty()) return;
  switch (contact) {
    case compare::BodyContact::surface: scene.settings.detection_fraction = 0; break;
    case compare::BodyContact::volume: scene.settings.detection_fraction = 0.01; break;
  }
  compare::round_to_single(scene);
}

}  // namespace ogc::experiments
