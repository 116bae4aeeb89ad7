#include "compare/judge/cases/mesh_builder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/judge/cases/placement.hpp"

namespace ogc::compare {

using namespace placement;

RodPlan some_rod(Random& random) {
  RodPlan plan;
  plan.closed = random.one_in(3);
  plan.segments = plan.closed ? 3 + random.below(5) : 1 + random.below(7);
  plan.branches = random.one_in(3) ? 1 + random.below(2) : 0;
  plan.bend = random.between(-0.6, 0.6);
  return plan;
}

Mesh rod_mesh(Random& random, const RodPlan& plan) {
  Mesh mesh;
  const auto add = [&](const Vec3& p) {
    mesh.positions.push_back(sum(p, scaled(in_box(random, -1, 1), plan.jitter)));
    return static_cast<Index>(mesh.positions.size() - 1);
  };
  const auto join = [&](Index a, Index b) { mesh.loose_edges.push_back(random.one_in(2) ? Edge{a, b} : Edge{b, a}); };
  if (plan.closed) {
    const double radius = 0.5 / std::sin(std::numbers::pi / plan.segments);
    for (int k = 0; k < plan.segments; ++k) {
      const double angle = 2 * std::numbers::pi * k / plan.segments;
      add({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
    for (Index k = 0; k < plan.segments; ++k) join(k, (k + 1) % plan.segments);
  } else {
    Vec3 p{};
    add(p);
    for (int k = 0; k < plan.segments; ++k) {
      p = sum(p, {std::cos(plan.bend * k), std::sin(plan.bend * k), 0});
      join(static_cast<Index>(k), add(p));
    }
  }
  for (int k = 0; k < plan.branches; ++k) {
    const auto from = static_cast<Index>(random.below(plan.segments));
    Vec3 p = mesh.positions[static_cast<std::size_t>(from)];
    Index last = from;
    for (int i = 0, count = 1 + random.below(3); i < count; ++i) {
      p = sum(p, {0.2 * k, 0.1, 1});
      const Index next = add(p);
      join(last, next);
      last = next;
    }
  }
  for (std::size_t i = mesh.loose_edges.size(); i > 1; --i)
    std::swap(mesh.loose_edges[i - 1], mesh.loose_edges[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
  return mesh;
}

void make_rod(Random& random, Body& body, double stretch, double length, double mass) {
  RodMaterial rod;
  rod.density = std::clamp(mass / length * random.magnitude(-0.5, 0.5), 0x1p-30, 0x1p40);
  rod.stretch = std::clamp(stretch * random.magnitude(-1, 1), 0x1p-30, 0x1p40);
  rod.bend = random.one_in(6) ? 0 : std::clamp(stretch * length * length * random.magnitude(-2, 0.5), 0x1p-36, 0x1p40);
  rod.damping = random.one_in(2) ? 0 : random.magnitude(-5, -2);
  body.material.rod = rod;
}

}  // namespace ogc::compare
