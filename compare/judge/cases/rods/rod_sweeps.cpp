#include "compare/judge/cases/generators.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "compare/judge/cases/any_models.hpp"
#include "compare/judge/cases/colours.hpp"
#include "compare/judge/cases/mesh_builder.hpp"
#include "compare/judge/cases/rods/quaternions.hpp"
#include "compare/problem/rods.hpp"

namespace ogc::compare {

namespace {

using namespace placement;
using rod_cases::Four;

/// Adds a rod near `centre` with edges about `size` long, and its state in a sweep.
void add_rod(Random& random, SweepCase& test, Scene& scene, const Vec3& centre, double size) {
  Mesh mesh = rod_mesh(random, some_rod(random));
  permute(random, mesh.positions);
  rotate(random, mesh.positions);
  for (Vec3& p : mesh.positions) p = sum(scaled(p, size), centre);
  Body body;
  body.name = "rod" + std::to_string(scene.bodies.size());
  body.material.contact_stiffness = random.magnitude(1, 3);
  body.material.friction = random.one_in(3) ? 0 : random.between(0.05, 1);
  const double mass = random.magnitude(-6, -3);
  make_rod(random, body, mass * size / (scene.settings.time_step * scene.settings.time_step), size, mass);
  const auto first = static_cast<Index>(scene.mesh.positions.size());
  append_body(scene, body, mesh);
  round_to_single(scene);
  const auto count = static_cast<Index>(mesh.positions.size());
  if (random.one_in(3)) {
    PrescribedMotion motion;
    motion.name = "held" + std::to_string(first);
    for (Index v = 0, held = 1 + static_cast<Index>(random.below(static_cast<int>(count))); v < held; ++v)
      motion.vertices.push_back(first + v);
    scene.motions.push_back(motion);
  }
  const double moved = size * random.magnitude(-3, -0.7);
  for (Index v = first; v < first + count; ++v) {
    const auto near = [&](double by) {
      return single(sum(scene.mesh.positions[static_cast<std::size_t>(v)], scaled(in_box(random, -1, 1), by)));
    };
    test.previous.push_back(near(moved));
    const Vec3f x = test.previous.back();
    const auto beside = [&](double by) { return single(sum({x.x, x.y, x.z}, scaled(in_box(random, -1, 1), by))); };
    test.start.push_back(beside(0.3 * moved));
    test.old.push_back(random.one_in(4) ? x : beside(0.3 * moved));
    test.target.push_back(beside(moved));
    test.largest_bound.push_back(random.one_in(3) ? static_cast<float>(size * random.magnitude(-3, 0))
                                                  : std::numeric_limits<float>::max());
  }
}

/// Returns a frame along the segment ab, rotated a little about a random axis. In some cases its twist is random;
/// otherwise neighbouring segments have similar twists.
Four frame_of(Random& random, const Vec3f& a, const Vec3f& b) {
  const Vec3 d{double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z};
  const double length = std::hypot(d.x, d.y, d.z);
  const Vec3 half = length > 0 ? sum(scaled(d, 1 / length), {0, 0, 1}) : Vec3{};
  if (random.one_in(8) || std::hypot(half.x, half.y, half.z) < 0.1) return rod_cases::frame_along(random, d);
  const Four frame = rod_cases::unit({half.x, half.y, half.z, 0});
  return rod_cases::product(frame, rod_cases::rotation(rod_cases::some_direction(random), random.between(-0.2, 0.2)));
}

SweepCase finished(Random& random, SweepCase test, Scene scene) {
  if (random.one_in(6)) scene.settings.damping = another(random, DampingForm::strain);
  test.colour = random_colours(random, scene, build_topology(scene));
  test.segment_colour = random_segment_colours(random, scene);
  for (const Index e : rod_segments(scene)) {
    const Edge& ends = scene.mesh.loose_edges[static_cast<std::size_t>(e)];
    const auto a = static_cast<std::size_t>(ends[0]), b = static_cast<std::size_t>(ends[1]);
    const Four now = frame_of(random, test.old[a], test.old[b]);
    test.orientation.push_back(rod_cases::single(now));
    test.orientation_start.push_back(rod_cases::single(
        rod_cases::product(now, rod_cases::rotation(rod_cases::some_direction(random), random.between(-0.1, 0.1)))));
  }
  test.scene = std::make_shared<Scene>(std::move(scene));
  return test;
}

}  // namespace

SweepCase with_rod(Random& random, SweepCase test) {
  Scene scene = *test.scene;
  const Vec3f& x = test.previous[static_cast<std::size_t>(random.below(static_cast<int>(test.previous.size())))];
  const double r = scene.settings.contact_radius;
  add_rod(random, test, scene, sum({x.x, x.y, x.z}, scaled(in_box(random, -1, 1), r)), r * random.magnitude(-0.5, 0.5));
  return finished(random, std::move(test), std::move(scene));
}

SweepCase rods_alone(Random& random) {
  constexpr std::array<std::int64_t, 5> lanes{2, 4, 8, 16, 0};
  SweepCase test;
  Scene scene;
  scene.name = "sweep";
  const double size = random.magnitude(-3, -1);
  scene.settings.time_step = random.magnitude(-3.5, -2);
  scene.settings.lanes = random.pick(std::span<const std::int64_t>(lanes));
  scene.settings.friction_velocity = random.magnitude(-3, -1);
  scene.settings.contact_radius = size * random.magnitude(-0.5, 0.5);
  const double r = scene.settings.contact_radius;
  for (int k = 0, count = 1 + random.below(2); k < count; ++k)
    add_rod(random, test, scene, scaled(in_box(random, -1, 1), k * (r + size)), size);
  test.query_radius = static_cast<float>(scene.settings.contact_radius * random.between(1, 3));
  if (random.one_in(2)) {
    add_springs(random, scene);
    round_to_single(scene);
  }
  return finished(random, std::move(test), std::move(scene));
}

}  // namespace ogc::compare
