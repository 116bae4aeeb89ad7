// Makes scenes of one step, small enough for exact detections at every event (detection, guess round or sweep). Sheets
// lie in planes z = const until one symmetry of the cube is applied to all. Ladders approach what decides the order of
// events: the threshold of cut vertices, the cap of r_q (method.md §5.3), contacts at the radius.
#include <algorithm>
#include <array>
#include <cmath>

#include "compare/judge/cases/any_models.hpp"
#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/mesh_builder.hpp"
#include "compare/judge/cases/placement.hpp"
#include "compare/judge/cases/solid_block.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

/// Builds a scene in metres; `spacing` is about the length of an edge.
struct StepBuilder {
  Random& random;
  double spacing;
  Scene scene;

  explicit StepBuilder(Random& source) : random(source), spacing(0.01 * source.magnitude(-0.5, 0.5)) {
    constexpr std::array<double, 4> steps{0.01, 0.01, 0x1p-6, 0.001}, caps{1, 1.5, 4, 16}, fractions{0.01, 0.1, 0.5, 1};
    struct Between {
      std::int64_t most, least;  // iterations between two detections
    };
    constexpr std::array<Between, 4> between{{{0, 1}, {0, 3}, {1, 1}, {2, 1}}};
    constexpr std::array<std::int64_t, 4> lanes{0, 2, 4, 16};
    constexpr std::array<std::int64_t, 3> rounds{1, 2, 16};
    scene.name = "step";
    Settings& s = scene.settings;
    s.time_step = random.pick(std::span<const double>(steps));
    s.iterations = 1 + random.below(6);
    s.contact_radius = spacing * random.between(0.1, 0.6);
    s.detection_radius_cap = random.pick(std::span<const double>(caps));
    s.bounds_relaxation = random.one_in(2) ? 0.45 : random.between(0.1, 0.49);
    s.detection_fraction = random.pick(std::span<const double>(fractions));
    const Between iterations = random.pick(std::span<const Between>(between));
    s.detection_every = iterations.most, s.detection_gap = iterations.least;
    s.guess_rounds = random.pick(std::span<const std::int64_t>(rounds));
    s.lanes = random.pick(std::span<const std::int64_t>(lanes));
    s.friction_velocity = speed(random.magnitude(-2, -0.5));
    scene.gravity = {0, 0, random.one_in(3) ? 0 : -9.81};
  }

  /// Returns a material whose stiffnesses are at most a thousand times the inertia m/h². For stiffer materials a solve
  /// in single precision is too inaccurate to compare; stage sweep covers them.
  Material material() {
    Material m;
    m.membrane = MembraneModel::st_venant_kirchhoff;  // choose_models sets other models
    m.density = 0.2 * random.magnitude(-0.5, 0.5);
    const double inertia = m.density * spacing * spacing / (scene.settings.time_step * scene.settings.time_step);
    m.lame_mu = inertia * random.magnitude(-1, 2.5);
    m.lame_lambda = random.one_in(4) ? 0 : inertia * random.magnitude(-1, 2.5);
    m.bending_stiffness = inertia * spacing * spacing * random.magnitude(-3, 0.5);
    m.membrane_damping = random.one_in(2) ? 0 : random.magnitude(-5, -2);
    m.bending_damping = random.one_in(2) ? 0 : random.magnitude(-5, -2);
    m.contact_stiffness = inertia * random.magnitude(-1, 3);
    m.friction = random.one_in(3) ? 0 : random.between(0.05, 0.8);
    return m;
  }

  /// Returns a material for a solid. Its stiffness relative to inertia has the same range as in `material`.
  Material solid_material() {
    Material m = material();
    m.solid_density = 1000 * random.magnitude(-0.5, 0.5);
    const double inertia = m.solid_density * spacing * spacing / (scene.settings.time_step * scene.settings.time_step);
    m.solid_mu = inertia * random.magnitude(-1, 2.5);
    m.solid_lambda = random.one_in(4) ? 0 : inertia * random.magnitude(-1, 2.5);
    m.solid_damping = random.one_in(2) ? 0 : random.magnitude(-5, -2);
    m.contact_stiffness = inertia * spacing * random.magnitude(-1, 3);
    return m;
  }

  /// Adds nx × ny vertices with alternating diagonals and one velocity [m/s]. `origin` is in units of `spacing`. The
  /// sheet is shifted by two spacings along each axis, so that jitter brings no coordinate near 0.
  void sheet(int nx, int ny, const Vec3& origin, const Vec3& velocity, bool fixed = false) {
    Mesh mesh;
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) mesh.positions.push_back(scaled(sum(origin, {2.0 + i, 2.0 + j, 2.0}), spacing));
    for (int j = 0; j + 1 < ny; ++j)
      for (int i = 0; i + 1 < nx; ++i) {
        const Index a = j * nx + i, b = a + 1, c = a + nx, d = c + 1;
        if ((i + j) % 2 == 0)
          mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
        else
          mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {b, d, c}});
      }
    add(mesh, velocity, fixed);
  }

  /// Adds a block of tetrahedra above the plane of a sheet at `origin`, or below it if `hangs`. A block above the plane
  /// has an interior vertex. One block in five is mirrored upside down in place, so that it starts inside out. Volumes
  /// are never mirrored, because a volume that is inside out has no inside.
  void block(const Vec3& origin, const Vec3& velocity, bool hangs, BodyContact contact = BodyContact::surface) {
    const double height = random.between(0.5, 1.5);
    Mesh mesh = hangs ? jittered_block(random, spacing, height) : jittered_cube(random, spacing, height);
    const auto higher = [](const Vec3& a, const Vec3& b) { return a.z < b.z; };
    const auto [low, high] = std::minmax_element(mesh.positions.begin(), mesh.positions.end(), higher);
    const double lowest = low->z, highest = high->z;
    Vec3 shift = scaled(sum(origin, {2, 2, 2}), spacing);
    shift.z -= hangs ? highest : lowest;
    for (Vec3& x : mesh.positions) x = sum(x, shift);
    add(mesh, velocity, false);
    scene.bodies.back().contact = contact;
    if (is_volume(contact) || !random.one_in(5)) return;
    for (std::size_t v = scene.mesh.positions.size() - mesh.positions.size(); v < scene.mesh.positions.size(); ++v) {
      double& z = scene.mesh.positions[v].z;
      z = lowest + highest + 2 * shift.z - z;
    }
  }

  /// Add a volume without tetrahedra, fixed or moved as a whole. The first function adds the boundary of a block, the
  /// second one a given mesh.
  void volume(const Vec3& origin) { volume(jittered_surface(random, spacing, random.between(0.5, 1.5)), origin); }
  void volume(Mesh mesh, const Vec3& origin) {
    for (Vec3& x : mesh.positions) x = sum(x, scaled(sum(origin, {2, 2, 2}), spacing));
    const auto first = static_cast<Index>(scene.mesh.positions.size());
    const bool is_fixed = random.one_in(4);
    add(mesh, {}, is_fixed);
    scene.bodies.back().contact = BodyContact::volume;
    if (is_fixed) return;
    PrescribedMotion motion;
    motion.name = "driven" + std::to_string(first);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) motion.vertices.push_back(first + static_cast<Index>(v));
    motion.velocity = scaled(in_box(random, -1, 1), speed(random.magnitude(-2, 0)));
    if (random.one_in(2)) motion.angular_velocity = random.sign() * random.magnitude(-2, 0) / scene.settings.time_step;
    motion.axis = sum(in_box(random, -1, 1), {0, 0, 2});
    motion.centre = mesh.positions.front();
    scene.motions.push_back(motion);
  }

  /// Adds a curve of loose edges about `origin`. Its vertices are about as heavy as those of a sheet. In some cases a
  /// rotating motion prescribes two of them.
  void rod(const Vec3& origin, const Vec3& velocity) {
    RodPlan plan = some_rod(random);
    plan.segments = std::min(plan.segments, 5);
    Mesh mesh = rod_mesh(random, plan);
    for (Vec3& x : mesh.positions) x = scaled(sum(sum(x, origin), {2, 2, 2}), spacing);
    const auto first = static_cast<Index>(scene.mesh.positions.size());
    add(mesh, velocity, false);
    const double mass = 0.2 * spacing * spacing, inertia = mass / (scene.settings.time_step * scene.settings.time_step);
    make_rod(random, scene.bodies.back(), inertia * spacing * random.magnitude(-1, 1), spacing, mass);
    if (!random.one_in(3)) return;
    PrescribedMotion motion;
    motion.name = "held" + std::to_string(first);
    for (Index v = 0; v < 2; ++v) motion.vertices.push_back(first + v);
    motion.centre = mesh.positions.front();
    motion.axis = sum(in_box(random, -1, 1), {0, 0, 2});
    motion.angular_velocity = random.sign() * random.magnitude(-3, -0.5) / scene.settings.time_step;
    scene.motions.push_back(motion);
  }

  void add(const Mesh& mesh, const Vec3& velocity, bool fixed) {
    const auto first = scene.mesh.positions.size();
    Body body;
    body.name = "body_" + std::to_string(scene.bodies.size());
    body.fixed = fixed;
    body.material = has_volume(mesh) ? solid_material() : material();
    append_body(scene, body, mesh);
    std::fill(scene.velocities.begin() + static_cast<std::ptrdiff_t>(first), scene.velocities.end(), velocity);
  }

  /// Moves every coordinate of the start positions by up to `by` spacings; rest positions stay.
  void jitter(double by) {
    for (Vec3& x : scene.mesh.positions) x = sum(x, scaled(in_box(random, -by, by), spacing));
  }

  /// Returns the speed that moves a vertex by this many spacings in one step.
  double speed(double spacings) const { return spacings * spacing / scene.settings.time_step; }

  CaseData finish() {
    const std::size_t n = scene.mesh.positions.size();
    std::vector<Vec3> all = scene.mesh.positions;
    all.insert(all.end(), scene.rest_positions.begin(), scene.rest_positions.end());
    all.insert(all.end(), scene.velocities.begin(), scene.velocities.end());
    all.push_back(scene.gravity);
    for (const PrescribedMotion& motion : scene.motions) all.insert(all.end(), {motion.centre, motion.velocity});
    for (const PrescribedMotion& motion : scene.motions)
      for (const Vec3f& p : motion.keyframes.positions) all.push_back({p.x, p.y, p.z});
    permute(random, all);
    const auto part = [&](std::size_t k) {
      const auto first = all.begin() + static_cast<std::ptrdiff_t>(k * n);
      return std::vector<Vec3>(first, first + static_cast<std::ptrdiff_t>(n));
    };
    scene.mesh.positions = part(0), scene.rest_positions = part(1), scene.velocities = part(2);
    scene.gravity = all[3 * n];
    for (std::size_t k = 0; k < scene.motions.size(); ++k) {
      scene.motions[k].centre = all[3 * n + 1 + 2 * k];
      scene.motions[k].velocity = all[3 * n + 2 + 2 * k];
    }
    auto next = all.begin() + static_cast<std::ptrdiff_t>(3 * n + 1 + 2 * scene.motions.size());
    for (PrescribedMotion& motion : scene.motions)
      for (Vec3f& p : motion.keyframes.positions) p = single(*next++);
    round_to_single(scene);
    turn_mirrored(scene);
    return StepCase{std::make_shared<Scene>(scene), std::make_shared<Topology>(build_topology(scene))};
  }
};

int side(Random& random) { return 2 + random.below(4); }

Vec3 direction(Random& random) {
  const Vec3 v = in_box(random, -1, 1);
  return scaled(v, 1 / std::max(0.1, std::hypot(v.x, v.y, v.z)));
}

/// Makes a single sheet that flies freely, slower or faster than its bounds allow.
CaseData fall(Random& random) {
  StepBuilder builder(random);
  builder.sheet(side(random), side(random), {}, scaled(direction(random), builder.speed(random.magnitude(-2, 1))));
  builder.jitter(random.between(0.02, 0.2));
  return builder.finish();
}

/// Drops a sheet askew onto a fixed one.
CaseData onto(Random& random) {
  StepBuilder builder(random);
  const double gap = random.between(0.2, 1.5), slip = random.between(-1, 1);
  builder.sheet(side(random), side(random), {random.between(-0.5, 0.5), random.between(-0.5, 0.5), gap},
                {builder.speed(0.3 * slip), 0, -builder.speed(random.magnitude(-2, 0.7))});
  builder.sheet(side(random), side(random), {}, {}, true);
  builder.jitter(random.between(0.01, 0.09));
  return builder.finish();
}

/// Throws two sheets at each other.
CaseData collide(Random& random) {
  StepBuilder builder(random);
  const double speed = builder.speed(random.magnitude(-2, 0.7));
  builder.sheet(side(random), side(random),
                {random.between(-0.5, 0.5), random.between(-0.5, 0.5), random.between(0.2, 1.5)},
                {0, 0.3 * speed, -speed});
  builder.sheet(side(random), side(random), {}, {0, 0, 0.5 * speed});
  builder.jitter(random.between(0.01, 0.09));
  return builder.finish();
}

/// Returns a motion with keyframes for the vertices of `like`; each vertex has its own path. The time step ends between
/// two keyframes, at one, or after the last.
PrescribedMotion keyframed(Random& random, const StepBuilder& builder, const PrescribedMotion& like) {
  const double h = builder.scene.settings.time_step;
  PrescribedMotion motion;
  motion.name = like.name;
  motion.vertices = like.vertices;
  motion.keyframes.times = {random.one_in(2) ? 0.0 : -h, h * (random.one_in(3) ? 1.0 : random.between(0.2, 0.9))};
  if (random.one_in(2)) motion.keyframes.times.push_back(2 * h);
  const double apart = builder.spacing * random.magnitude(-2, 0);
  for (std::size_t frame = 0; frame < motion.keyframes.times.size(); ++frame)
    for (const Index v : motion.vertices)
      motion.keyframes.positions.push_back(
          single(sum(builder.scene.mesh.positions[static_cast<std::size_t>(v)], in_box(random, -apart, apart))));
  return motion;
}

/// Moves one row of a sheet, rotates it, or does both. In some cases the motion starts or ends within the time step.
CaseData handle(Random& random) {
  StepBuilder builder(random);
  const int nx = side(random), ny = side(random);
  builder.sheet(nx, ny, {}, scaled(direction(random), builder.speed(random.magnitude(-3, -1))));
  if (random.one_in(2)) builder.sheet(side(random), side(random), {0, 0, -random.between(0.3, 1)}, {}, true);
  builder.jitter(random.between(0.02, 0.09));
  const double h = builder.scene.settings.time_step;
  PrescribedMotion motion;
  motion.name = "row";
  for (Index v = 0; v < nx; ++v) motion.vertices.push_back(v);
  if (!random.one_in(4)) motion.velocity = scaled(direction(random), builder.speed(random.magnitude(-2, 1)));
  if (random.one_in(2)) motion.angular_velocity = random.sign() * random.magnitude(-1, 1) / h;
  motion.axis = direction(random);
  if (random.one_in(4)) motion.start = 0.5 * h;
  if (random.one_in(4)) motion.end = 0.75 * h;
  if (random.one_in(3)) motion = keyframed(random, builder, motion);
  builder.scene.motions.push_back(motion);
  return builder.finish();
}

/// Gives some vertices of a sheet at rest velocities that lead out of their bounds. The number of these vertices is the
/// re-detection count, one more or one less. γ_e K is one rung from a whole number.
CaseData count_at_threshold(Random& random) {
  StepBuilder builder(random);
  const int nx = side(random), ny = side(random), count = nx * ny;
  builder.sheet(nx, ny, {}, {});
  builder.scene.gravity = {};
  Settings& s = builder.scene.settings;
  s.detection_fraction = std::min(1.0, (1 + random.below(count / 2 + 1)) * (1 + 0.4 * random.rung()) / count);
  const int threshold = std::max(
      1, static_cast<int>(std::ceil(static_cast<float>(s.detection_fraction) * static_cast<double>(count))));
  s.guess_rounds = random.one_in(4) ? 1 : 2 + random.below(4);
  const int flung = std::clamp(threshold + (random.one_in(3) ? random.below(2) : -1), 0, count);
  for (int k = 0, first = random.below(count); k < flung; ++k)
    builder.scene.velocities[static_cast<std::size_t>((first + k) % count)] = {0, 0, random.sign() * builder.speed(20)};
  builder.jitter(random.one_in(2) ? 0 : 0.05);
  return builder.finish();
}

/// Puts r + ‖y − xᵗ‖ one rung from the cap of r_q.
CaseData radius_at_cap(Random& random) {
  StepBuilder builder(random);
  builder.sheet(side(random), side(random), {0, 0, random.between(0.3, 1)}, {});
  builder.sheet(side(random), side(random), {}, {});
  builder.jitter(random.one_in(2) ? 0 : 0.05);
  builder.scene.gravity = {};
  const Settings& s = builder.scene.settings;
  const double move = (s.detection_radius_cap - 1) * s.contact_radius * std::abs(1 + 0.5 * random.rung());
  const Vec3 to = random.one_in(2) ? Vec3{0, 0, -1} : direction(random);
  builder.scene.velocities.front() = scaled(to, move / s.time_step / std::hypot(to.x, to.y, to.z));
  return builder.finish();
}

/// Puts a sheet at rest on another one, vertex above vertex or shifted by half a cell. Their distance is one rung from
/// the contact radius.
CaseData at_rest(Random& random) {
  StepBuilder builder(random);
  const double shift = random.one_in(2) ? 0 : 0.5;
  builder.sheet(side(random), side(random), {shift, shift, random.between(0.1, 0.6)}, {});
  builder.sheet(side(random), side(random), {}, {}, random.one_in(2));
  const auto height = [&](std::size_t v) { return double{static_cast<float>(builder.scene.mesh.positions[v].z)}; };
  builder.scene.settings.contact_radius = (height(0) - height(builder.scene.mesh.positions.size() - 1)) *
                                          (1 + 0.5 * random.rung());
  if (random.one_in(3)) builder.jitter(0.05);
  return builder.finish();
}

/// Makes the smallest scenes: one triangle, two, or no free vertex. Coordinates and velocities lie on a lattice.
CaseData lattice(Random& random) {
  StepBuilder builder(random);
  builder.spacing = std::ldexp(1.0, random.below(5) - 9);
  builder.scene.settings.contact_radius = builder.spacing * (random.one_in(2) ? 0.5 : 0.25);
  const double s = builder.spacing;
  Mesh mesh{{{0, 0, 0}, {s, 0, 0}, {0, s, 0}, {s, s, random.one_in(2) ? 0 : s}}, {{0, 1, 2}, {1, 3, 2}}, {}};
  if (random.one_in(2)) mesh.positions.pop_back(), mesh.triangles.pop_back();
  const int kind = random.below(4);
  const Vec3 velocity = scaled(on_lattice(random, 1), builder.speed(0.5 * random.below(5)));
  builder.add(mesh, velocity, kind == 0);
  if (kind == 1 || kind == 2) {
    PrescribedMotion motion;
    motion.name = "held";
    for (Index v = 0; v < (kind == 1 ? static_cast<Index>(mesh.positions.size()) : 1); ++v)
      motion.vertices.push_back(v);
    motion.velocity = velocity;
    builder.scene.motions.push_back(motion);
  }
  if (random.one_in(2)) builder.sheet(2, 2, {-2, -2, random.one_in(2) ? -2.25 : -2.5}, {}, random.one_in(2));
  return builder.finish();
}

/// Makes strips of one to three triangles, alone or thrown at each other.
CaseData few(Random& random) {
  StepBuilder builder(random);
  const double speed = builder.speed(random.magnitude(-2, 0.7)), gap = random.between(0.2, 1.5);
  const int layers = 1 + random.below(2);
  for (int layer = 0; layer < layers; ++layer) {
    Mesh strip = triangle_strip(1 + random.below(3));
    for (Vec3& p : strip.positions) p = scaled(sum(p, {2, 2, 2 + layer * gap}), builder.spacing);
    builder.add(strip, {0, 0.3 * speed, layer == 0 ? speed : -speed}, layer > 0 && random.one_in(3));
  }
  builder.jitter(random.between(0.01, 0.09));
  return builder.finish();
}

/// Takes random bits for velocities and materials of strips, and random last bits for coordinates. Velocities and
/// materials span at least eight powers of two. Stiffnesses stay in proportion to inertia, so that answers can be
/// compared.
CaseData bits(Random& random) {
  StepBuilder builder(random);
  const auto single = [](double x) { return static_cast<float>(x); };
  const int layers = 1 + random.below(2);
  const double gap = 0.5 + 0.25 * random.below(5);
  for (int layer = 0; layer < layers; ++layer) {
    Mesh strip = triangle_strip(1 + random.below(3));
    for (Vec3& p : strip.positions) p = scaled(sum(p, {2, 2, 2 + layer * gap}), builder.spacing);
    builder.add(strip, {}, false);
    const double density = random.pattern(0x1p-6f, 2);
    Material& m = builder.scene.bodies.back().material;
    const double inertia = density * builder.spacing * builder.spacing / std::pow(builder.scene.settings.time_step, 2);
    m.density = density;
    m.lame_mu = random.pattern(single(inertia / 8), single(256 * inertia));
    m.lame_lambda = random.pattern(single(inertia / 8), single(256 * inertia));
    m.bending_stiffness = builder.spacing * builder.spacing * random.pattern(single(inertia / 1024), single(inertia));
    m.contact_stiffness = random.pattern(single(inertia / 8), single(512 * inertia));
    m.friction = random.pattern(0x1p-6f, 1);
  }
  const auto number = [&] {
    return random.sign() * random.pattern(single(builder.speed(0x1p-8)), single(builder.speed(4)));
  };
  for (Vec3& v : builder.scene.velocities) v = {number(), 0, 0}, v.y = number(), v.z = number();
  for (auto* points : {&builder.scene.mesh.positions, &builder.scene.rest_positions})
    for (Vec3& p : *points)
      for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) p.*axis = random.last_bits(single(p.*axis), 18);
  return builder.finish();
}

/// Throws a block of tetrahedra onto a sheet, or onto another block.
CaseData solid(Random& random) {
  StepBuilder builder(random);
  const double speed = builder.speed(random.magnitude(-2, 0.7)), gap = random.between(0.2, 1.5);
  const Vec3 askew{random.between(-0.5, 0.5), random.between(-0.5, 0.5), gap};
  builder.block(askew, {builder.speed(random.between(-0.3, 0.3)), 0, -speed}, false);
  if (random.one_in(3))
    builder.block({}, {0, 0, 0.5 * speed}, true);
  else
    builder.sheet(side(random), side(random), {}, {}, random.one_in(2));
  builder.jitter(random.between(0.01, 0.09));
  if (random.one_in(4)) builder.scene.settings.damping = another(random, DampingForm::strain);
  return builder.finish();
}

/// Puts a free volume over another one or over a sheet, or half into it. In some cases four vertices of the other body
/// are prescribed.
CaseData free_volume(Random& random) {
  StepBuilder builder(random);
  const double speed = builder.speed(random.magnitude(-2, 0.3)), gap = random.between(-0.6, 0.4);
  const Vec3 askew{random.between(-0.5, 0.5), random.between(-0.5, 0.5), gap};
  builder.block(askew, {builder.speed(random.between(-0.3, 0.3)), 0, -random.sign() * speed}, false,
                BodyContact::volume);
  const auto second = static_cast<Index>(builder.scene.mesh.positions.size());
  if (random.one_in(2))
    builder.block({}, {0, 0, 0.5 * speed}, true, BodyContact::volume);
  else
    builder.sheet(side(random), side(random), {}, {}, random.one_in(4));
  if (!builder.scene.bodies.back().fixed && random.one_in(3)) {
    PrescribedMotion motion;
    motion.name = "held";
    for (Index v = second; v < second + 4; ++v) motion.vertices.push_back(v);
    motion.velocity = scaled(in_box(random, -1, 1), builder.speed(random.magnitude(-2, 0)));
    builder.scene.motions.push_back(motion);
  }
  builder.jitter(random.between(0.01, 0.09));
  if (random.one_in(2)) builder.scene.settings.detection_every = 1 + random.below(2);
  if (random.one_in(4)) builder.scene.settings.detection_deep = 0;
  return builder.finish();
}

/// Puts one or two sheets over, in, or half in one or two volumes.
CaseData sheets_before_volumes(Random& random) {
  StepBuilder builder(random);
  const double speed = builder.speed(random.magnitude(-2, 0.3)), height = random.between(-0.5, 1.8);
  const Vec3 askew{random.between(-1, 1), random.between(-1, 1), height};
  builder.sheet(side(random), side(random), askew, {0.3 * speed, 0, -random.sign() * speed});
  if (random.one_in(3))
    builder.sheet(side(random), side(random), sum(askew, {0.2, 0.1, random.between(0.2, 0.8)}), {0, 0, -speed});
  builder.jitter(random.between(0.01, 0.09));
  builder.volume({});
  if (random.one_in(3)) builder.volume({random.between(0.3, 1.5), random.between(-0.5, 0.5), 0.1});
  Settings& settings = builder.scene.settings;
  if (random.one_in(2)) settings.detection_every = 1 + random.below(2);
  if (random.one_in(4)) settings.detection_deep = 0;
  return builder.finish();
}

/// Puts a sheet in the void of a volume, or half in its wall.
CaseData in_cavity(Random& random) {
  StepBuilder builder(random);
  builder.volume(jittered_hollow(random, builder.spacing, random.between(0.5, 1.5)), {});
  const std::vector<Vec3>& x = builder.scene.mesh.positions;
  const Vec3 middle = scaled(sum(x[x.size() - 1], x[x.size() - 8]), 0.5 / builder.spacing);
  const double speed = builder.speed(random.magnitude(-2, 0.3));
  builder.sheet(2, 2, sum(sum(middle, {-2.5, -2.5, -2}), in_box(random, -0.6, 0.6)), scaled(direction(random), speed));
  if (random.one_in(2)) builder.scene.settings.detection_every = 1 + random.below(2);
  return builder.finish();
}

/// Puts a vertex of a sheet at rest straight above the highest vertex of a volume, one rung from the contact radius.
CaseData volume_at_radius(Random& random) {
  StepBuilder builder(random);
  builder.volume({});
  builder.scene.motions.clear();
  builder.scene.bodies.back().fixed = true;
  const std::vector<Vec3>& x = builder.scene.mesh.positions;
  const auto highest = static_cast<std::size_t>(
      std::max_element(x.begin(), x.end(), [](const Vec3& a, const Vec3& b) { return a.z < b.z; }) - x.begin());
  const Vec3 above = sum(scaled(x[highest], 1 / builder.spacing), {-2, -2, random.between(0.1, 0.6) - 2});
  const std::size_t first = x.size();
  builder.sheet(side(random), side(random), above, {});
  const auto height = [&](std::size_t v) { return double{static_cast<float>(builder.scene.mesh.positions[v].z)}; };
  builder.scene.settings.contact_radius = (height(first) - height(highest)) * (1 + 0.5 * random.rung());
  return builder.finish();
}

template <class Change>
CaseData changed(const CaseData& data, const Change& change) {
  StepCase test = case_of<StepCase>(data);
  Scene scene = *test.scene;
  change(scene);
  test.scene = std::make_shared<Scene>(std::move(scene));
  return test;
}

/// Takes models other than the default ones.
CaseData models(Random& random) {
  const CaseData data = random.one_in(2) ? onto(random) : handle(random);
  return changed(data, [&](Scene& scene) { choose_models(random, scene); });
}

CaseData with_bounds(const CaseData& data, Bounds bounds) {
  return changed(data, [bounds](Scene& scene) { scene.settings.bounds = bounds; });
}
CaseData with_planes(const CaseData& data) { return with_bounds(data, Bounds::planes); }

/// Limits vertices by half-spaces instead of balls.
CaseData planes(Random& random) {
  constexpr std::array<CaseData (*)(Random&), 3> scenes{onto, collide, handle};
  return with_planes(random.pick(std::span<CaseData (*const)(Random&)>(scenes))(random));
}
CaseData planes_at_rest(Random& random) { return with_planes(at_rest(random)); }

/// Limits vertices by dat: half-spaces that divide each gap by the approach of both sides. Vertices stop at these
/// half-spaces and do not slide. In half of the cases a detection follows each iteration.
CaseData dat(Random& random) {
  constexpr std::array<CaseData (*)(Random&), 4> scenes{onto, collide, handle, at_rest};
  const CaseData data = random.pick(std::span<CaseData (*const)(Random&)>(scenes))(random);
  const bool detects_often = random.one_in(2);
  return changed(data, [detects_often](Scene& scene) {
    scene.settings.bounds = Bounds::dat;
    if (detects_often) scene.settings.detection_every = 1;
  });
}

/// Ends iterations early where they move nothing farther than `settled_move`, which is near the moves of the first
/// iterations. Often more vertices must be cut than are before a detection follows, so that some iterations go on only
/// because of cut vertices; or a detection is due where nothing moves.
CaseData settles(Random& random) {
  constexpr std::array<CaseData (*)(Random&), 4> scenes{onto, collide, handle, at_rest};
  const CaseData data = random.pick(std::span<CaseData (*const)(Random&)>(scenes))(random);
  return changed(data, [&](Scene& scene) {
    Settings& s = scene.settings;
    s.iterations = 2 + random.below(8);
    s.settled_move = static_cast<float>(s.contact_radius * random.magnitude(-3, 0.5));
    if (random.one_in(2)) s.detection_fraction = 1;
    s.detection_every = random.one_in(4) ? 1 + random.below(3) : 0;
  });
}
CaseData planes_settle(Random& random) { return with_planes(settles(random)); }

/// Drops rods alone, onto each other, or onto a sheet.
CaseData rods(Random& random) {
  StepBuilder builder(random);
  if (random.one_in(2)) builder.sheet(side(random), side(random), {}, {}, random.one_in(2));
  for (int k = 0, count = 1 + random.below(2); k < count; ++k)
    builder.rod({random.between(-1, 1), random.between(-1, 1), random.between(0.3, 1.2) * (k + 1)},
                scaled(direction(random), builder.speed(random.magnitude(-2, 0.3))));
  builder.jitter(random.between(0.01, 0.1));
  return builder.finish();
}

constexpr std::array<Generator, 22> table{{{"fall", 12, true, fall},
                                           {"onto", 13, true, onto},
                                           {"collide", 13, true, collide},
                                           {"handle", 12, true, handle},
                                           {"few", 5, true, few},
                                           {"ladder.count", 46, false, count_at_threshold},
                                           {"ladder.cap", 10, false, radius_at_cap},
                                           {"ladder.rest", 28, false, at_rest},
                                           {"bits", 6, false, bits},
                                           {"lattice", 10, false, lattice},
                                           {"solid", 8, false, solid, 0, Stage::tetrahedron},
                                           {"models", 5, false, models},
                                           {"planes", 10, false, planes, 0, Stage::plane},
                                           {"ladder.planes", 26, false, planes_at_rest, 0, Stage::plane},
                                           {"dat", 12, false, dat, 0, Stage::plane},
                                           {"settled", 6, false, settles},
                                           {"settled.planes", 3, false, planes_settle, 0, Stage::plane},
                                           {"volume", 8, false, sheets_before_volumes, 0, Stage::volume_depth},
                                           {"cavity", 3, false, in_cavity, 0, Stage::volume_depth, true},
                                           {"ladder.volume", 11, false, volume_at_radius, 0, Stage::volume_depth},
                                           {"free_volume", 3, false, free_volume, 0, Stage::volume_depth},
                                           {"rods", 12, false, rods, 0, Stage::orientation}}};

}  // namespace

std::span<const Generator> step_generators() { return table; }

}  // namespace ogc::compare
