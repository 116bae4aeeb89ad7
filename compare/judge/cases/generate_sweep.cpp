// Makes cases of the sweep: one or two small cloths, deformed and on their way from xᵗ to y; some have a fixed body or
// prescribed rows. Ladders approach states at which a part of the update changes: rest, collapse, the contact radius,
// stiff contacts, the slip limit, edges that cross at a small angle, the bound.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "compare/judge/cases/any_models.hpp"
#include "compare/judge/cases/colours.hpp"
#include "compare/judge/cases/generators.hpp"
#include "compare/judge/cases/mesh_builder.hpp"
#include "compare/judge/cases/placement.hpp"
#include "compare/judge/cases/solid_block.hpp"

namespace ogc::compare {

namespace {

using namespace placement;

/// A scene in units of one edge length, with its vertices at X_prev in `shape`.
struct Cloth {
  Scene scene;
  std::vector<Vec3> shape;
  double contact_radius = 0.5;  ///< r in edge lengths
};

/// Parameters of `finish`, in units of r.
struct Motion {
  double jitter = 0;              ///< largest shift of X_prev
  Vec3 slip;                      ///< displacement of the last body since xᵗ, in addition to `wander`
  double wander = 0, step = 0.3;  ///< largest distance of xᵗ from X_prev; largest distance of x and y from X_prev
  double bound = 0;       ///< above 0: bounds follow from y and bound_rung; 0: random bounds, or the largest legal ones
  double bound_rung = 0;  ///< if `bound` > 0: y lies at 1 + bound_rung times the bound
  bool exact = false;     ///< true: only scales and symmetries that keep every bit
};

Material material(Random& random) {
  Material m;
  m.membrane = MembraneModel::st_venant_kirchhoff;  // choose_models sets other models
  m.density = random.magnitude(-1, 0);
  m.lame_mu = random.magnitude(0, 2);
  m.lame_lambda = random.one_in(4) ? 0 : random.magnitude(0, 2);
  m.bending_stiffness = random.magnitude(-7, -4);
  m.membrane_damping = random.one_in(2) ? 0 : random.magnitude(-4, -2);
  m.bending_damping = random.one_in(2) ? 0 : random.magnitude(-4, -2);
  m.contact_stiffness = random.magnitude(1, 3);
  m.friction = random.one_in(3) ? 0 : random.between(0.05, 1);
  return m;
}

/// Adds a mesh at rest; `map` gives its positions at X_prev. Returns the index of its first vertex.
template <class Map>
Index add_body(Cloth& cloth, const Body& body, const Mesh& mesh, Map map) {
  Body named = body;
  named.name += std::to_string(cloth.scene.bodies.size());
  const std::size_t number = append_body(cloth.scene, named, mesh);
  for (const Vec3& p : mesh.positions) cloth.shape.push_back(map(p));
  return cloth.scene.bodies[number].first_vertex;
}

/// Adds a flat sheet of nx × ny cells at rest; `map` gives its positions at X_prev.
template <class Map>
Index add_sheet(Cloth& cloth, const Body& body, int nx, int ny, Map map) {
  Mesh mesh;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) mesh.positions.push_back({static_cast<double>(i), static_cast<double>(j), 0});
  const auto at = [&](int i, int j) { return static_cast<Index>(i + j * (nx + 1)); };
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return add_body(cloth, body, mesh, map);
}

Body body(Random& random, bool fixed = false) {
  Body b;
  b.name = fixed ? "body" : "cloth";
  b.fixed = fixed;
  b.material = material(random);
  return b;
}

void settings(Random& random, Settings& s) {
  constexpr std::array<std::int64_t, 5> lanes{2, 4, 8, 16, 0};
  s.time_step = random.magnitude(-3, -1.5);
  s.lanes = random.pick(std::span<const std::int64_t>(lanes));
  s.friction_velocity = random.magnitude(-3, -1);
  s.bounds_relaxation = random.one_in(4) ? random.between(0.1, 0.49) : 0.45;
}

/// Sets positions and bounds by the plan; fixed vertices stay, all others move at random.
void move(Random& random, const Cloth& cloth, const Motion& plan, double scale, SweepCase& test) {
  const double r = cloth.contact_radius * scale;
  const std::vector<Index> groups = rigid_groups(*test.scene);
  const auto shifted = [&](const Vec3f& p, const Vec3& step) { return single(sum({p.x, p.y, p.z}, scaled(step, r))); };
  const bool some_bound = plan.bound == 0 && random.one_in(3);
  const std::size_t last = cloth.scene.bodies.size() - 1;
  for (std::size_t v = 0; v < cloth.shape.size(); ++v) {
    const Vec3f p = single(scaled(cloth.shape[v], scale));
    const bool slips = static_cast<Index>(v) >= cloth.scene.bodies[last].first_vertex;
    const Vec3 back = sum(scaled(in_box(random, -1, 1), plan.wander), slips ? scaled(plan.slip, -1) : Vec3{});
    const Vec3 now = scaled(in_box(random, -1, 1), random.one_in(4) ? 0 : plan.step),
               ahead = scaled(in_box(random, -1, 1), plan.step);
    const bool moves = groups[v] != 0;
    test.previous.push_back(p);
    test.start.push_back(moves ? shifted(p, back) : p);
    test.old.push_back(moves && plan.bound == 0 ? shifted(p, now) : p);
    test.target.push_back(moves ? shifted(p, ahead) : p);
    float bound = some_bound ? static_cast<float>(r * random.magnitude(-3, 0)) : std::numeric_limits<float>::max();
    if (plan.bound > 0) {
      const Vec3f& y = test.target.back();
      bound = static_cast<float>(std::hypot(double{y.x} - p.x, double{y.y} - p.y, double{y.z} - p.z) /
                                 (1 + plan.bound_rung));
    }
    test.largest_bound.push_back(some_bound && random.one_in(8) ? 0 : bound);
  }
}

CaseData finish(Random& random, Cloth cloth, const Motion& plan) {
  for (Vec3& p : cloth.shape) p = sum(p, scaled(in_box(random, -1, 1), plan.jitter * cloth.contact_radius));
  permute(random, cloth.shape);
  if (!plan.exact) rotate(random, cloth.shape);
  const double scale = plan.exact ? std::ldexp(1.0, -random.below(9)) : random.magnitude(-2.3, 0);
  for (auto* points : {&cloth.scene.mesh.positions, &cloth.scene.rest_positions})
    for (Vec3& p : *points) p = scaled(p, scale);
  cloth.scene.name = "sweep";
  settings(random, cloth.scene.settings);
  cloth.scene.settings.contact_radius = cloth.contact_radius * scale;
  round_to_single(cloth.scene);
  SweepCase test;
  test.scene = std::make_shared<Scene>(cloth.scene);
  test.colour = random_colours(random, *test.scene, build_topology(*test.scene));
  test.query_radius = static_cast<float>(cloth.scene.settings.contact_radius *
                                         (random.one_in(4) ? 1 : random.between(1, 4)));
  move(random, cloth, plan, scale, test);
  return test;
}

double wave(const Vec3& p, double height) { return height * std::sin(1.3 * p.x) * std::cos(0.7 * p.y); }

int cells(Random& random) { return random.one_in(6) ? 5 + random.below(4) : 1 + random.below(4); }

/// Returns two wavy sheets, one above the other. Waves and jitter are smaller than the gap, so the sheets do not touch.
Cloth two_sheets(Random& random, bool fixed_below) {
  Cloth cloth;
  cloth.contact_radius = random.between(0.2, 0.9);
  const double gap = cloth.contact_radius * random.between(0.5, 1.2),
               height = cloth.contact_radius * random.between(0, 0.4);
  const double dx = random.between(-0.5, 0.5), dy = random.between(-0.5, 0.5);
  add_sheet(cloth, body(random, fixed_below), cells(random), cells(random), [=](const Vec3& p) {
    return Vec3{p.x, p.y, wave(p, height)};
  });
  add_sheet(cloth, body(random), cells(random), cells(random), [=](const Vec3& p) {
    const Vec3 q{p.x + dx, p.y + dy, 0};
    return Vec3{q.x, q.y, wave(q, height) + gap};
  });
  return cloth;
}

Motion generic(Random& random) {
  Motion motion;
  motion.jitter = random.between(0.02, 0.1);
  motion.wander = random.magnitude(-2, 0);
  motion.step = random.magnitude(-2, 0);
  return motion;
}

CaseData sheets(Random& random) {
  Cloth cloth = two_sheets(random, false);
  return finish(random, std::move(cloth), generic(random));
}

CaseData over_body(Random& random) {
  Cloth cloth = two_sheets(random, true);
  return finish(random, std::move(cloth), generic(random));
}

/// Folds a strip onto itself.
CaseData fold(Random& random) {
  Cloth cloth;
  cloth.contact_radius = random.between(0.2, 0.7);
  const int half = 2 + random.below(4);
  const double gap = cloth.contact_radius * random.between(0.5, 1.2);
  add_sheet(cloth, body(random), 2 * half, cells(random), [=](const Vec3& p) {
    const double beyond = p.x - half;
    return beyond <= 0 ? Vec3{p.x, p.y, 0} : Vec3{half - beyond + 0.3, p.y, gap};
  });
  return finish(random, std::move(cloth), generic(random));
}

/// Moves rows of a sheet as rigid groups.
CaseData prescribed(Random& random) {
  Cloth cloth = two_sheets(random, random.one_in(2));
  const Body& last = cloth.scene.bodies.back();
  PrescribedMotion motion;
  motion.name = "held";
  const int count = 1 + random.below(static_cast<int>(last.vertex_count) - 1);
  for (Index v = 0; v < count; ++v) motion.vertices.push_back(last.first_vertex + v);
  cloth.scene.motions.push_back(motion);
  return finish(random, std::move(cloth), generic(random));
}

/// Makes a sheet without contacts.
CaseData alone(Random& random) {
  Cloth cloth;
  cloth.contact_radius = random.between(0.01, 0.1);
  const double height = random.between(0, 0.4);
  add_sheet(cloth, body(random), cells(random), cells(random), [=](const Vec3& p) {
    return Vec3{p.x, p.y, wave(p, height)};
  });
  return finish(random, std::move(cloth), generic(random));
}

/// Returns two flat parallel sheets at a distance of `gap` r, vertex above vertex or shifted by quarters of a cell. The
/// upper one is rotated by `turn`. Without rotation closest points tie.
Cloth flat_sheets(Random& random, double gap, double turn = 0) {
  Cloth cloth;
  cloth.contact_radius = 0.5;
  const double dx = 0.25 * random.below(4), dy = 0.25 * random.below(4), c = std::cos(turn), s = std::sin(turn);
  add_sheet(cloth, body(random, random.one_in(3)), 1 + random.below(3), 1 + random.below(3),
            [](const Vec3& p) { return p; });
  add_sheet(cloth, body(random), 1 + random.below(3), 1 + random.below(3), [=](const Vec3& p) {
    return Vec3{c * p.x - s * p.y + dx, s * p.x + c * p.y + dy, gap * 0.5};
  });
  return cloth;
}

/// Makes the smallest scenes: strips of one to three triangles, alone or one above the other.
CaseData few(Random& random) {
  Cloth cloth;
  cloth.contact_radius = random.between(0.2, 0.9);
  const double gap = cloth.contact_radius * random.between(0.5, 1.2);
  const int layers = 1 + random.below(2);
  for (int layer = 0; layer < layers; ++layer)
    add_body(cloth, body(random), triangle_strip(1 + random.below(3)), [=](const Vec3& p) {
      return sum(p, {0, 0, layer * gap});
    });
  return finish(random, std::move(cloth), generic(random));
}

CaseData lattice(Random& random) {
  Cloth cloth = flat_sheets(random, 0.25 * (1 + random.below(4)));
  Motion motion;
  motion.exact = true;
  motion.step = random.one_in(2) ? 0 : 0.2;
  return finish(random, std::move(cloth), motion);
}

/// Makes sheets at rest and almost at rest.
CaseData at_rest(Random& random) {
  Cloth cloth;
  cloth.contact_radius = 0.125;
  add_sheet(cloth, body(random), cells(random), cells(random), [](const Vec3& p) { return p; });
  Motion motion;
  motion.exact = true;
  motion.jitter = motion.wander = std::abs(random.rung());
  motion.step = random.one_in(2) ? 0 : std::abs(random.rung());
  return finish(random, std::move(cloth), motion);
}

/// Approaches d = r.
CaseData at_radius(Random& random) {
  Cloth cloth = flat_sheets(random, 1 + random.rung());
  Motion motion;
  motion.step = random.one_in(2) ? 0 : std::abs(random.rung());
  return finish(random, std::move(cloth), motion);
}

/// Makes distances that are small relative to r, and contact stiffnesses of up to 10⁶ N/m.
CaseData stiff(Random& random) {
  Cloth cloth = flat_sheets(random, random.magnitude(-3, -0.3));
  for (Body& b : cloth.scene.bodies) b.material.contact_stiffness = random.magnitude(2, 6);
  Motion motion = generic(random);
  motion.jitter = 0.01;
  return finish(random, std::move(cloth), motion);
}

/// Approaches ‖u‖ = ε_v h and ‖u‖ = 0.
CaseData slip(Random& random) {
  Cloth cloth = flat_sheets(random, random.between(0.2, 0.8));
  for (Body& b : cloth.scene.bodies) b.material.friction = random.between(0.1, 1);
  Motion motion;
  const double factor = random.one_in(2) ? 1 + random.rung() : random.rung();
  motion.slip = {factor * 1e-3, 0, 0};
  motion.step = random.one_in(2) ? 0 : 1e-3;
  return finish(random, std::move(cloth), motion);
}

/// Makes edges that cross at a small angle.
CaseData crossing(Random& random) {
  Cloth cloth = flat_sheets(random, random.between(0.2, 0.9),
                            0.03 * random.rung() + (random.one_in(2) ? 0.0316 * random.between(0.5, 1.5) : 0));
  Motion motion;
  motion.step = random.one_in(2) ? 0 : std::abs(random.rung());
  return finish(random, std::move(cloth), motion);
}

/// Puts loose edges above each other, each between the corners of two triangles, shifted along each other and tilted by
/// a rung.
CaseData strands(Random& random) {
  Cloth cloth;
  const double gap = cloth.contact_radius * random.between(0.3, 0.9);
  for (int k = 0, count = 2 + random.below(2); k < count; ++k) {
    const double length = random.between(0.5, 2), end = 1 + length;
    const Mesh mesh{{{0, 0.5, 0}, {0, -0.5, 0}, {1, 0, 0}, {end, 0, 0}, {end + 1, -0.5, 0}, {end + 1, 0.5, 0}},
                    {{0, 1, 2}, {3, 4, 5}},
                    {{2, 3}}};
    const double shift = random.between(-0.5, 0.5), tilt = random.one_in(2) ? 0 : 0.01 * random.rung();
    add_body(cloth, body(random), mesh, [=](const Vec3& p) { return Vec3{p.x + shift, p.y + tilt * p.x, k * gap}; });
  }
  Motion motion;
  motion.exact = random.one_in(2);
  motion.step = random.one_in(2) ? 0 : std::abs(random.rung());
  return finish(random, std::move(cloth), motion);
}

/// Makes one or several triangles with no or almost no area.
CaseData collapse(Random& random) {
  Cloth cloth;
  cloth.contact_radius = 0.125;
  const int nx = 2 + random.below(3), ny = 2 + random.below(3);
  add_sheet(cloth, body(random), nx, ny, [](const Vec3& p) { return p; });
  for (int k = 0; k < 1 + random.below(3); ++k) {
    const auto v = static_cast<std::size_t>(random.below(static_cast<int>(cloth.shape.size()) - 1));
    const double near = random.one_in(2) ? 0 : std::pow(10.0, -1 - random.below(4));
    cloth.shape[v] = random.one_in(2) ? sum(cloth.shape[v + 1], {-near, 0, 0}) : sum(cloth.shape[v], {0, 1 - near, 0});
  }
  Motion motion;
  motion.exact = true;
  motion.step = random.one_in(2) ? 0 : 0.3;
  return finish(random, std::move(cloth), motion);
}

/// Approaches ‖x − X_prev‖ = b_v. The sheet has no energies, so each vertex moves to y if its bound allows.
CaseData at_bound(Random& random) {
  Cloth cloth;
  cloth.contact_radius = 0.25;
  Body b = body(random);
  b.material.membrane = MembraneModel::none;
  b.material.bending = BendingModel::none;
  add_sheet(cloth, b, cells(random), cells(random), [](const Vec3& p) { return p; });
  Motion motion;
  motion.exact = random.one_in(2);
  motion.step = random.magnitude(-4, -1);
  motion.bound = 1;
  motion.bound_rung = random.rung();
  return finish(random, std::move(cloth), motion);
}

/// Takes random bits for materials and time step, over twelve powers of two, so that answers can be compared.
/// Coordinates and bounds get only random last bits, so that stencils keep their shapes and contacts remain.
CaseData bits(Random& random) {
  constexpr int last = 17;
  SweepCase test = case_of<SweepCase>(few(random));
  Scene scene = *test.scene;
  for (Body& b : scene.bodies)
    for (double Material::*number : {&Material::density, &Material::lame_mu, &Material::lame_lambda,
                                     &Material::bending_stiffness, &Material::contact_stiffness})
      b.material.*number = random.last_bits(static_cast<float>(b.material.*number), 23) *
                           random.pattern(0x1p-6f, 0x1p6f);
  scene.settings.time_step = random.pattern(0x1p-12f, 0x1p-4f);
  scene.settings.friction_velocity = random.pattern(0x1p-12f, 1);
  const auto replaced = [&](float x) { return x == 0 ? x : random.last_bits(x, last); };
  const auto replace = [&](Vec3f p) -> Vec3f {
    const float x = replaced(p.x), y = replaced(p.y);
    return {x, y, replaced(p.z)};
  };
  for (auto* points : {&test.previous, &test.start, &test.old, &test.target})
    for (Vec3f& p : *points) p = replace(p);
  for (std::size_t v = 0; v < scene.rest_positions.size(); ++v)
    scene.rest_positions[v] = to_double({replace(to_single({scene.rest_positions[v]})[0])})[0];
  for (float& bound : test.largest_bound) bound = bound < 1 ? replaced(bound) : bound;
  round_to_single(scene);
  test.scene = std::make_shared<Scene>(std::move(scene));
  return test;
}

/// Puts a block of tetrahedra over a sheet: near rest, sheared or inside out, in half of the cases with damping.
CaseData solid(Random& random) {
  SweepCase test = case_of<SweepCase>(sheets(random));
  Scene scene = *test.scene;
  Body body;
  body.name = "solid";
  body.material.solid_density = random.magnitude(2, 4);
  body.material.solid_mu = random.magnitude(3, 6);
  body.material.solid_lambda = random.magnitude(3, 6);
  if (random.one_in(2)) body.material.solid_damping = random.magnitude(-5, -2);
  body.material.contact_stiffness = scene.bodies.front().material.contact_stiffness;
  const double size = 0.02, moved = size * (random.one_in(3) ? random.magnitude(-5, -2) : random.between(0.1, 1));
  const Mesh block = jittered_block(random, size, 1);
  append_body(scene, body, block);
  if (random.one_in(4)) scene.settings.damping = another(random, DampingForm::strain);
  round_to_single(scene);
  const std::size_t first = scene.mesh.positions.size() - block.positions.size();
  for (std::size_t v = first; v < scene.mesh.positions.size(); ++v) {
    const Vec3 x = placement::sum(scene.mesh.positions[v], placement::scaled(in_box(random, -1, 1), moved));
    const auto near = [&](double by) {
      return placement::single(placement::sum(x, placement::scaled(in_box(random, -1, 1), by * size)));
    };
    test.previous.push_back(near(0));
    test.start.push_back(near(1e-3));
    test.old.push_back(near(1e-3));
    test.target.push_back(near(1e-2));
    test.largest_bound.push_back(1);
  }
  test.colour = random_colours(random, scene, build_topology(scene));
  test.scene = std::make_shared<Scene>(std::move(scene));
  return test;
}

/// Returns X_prev of a random vertex of the sheets; a volume is put beside it.
Vec3 some_vertex(Random& random, const SweepCase& test) {
  const Vec3f& x = test.previous[static_cast<std::size_t>(random.below(static_cast<int>(test.previous.size()) - 1))];
  return {x.x, x.y, x.z};
}

/// Adds a fixed or driven volume to the sheets; `mesh` has its positions at X_prev.
CaseData with_volume(Random& random, SweepCase test, const Mesh& mesh) {
  Scene scene = *test.scene;
  Body body;
  body.name = "volume";
  body.fixed = random.one_in(3);
  body.contact = BodyContact::volume;
  body.material.contact_stiffness = scene.bodies.front().material.contact_stiffness * random.magnitude(-1, 1);
  body.material.friction = random.one_in(3) ? 0 : random.between(0.05, 1);
  const std::size_t first = scene.mesh.positions.size();
  append_body(scene, body, mesh);
  const double moved = scene.settings.contact_radius * random.magnitude(-3, 0);
  const Vec3 back = placement::scaled(in_box(random, -1, 1), body.fixed ? 0 : moved);
  PrescribedMotion motion;
  motion.name = "driven";
  round_to_single(scene);
  for (std::size_t v = first; v < scene.mesh.positions.size(); ++v) {
    const Vec3f x = placement::single(scene.mesh.positions[v]);
    motion.vertices.push_back(static_cast<Index>(v));
    for (auto* positions : {&test.previous, &test.old, &test.target}) positions->push_back(x);
    test.start.push_back(body.fixed ? x : placement::single(placement::sum(scene.mesh.positions[v], back)));
    test.largest_bound.push_back(std::numeric_limits<float>::max());
  }
  if (!body.fixed) scene.motions.push_back(motion);
  test.colour = random_colours(random, scene, build_topology(scene));
  test.scene = std::make_shared<Scene>(std::move(scene));
  return test;
}

/// Puts a volume near a vertex of the sheets; the vertex may be inside.
CaseData volume(Random& random) {
  SweepCase test = case_of<SweepCase>(sheets(random));
  const double size = test.scene->settings.contact_radius * random.magnitude(0, 1);
  Mesh mesh = jittered_surface(random, size, 1);
  const Vec3 shift = placement::sum(some_vertex(random, test), placement::scaled(in_box(random, -2, 0.5), size));
  for (Vec3& x : mesh.positions) x = placement::sum(x, shift);
  return with_volume(random, std::move(test), mesh);
}

/// Puts the upper corner of a volume near a vertex of the sheets, at a distance one rung from r.
CaseData volume_at_radius(Random& random) {
  SweepCase test = case_of<SweepCase>(sheets(random));
  const double r = test.scene->settings.contact_radius, away = r * (1 + 0.5 * random.rung()) / std::sqrt(3);
  Mesh mesh = jittered_surface(random, r * random.magnitude(0, 1), 1);
  const auto height = [](const Vec3& x) { return x.x + x.y + x.z; };
  const Vec3 corner = *std::max_element(mesh.positions.begin(), mesh.positions.end(),
                                        [&](const Vec3& a, const Vec3& b) { return height(a) < height(b); });
  const Vec3 shift = placement::sum(placement::sum(some_vertex(random, test), placement::scaled(corner, -1)),
                                    {-away, -away, -away});
  for (Vec3& x : mesh.positions) x = placement::sum(x, shift);
  return with_volume(random, std::move(test), mesh);
}

/// Puts one or two free volumes about a vertex of the sheets. The volumes are blocks of tetrahedra and may overlap.
/// Their ratio of stiffness to inertia is that of the sheets.
CaseData free_volume(Random& random) {
  SweepCase test = case_of<SweepCase>(sheets(random));
  Scene scene = *test.scene;
  const double r = scene.settings.contact_radius, size = r * random.magnitude(0, 1);
  const Vec3 place = some_vertex(random, test);
  for (int k = 0, count = 1 + random.below(2); k < count; ++k) {
    Body body;
    body.name = "volume" + std::to_string(k);
    body.contact = BodyContact::volume;
    body.material.solid_density = random.magnitude(2, 4);
    const double inertia = body.material.solid_density * size * size / std::pow(scene.settings.time_step, 2);
    body.material.solid_mu = inertia * random.magnitude(-1, 2);
    body.material.solid_lambda = inertia * random.magnitude(-1, 2);
    body.material.contact_stiffness = scene.bodies.front().material.contact_stiffness * random.magnitude(-1, 1);
    body.material.friction = random.one_in(3) ? 0 : random.between(0.05, 1);
    Mesh mesh = jittered_block(random, size, 1);
    const Vec3 shift = placement::sum(place, placement::scaled(in_box(random, -1.5, 0.5), size));
    for (Vec3& x : mesh.positions) x = placement::sum(x, shift);
    append_body(scene, body, mesh);
  }
  round_to_single(scene);
  for (std::size_t v = test.previous.size(); v < scene.mesh.positions.size(); ++v) {
    const auto near = [&](double by) {
      return placement::single(
          placement::sum(scene.mesh.positions[v], placement::scaled(in_box(random, -1, 1), by * r)));
    };
    test.previous.push_back(near(0));
    test.start.push_back(near(0.1));
    test.old.push_back(near(0.1));
    test.target.push_back(near(0.3));
    test.largest_bound.push_back(std::numeric_limits<float>::max());
  }
  test.colour = random_colours(random, scene, build_topology(scene));
  test.scene = std::make_shared<Scene>(std::move(scene));
  return test;
}

/// Takes models other than the default ones. Chooses new colours, because the models may add springs.
template <CaseData (*make)(Random&)>
CaseData with_models(Random& random) {
  SweepCase test = case_of<SweepCase>(make(random));
  Scene scene = *test.scene;
  choose_models(random, scene);
  test.colour = random_colours(random, scene, build_topology(scene));
  test.scene = std::make_shared<Scene>(std::move(scene));
  return test;
}

/// Makes rods, alone or beside sheets with or without prescribed rows.
CaseData rods(Random& random) {
  if (random.one_in(2)) return rods_alone(random);
  return with_rod(random, case_of<SweepCase>(random.one_in(3) ? prescribed(random) : sheets(random)));
}

/// Adds a rod to sheets that are at rest or collapsed.
CaseData rods_at_rest(Random& random) {
  return with_rod(random, case_of<SweepCase>(random.one_in(2) ? at_rest(random) : collapse(random)));
}

constexpr std::array<Generator, 27> table{{{"sheets", 16, true, sheets},
                                           {"fold", 10, true, fold},
                                           {"body", 10, true, over_body},
                                           {"prescribed", 8, true, prescribed},
                                           {"alone", 5, true, alone},
                                           {"few", 3, false, few},
                                           {"bits", 6, false, bits},
                                           {"dust", 6, false, sheets},
                                           {"lattice", 10, false, lattice},
                                           {"ladder.rest", 14, false, at_rest},
                                           {"ladder.radius", 9, false, at_radius},
                                           {"ladder.stiff", 8, false, stiff},
                                           {"ladder.slip", 6, false, slip},
                                           {"ladder.crossing", 6, false, crossing},
                                           {"ladder.strands", 4, false, strands},
                                           {"ladder.collapse", 5, false, collapse},
                                           {"ladder.bound", 6, false, at_bound},
                                           {"solid", 4, false, solid, 0, Stage::tetrahedron},
                                           {"volume", 4, false, volume, 0, Stage::volume_depth},
                                           {"ladder.volume", 4, false, volume_at_radius, 0, Stage::volume_depth},
                                           {"free_volume", 5, false, free_volume, 0, Stage::volume_depth},
                                           {"models", 8, false, with_models<sheets>},
                                           {"models.prescribed", 4, false, with_models<prescribed>},
                                           {"ladder.models_rest", 6, false, with_models<at_rest>},
                                           {"ladder.models_collapse", 6, false, with_models<collapse>},
                                           {"rods", 10, false, rods, 0, Stage::orientation},
                                           {"ladder.rods", 27, false, rods_at_rest, 0, Stage::orientation}}};

}  // namespace

std::span<const Generator> sweep_generators() { return table; }

}  // namespace ogc::compare
