// Stencils and distances of real states. A frame keeps x at the end of a step; for x beside xᵗ every vertex goes on for one more step at its velocity.
#include <algorithm>
#include <array>

#include "compare/judge/states.hpp"

namespace ogc::compare {

namespace {

constexpr int draws = 16;
constexpr double least_distance = 0x1p-20;

float single(double x) { return static_cast<float>(x); }

template <class Item>
const Item& any(Random& random, const std::vector<Item>& items) {
  return items[random.bits() % items.size()];
}

}  // namespace

Vec3f States::moved(const State& state, Index vertex) const {
  const auto i = static_cast<std::size_t>(vertex);
  const double h = scene_->settings.time_step;
  const Vec3f &x = state.positions[i], &v = state.velocities[i];
  return {single(x.x + h * v.x), single(x.y + h * v.y), single(x.z + h * v.z)};
}

MeetingMaterial States::meeting(Index v, Index w) const {
  const auto body = [&](Index vertex) { return static_cast<std::size_t>(body_[static_cast<std::size_t>(vertex)]); };
  return rest_.meetings[body(v) * scene_->bodies.size() + body(w)];
}

double States::distance(const CaseData& pair) const {
  if (const auto* face = std::get_if<ClosestFaceCase>(&pair)) return authority_.closest_face({{face->point}, {face->triangle}}).distance[0];
  const auto& edges = std::get<ClosestPointsCase>(pair);
  return authority_.closest_points({{edges.first}, {edges.second}}).contact_distance[0];
}

CaseData States::pair_distance(const State& state, Random& random) const {
  ActivationCase c{2 * contact_radius_, contact_radius_, 1, scene_->settings.activation};
  for (int draw = 0; draw < draws && c.distance >= contact_radius_; ++draw) {
    const bool edges = topology_->triangles.empty() || random.one_in(2);
    const auto d = single(distance(edges ? edge_edge(state, random) : vertex_triangle(state, random)));
    if (d >= single(least_distance)) c.distance = std::min(c.distance, d);
  }
  const float stiffness = any(random, rest_.meetings).stiffness;
  if (stiffness > 0) c.stiffness = stiffness;
  return c;
}

CaseData States::triangle(const State& state, Random& random) const {
  const RestTriangle& rest = any(random, rest_.triangles);
  const Material& material = scene_->bodies[static_cast<std::size_t>(rest.body)].material;
  MembraneCase c;
  const auto& [b, g] = rest.gradient;
  const std::array<std::array<float, 2>, 3> gradient{{{-b[0] - g[0], -b[1] - g[1]}, b, g}};
  const auto own = static_cast<std::size_t>(random.below(3));
  for (std::size_t k = 0; k < 3; ++k) {
    const Index v = rest.corner[(own + k) % 3];
    c.corner[k] = moved(state, v);
    c.start[k] = state.positions[static_cast<std::size_t>(v)];
    if (k > 0) c.gradient[k - 1] = gradient[(own + k) % 3];
  }
  c.area = rest.area;
  c.lame_lambda = single(material.lame_lambda);
  c.lame_mu = single(material.lame_mu);
  c.damping = single(material.membrane_damping / scene_->settings.time_step);
  c.model = material.membrane;
  c.damping_form = scene_->settings.damping;
  return c;
}

CaseData States::hinge(const State& state, Random& random) const {
  const RestHinge& rest = any(random, rest_.hinges);
  const Material& material = scene_->bodies[static_cast<std::size_t>(rest.body)].material;
  BendingCase c;
  for (std::size_t k = 0; k < 4; ++k) {
    c.vertex[k] = moved(state, rest.vertex[k]);
    c.start[k] = state.positions[static_cast<std::size_t>(rest.vertex[k])];
  }
  c.stiffness = rest.stiffness;
  c.rest_angle = rest.rest_angle;
  c.damping = single(material.bending_damping / scene_->settings.time_step);
  c.own = random.below(4);
  c.model = material.bending;
  c.weight = rest.weight;
  c.damping_form = scene_->settings.damping;
  return c;
}

CaseData States::spring(const State& state, Random& random) const {
  const Spring& spring = any(random, scene_->springs);
  SpringCase c;
  const std::array<Index, 3> ends{spring.first, spring.second, spring.third < 0 ? spring.second : spring.third};
  c.ratio = single(spring.ratio);
  c.own = random.below(c.ratio > 0 ? 3 : 2);
  for (std::size_t k = 0; k < 3; ++k) {
    c.vertex[k] = moved(state, ends[k]);
    c.start[k] = state.positions[static_cast<std::size_t>(ends[k])];
  }
  c.stiffness = single(spring.stiffness);
  c.rest_length = single(spring.rest_length);
  c.damping = single(spring.damping / scene_->settings.time_step);
  c.damping_form = scene_->settings.damping;
  return c;
}

}  // namespace ogc::compare
