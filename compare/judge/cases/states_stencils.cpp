// Takes stencils and distances from real states. A frame stores x at the end of a step. To get x in addition to xᵗ,
// each vertex moves at its velocity for one more step.
#include <algorithm>
#include <array>

#include "compare/judge/cases/states.hpp"

namespace ogc::compare {

namespace {

float single(double x) { return static_cast<float>(x); }

template <class Item>
const Item& any(Random& random, const std::vector<Item>& items) {
  return items[random.bits() % items.size()];
}

}  // namespace

Vec3f States::moved(const State& state, Index vertex, double part) const {
  const auto i = static_cast<std::size_t>(vertex);
  const double h = part * scene_->settings.time_step;
  const Vec3f &x = state.positions[i], &v = state.velocities[i];
  return {single(x.x + h * v.x), single(x.y + h * v.y), single(x.z + h * v.z)};
}

MembraneCase States::triangle(std::size_t frame, Random& random) const {
  const State& state = states_[frame];
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

BendingCase States::hinge(std::size_t frame, Random& random) const {
  const State& state = states_[frame];
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

SpringCase States::spring(std::size_t frame, Random& random) const {
  const State& state = states_[frame];
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

TetrahedronCase States::tetrahedron(std::size_t frame, Random& random) const {
  const State& state = states_[frame];
  const RestTetrahedron& rest = any(random, rest_.tetrahedra);
  const Material& material = scene_->bodies[static_cast<std::size_t>(rest.body)].material;
  TetrahedronCase c;
  for (std::size_t k = 0; k < 4; ++k) {  // corner 0 is the vertex of the question
    c.corner[k] = moved(state, rest.corner[k]);
    c.start[k] = state.positions[static_cast<std::size_t>(rest.corner[k])];
  }
  c.weight = {rest.weight[0], rest.weight[1], rest.weight[2]};
  c.inverse = rest.inverse;
  c.gradient = rest.gradient;
  c.volume = rest.volume;
  c.lame_lambda = single(material.solid_lambda);
  c.lame_mu = single(material.solid_mu);
  c.damping = single(material.solid_damping / scene_->settings.time_step);
  c.damping_form = scene_->settings.damping;
  return c;
}

}  // namespace ogc::compare
