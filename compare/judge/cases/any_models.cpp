#include "compare/judge/cases/any_models.hpp"

#include <algorithm>
#include <cmath>

namespace ogc::compare {

namespace {

double distance(const Vec3& a, const Vec3& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// Adds a spring about as stiff as the membranes; one spring in three is a stitch (rest length 0).
void add_spring(Random& random, const std::vector<Index>& groups, Scene& scene) {
  const auto count = static_cast<int>(groups.size());
  const Index first = random.below(count), second = random.below(count);
  if (first == second ||
      (groups[static_cast<std::size_t>(first)] >= 0 && groups[static_cast<std::size_t>(second)] >= 0))
    return;
  const auto& x = scene.mesh.positions;
  const double length = distance(x[static_cast<std::size_t>(first)], x[static_cast<std::size_t>(second)]);
  Spring spring{first, second, random.magnitude(-1, 2), 0, 0};
  if (!random.one_in(3)) spring.rest_length = std::max(0x1p-19, length * random.between(0.5, 1.5));
  if (random.one_in(2)) spring.damping = random.magnitude(-4, -2);
  const Index third = random.below(count);
  if (random.one_in(2) && third != first && third != second)
    spring.third = third, spring.ratio = random.one_in(4) ? 0.5 : random.unit();
  scene.springs.push_back(spring);
}

}  // namespace

void choose_models(Random& random, Scene& scene) {
  scene.settings.contact_activation = random.pick(std::span<const ContactActivation>(choices<ContactActivation>));
  if (random.one_in(3)) scene.settings.damping = another(random, DampingForm::strain);
  for (Body& body : scene.bodies) {
    if (body.material.membrane != MembraneModel::none) body.material.membrane = any_model<MembraneModel>(random);
    if (body.material.bending != BendingModel::none) body.material.bending = any_model<BendingModel>(random);
  }
  add_springs(random, scene);
  round_to_single(scene);
}

void add_springs(Random& random, Scene& scene) {
  const std::vector<Index> groups = rigid_groups(scene);
  for (int springs = random.below(4); springs > 0; --springs) add_spring(random, groups, scene);
  if (random.one_in(2)) {
    for (const Spring& spring : scene.springs) {
      scene.excluded_pairs.push_back({spring.first, spring.second});
      if (spring.third >= 0) scene.excluded_pairs.push_back({spring.first, spring.third});
    }
  }
}

void bend_otherwise(Random& random, Scene& scene) {
  for (Body& body : scene.bodies)
    if (body.material.bending != BendingModel::none)
      body.material.bending = another(random, BendingModel::discrete_hinge);
}

}  // namespace ogc::compare
