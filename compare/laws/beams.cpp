// Tests clamped beams, a pendulum, and the energy of a swinging sheet.
//
// Hinge. Two triangles share an edge of length e. One is held level. The other rotates about the edge under the weight
// m g of its free corner, which is at the distance b from the edge and has a third of the triangle's mass. The edge is
// a torsion spring,
//
//     c θ = m g b cos θ,   c = 3 k_b e²/(A₀ + A₁),                                                            (1)
//
// at any angle. The law neglects the stretch of the membranes, of relative size m g/(E e/2).
//
// Tetrahedron. Three corners are held, and the fourth hangs from them. J is affine in one corner and ‖F‖² is quadratic,
// so the force on the corner is linear (method.md §8.1). The corner sinks by exactly
//
//     H⁻¹ m g,   H = μ V ‖∇N‖² I + (λ + μ) V ∇N ∇Nᵀ,                                                         (2)
//
// where ∇N is the gradient of the free corner's shape function. −Σ w_k of method.md §8.1 is V ‖∇N‖² here, since the
// gradients of all four corners add up to 0.
//
// Bar. With λ = 0 tetrahedra have E = 2 μ and G = μ. The mean deflection of a clamped bar of side t under its weight is
// (Euler and Bernoulli, and shear with 5/6 of the area)
//
//     w = q L⁴/(20 E I) + q L²/(3 (5/6) G A) = ρ g L⁴ 12/(20 E t²) + ρ g L²/(2.5 G).                          (3)
//
// The deflection minimises energy minus work, and linear tetrahedra allow only some of all displacements. So their mean
// deflection is less than w. It grows if the cells are halved, since small cells allow all displacements of large ones.
//
// Pendulum. A triangle that hangs from a corner moves as a rigid body, except for a small strain. Implicit Euler takes
// the rotation nearest, in the norm of masses, to y = 2 x_n − x_{n−1} + h² g. In the plane, with x = r e^{iθ},
//
//     θ_{n+1} = arg(I (2 e^{iθ_n} − e^{iθ_{n−1}}) + h² γ Σ m r̄),   γ = −i g,                                   (4)
//
// for any swing. The strain ε that the weight causes makes the pendulum longer, so its phase ω t lags by a share of
// ε/2.
//
// Energy. Let f be the remaining force of a step, including inertia. Let Δ = x' − x, and let E be the sum of kinetic
// energy, elastic energy U and gravity's energy (method.md §7.8):
//
//     E' − E = −f·Δ − ‖v' − v‖²_M/2 − c,   c = U(x) − U(x') + ∇U(x')·Δ,   −f·Δ = (M (v' − v)/h − M a + ∇U(x'))·Δ. (5)
//
// c ≥ 0 where U is convex. Rotating hinges and shrinking triangles make U non-convex, so c may be negative. The law
// claims that E rises by at most (5) without c. It computes this limit from the states, so a wrong U, or a wrong energy
// in the metrics of a step, breaks the law.
//
// A solved step has f = 0, and its energy does not rise. With few sweeps a force f remains, and the energy may rise up
// to the limit. Newton's method needs no limit. Neither do N = D ln(101)/2 sweeps, where D = 1 + h² q, and q is a third
// of the trace of a vertex's stiffness over its mass. They leave a hundredth of a stretch (method.md §7.7), so f is a
// hundredth of the elastic force. The work of f during the motion is then below a hundredth of U, and U stays below the
// largest kinetic energy. The trace of a vertex's stiffness is a sum, on a lattice of spacing a:
//
// - the membrane: A (λ + 3μ) ‖∇N‖² for each corner, together 4 (λ + 3μ)
// - hinges: c ‖∇θ‖² for each corner, c from (1): up to 18 k_b/a² for each of two cell sides, 48 k_b/a² for a diagonal
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "compare/laws/elastic.hpp"
#include "compare/laws/groups.hpp"
#include "compare/laws/measures.hpp"
#include "compare/laws/shapes.hpp"

namespace ogc::compare {
namespace {

using namespace law_measures;
using namespace law_shapes;

constexpr double flap_side = 0.1, flap_bending = 2e-3;

/// Returns θ of (1), by fixed-point iteration.
double hinge_angle(const Scene& scene) {
  // e²/(A₀ + A₁) in (1) is 1, since both triangles are as high as they are long.
  const double load = masses(scene)[3] * standard_gravity * flap_side / (3 * flap_bending);
  double angle = 0;
  for (int round = 0; round < 200; ++round) angle = load * std::cos(angle);
  return angle;
}

/// Returns two right triangles with a common edge along z: the first is level and held, the second is at the angle of
/// (1).
std::vector<Scene> hinge_scenes(LawSize) {
  Scene scene = empty_scene("cantilever_hinge", 0.005, 200, 40);
  scene.gravity = down;
  Material material = cloth(0);
  material.density = 0.3;
  material.bending = BendingModel::discrete_hinge;
  material.bending_stiffness = flap_bending;
  append_body(scene, {.name = "flap", .material = material},
              {.positions = {{0, 0, 0}, {0, 0, flap_side}, {-flap_side, 0, 0}, {flap_side, 0, 0}},
               .triangles = {{0, 2, 1}, {0, 1, 3}},
               .loose_edges = {}});
  const double angle = hinge_angle(scene);
  scene.mesh.positions[3] = {flap_side * std::cos(angle), -flap_side * std::sin(angle), 0};
  pin(scene, {0, 1, 2});
  round_to_single(scene);
  return {scene};
}

std::vector<Reading> read_hinge(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const double law = hinge_angle(run.scene), weight = masses(run.scene)[3] * standard_gravity;
  const Vec3& end = run.states.back().positions[3];
  const double young = 8. / 3 * run.scene.bodies[0].material.lame_mu, drawn = weight / (young * flap_side / 2);
  return {{.what = "angle",
           .unit = "1",
           .measured = std::atan2(-end.y, end.x),
           .answer = law,
           .tolerance = force_left(run) * law + drawn}};
}

constexpr double tetrahedron_side = 0.1, tetrahedron_mu = 2e4, tetrahedron_lambda = 3e4;

/// Returns a tetrahedron with three corners held in the plane x = 0. The fourth corner is free.
std::vector<Scene> tetrahedron_scenes(LawSize) {
  Scene scene = empty_scene("cantilever_tetrahedron", 0.005, 100, 40);
  scene.gravity = {1, -standard_gravity, 2};
  Material material = cloth(0);
  material.solid_density = 1000;
  material.solid_mu = tetrahedron_mu;
  material.solid_lambda = tetrahedron_lambda;
  const double a = tetrahedron_side;
  append_body(scene, {.name = "tetrahedron", .material = material},
              {.positions = {{0, 0, 0}, {a, 0.2 * a, 0.3 * a}, {0, a, 0}, {0, 0, a}},
               .triangles = {},
               .loose_edges = {},
               .tetrahedra = {{0, 1, 2, 3}}});
  pin(scene, {0, 2, 3});
  round_to_single(scene);
  return {scene};
}

/// Reads the displacement H⁻¹ m g of the free corner, see (2). The corner is at the distance a from the plane x = 0, so
/// ∇N = (1/a, 0, 0) and H is diagonal.
std::vector<Reading> read_tetrahedron(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const double a = tetrahedron_side, volume = a * a * a / 6, m = masses(run.scene)[1];
  const double across = volume * tetrahedron_mu / (a * a),
               along = across + volume * (tetrahedron_lambda + tetrahedron_mu) / (a * a);
  const Vec3 g = run.scene.gravity, law{m * g.x / along, m * g.y / across, m * g.z / across};
  const Vec3 moved = plus(run.states.back().positions[1], run.scene.rest_positions[1], -1);
  return {{.what = "distance from where the corner hangs",
           .unit = "m",
           .measured = length(plus(moved, law, -1)),
           .answer = 0,
           .tolerance = force_left(run) * length(law),
           .side = Side::at_most}};
}

constexpr double bar_side = 1, bar_length = 4, bar_mu = 1e7, bar_density = 1000;

Scene clamped_bar(Index across, std::int64_t iterations) {
  Scene scene = empty_scene("cantilever_bar", 0.05, 60, iterations);
  scene.gravity = down;
  Material material = cloth(0);
  material.solid_density = bar_density;
  material.solid_mu = bar_mu;
  material.solid_lambda = 0;
  append_body(scene, {.name = "bar", .material = material},
              box({4 * across, across, across}, bar_side / across, {0, 0, 0}));
  std::vector<Index> held((across + 1) * (across + 1));
  for (std::size_t v = 0; v < held.size(); ++v) held[v] = static_cast<Index>(v);
  pin(scene, held);
  round_to_single(scene);
  return scene;
}

std::vector<Scene> bar_scenes(LawSize size) {
  const std::int64_t iterations = size == LawSize::least ? 300 : 3000;
  return {clamped_bar(1, iterations), clamped_bar(2, iterations)};
}

double mean_deflection(const Trajectory& run) {
  return centre(run.scene, 0, run.states.front()).y - centre(run.scene, 0, run.states.back()).y;
}

std::vector<Reading> read_bar(std::span<const Trajectory> runs) {
  const double coarse = mean_deflection(runs[0]), fine = mean_deflection(runs[1]);
  const double load = bar_density * standard_gravity * bar_length * bar_length, young = 2 * bar_mu;
  const double law = load * bar_length * bar_length * 12 / (20 * young * bar_side * bar_side) + load / (2.5 * bar_mu);
  return {{.what = "deflection with cells half as large",
           .unit = "m",
           .measured = fine,
           .answer = law,
           .tolerance = force_left(runs[1]) * law,
           .side = Side::at_most},
          {.what = "deflection with large cells",
           .unit = "m",
           .measured = coarse,
           .answer = fine,
           .tolerance = force_left(runs[0]) * law,
           .side = Side::at_most}};
}

constexpr double swing_side = 0.1, swing_start = 0.5;

std::vector<Scene> swing_scenes(LawSize) {
  Scene scene = empty_scene("pendulum", 0.005, 200, 100);
  scene.gravity = down;
  Material material = cloth(0);
  material.lame_mu = material.lame_lambda = 2000;
  const double half = swing_side / 2, tall = swing_side;
  append_body(
      scene, {.name = "triangle", .material = material},
      {.positions = {{0, 0, 0}, {-half, -tall, 0}, {half, -tall, 0}}, .triangles = {{0, 1, 2}}, .loose_edges = {}});
  for (Vec3& x : scene.mesh.positions)
    x = {std::cos(swing_start) * x.x - std::sin(swing_start) * x.y,
         std::sin(swing_start) * x.x + std::cos(swing_start) * x.y, 0};
  pin(scene, {0});
  round_to_single(scene);
  return {scene};
}

/// Returns the angle between straight down and the middle of the two lower corners.
double swing_angle(const LawState& state) {
  const Vec3 x = plus(state.positions[1], state.positions[2]);
  return std::atan2(x.x, -x.y);
}

/// Returns the angles of (4), from the start angle and the rest shape. Points are complex numbers x + i y, rotated so
/// that straight down has the angle 0.
std::vector<double> swings(const Trajectory& run) {
  using Complex = std::complex<double>;
  const double h = run.scene.settings.time_step;
  double inertia = 0;
  Complex moment = 0;
  for (const std::size_t v : {1u, 2u}) {
    const Complex r(run.scene.rest_positions[v].x, run.scene.rest_positions[v].y);
    inertia += std::norm(r);
    moment += std::conj(r);
  }
  std::vector<double> angles{swing_angle(run.states[0])};
  double before = angles[0];
  while (angles.size() < run.states.size()) {
    const double now = angles.back();
    angles.push_back(std::arg(inertia * (2. * std::polar(1., now) - std::polar(1., before)) -
                              Complex(0, h * h * standard_gravity) * moment));
    before = now;
  }
  return angles;
}

std::vector<Reading> read_swing(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const std::vector<double> law = swings(run);
  double most = 0;
  for (std::size_t n = 0; n < law.size(); ++n) most = std::max(most, std::abs(swing_angle(run.states[n]) - law[n]));
  // E of plane stress is 8 μ/3 with λ = μ. The triangle's mean width is swing_side/2. The centrifugal force is at most
  // as large as the weight, hence the factor 2.
  const double weight = mass_of(run.scene, 0) * standard_gravity;
  const double strain = 2 * weight / (8. / 3 * run.scene.bodies[0].material.lame_mu * swing_side / 2);
  const double phase = std::sqrt(standard_gravity / swing_side) * run.scene.settings.time_step *
                       static_cast<double>(run.rows.size());
  return {{.what = "angle from the law",
           .unit = "1",
           .measured = most,
           .answer = 0,
           .tolerance = swing_start * (phase * strain / 2 + force_left(run)),
           .side = Side::at_most}};
}

constexpr double arc_cell = 0.03, arc_density = 0.3, arc_lame = 500, arc_bending = 0.005;

/// Returns N of this file's head: the number of sweeps that nearly solve a step.
double solving_sweeps(double time_step) {
  const double trace = 16 * arc_lame + 84 * arc_bending / (arc_cell * arc_cell);
  const double mass = arc_density * arc_cell * arc_cell;
  return (1 + time_step * time_step * trace / (3 * mass)) * std::log(101) / 2;
}

/// Returns a sheet that is curved at rest, without contacts: 11 × 11 vertices on a cylinder of radius 0.2 m. One corner
/// is held.
Scene pinned_arc(double time_step, std::int64_t steps, std::int64_t iterations) {
  Scene scene = empty_scene("pinned_sheet", time_step, steps, iterations);
  scene.gravity = down;
  scene.settings.contact_radius = 0.002;
  Material material = cloth(0);
  material.density = arc_density;
  material.membrane = MembraneModel::st_venant_kirchhoff;  // the derivation of N uses its block
  material.lame_mu = material.lame_lambda = arc_lame;
  material.bending = BendingModel::discrete_hinge;
  material.bending_stiffness = arc_bending;
  Mesh mesh = sheet(11, 11, arc_cell, 0);
  for (Vec3& x : mesh.positions) {
    const double angle = x.x / 0.15 * 1.1;
    x = {0.2 * std::sin(angle), 0.2 * std::cos(angle), x.z};
  }
  append_body(scene, {.name = "arc", .material = material}, mesh);
  pin(scene, {0});
  round_to_single(scene);
  return scene;
}

/// Returns the runs until the sheet has swung down. The last run has short steps of N sweeps (solving_sweeps), the
/// other runs have few sweeps per step.
std::vector<Scene> pinned_scenes(LawSize size) {
  constexpr double brief = 1. / 480;
  const Scene solved = pinned_arc(brief, 240, std::lround(std::ceil(solving_sweeps(brief))));
  if (size == LawSize::least) return {pinned_arc(1. / 120, 80, 20), solved};
  return {pinned_arc(1. / 120, 240, 20), pinned_arc(1. / 120, 240, 5), pinned_arc(brief, 480, 20), solved};
}

/// Returns −f·Δ − ‖v' − v‖²_M/2 of (5) in the step that ends in state n.
double work_left(const Trajectory& run, std::size_t n) {
  const LawState &before = run.states[n - 1], &now = run.states[n];
  const std::vector<double> m = masses(run.scene);
  const double h = run.scene.settings.time_step;
  std::vector<Vec3> way(m.size());
  double work = 0;
  for (std::size_t v = 0; v < m.size(); ++v) {
    way[v] = plus(now.positions[v], before.positions[v], -1);
    const Vec3 gained = plus(now.velocities[v], before.velocities[v], -1);
    work += m[v] * (dot(gained, way[v]) / h - dot(run.scene.gravity, way[v]) - dot(gained, gained) / 2);
  }
  return work + elastic(run.scene, now.positions, way).change;
}

Reading read_energy(const Trajectory& run) {
  // Finds the largest rise of the energy, and the sum of work_left over the steps of this rise.
  double least = std::numeric_limits<double>::infinity(), rise = 0, largest = 0, done = 0, done_at_least = 0, work = 0;
  for (std::size_t n = 1; n < run.states.size(); ++n) {
    const StepMetrics& row = run.rows[n - 1];
    const double energy = row.kinetic_energy + row.elastic_energy + row.contact_energy + row.gravity_energy;
    done += work_left(run, n);
    largest = std::max(largest, row.kinetic_energy);
    if (energy < least) {
      least = energy;
      done_at_least = done;
    } else if (energy - least > rise) {
      rise = energy - least;
      work = done - done_at_least;
    }
  }
  const Settings& settings = run.scene.settings;
  const bool are_few = !run.by.is_solved &&
                       static_cast<double>(settings.iterations) < solving_sweeps(settings.time_step);
  constexpr double tolerance = 0.01;
  return {.what = "energy gained over the largest kinetic energy (" + std::to_string(settings.iterations) +
                  " sweeps, h = 1/" + std::to_string(std::lround(1 / settings.time_step)) + " s)",
          .unit = "1",
          .measured = rise / largest,
          .answer = 0,
          .tolerance = tolerance,
          .side = Side::at_most,
          .limit = are_few ? tolerance + work / largest : 0,
          .why = "forces that few sweeps leave would have taken energy; iterations moves it"};
}

std::vector<Reading> read_pinned(std::span<const Trajectory> runs) {
  std::vector<Reading> readings;
  for (const Trajectory& run : runs) readings.push_back(read_energy(run));
  return readings;
}

}  // namespace

std::vector<Law> beams() {
  return {{.name = "cantilever_hinge",
           .group = "beams",
           .meaning = "a triangle hangs down from a hinge",
           .answer = "c θ = m g b cos θ, c = 3 k_b e²/(A₀ + A₁)",
           .scenes = hinge_scenes,
           .read = read_hinge},
          {.name = "cantilever_tetrahedron",
           .group = "beams",
           .meaning = "a corner hangs from a clamped face",
           .answer = "(μ V ‖∇N‖² I + (λ + μ) V ∇N ∇Nᵀ)⁻¹ m g",
           .scenes = tetrahedron_scenes,
           .read = read_tetrahedron},
          {.name = "cantilever_bar",
           .group = "beams",
           .meaning = "a clamped bar of tetrahedra is no softer than a beam",
           .answer = "ρ g L⁴ 12/(20 E t²) + ρ g L²/(2.5 G), from below",
           .scenes = bar_scenes,
           .read = read_bar},
          {.name = "pendulum",
           .group = "beams",
           .meaning = "a triangle swings from a corner as implicit Euler has it",
           .answer = "θ' = arg(I (2 e^{iθ} − e^{iθ⁻}) − i h² g Σ m r̄)",
           .scenes = swing_scenes,
           .read = read_swing},
          {.name = "pinned_sheet",
           .group = "beams",
           .meaning = "a curved sheet held at a corner gains no energy",
           .answer = "kinetic + elastic + gravity's energy never rises",
           .scenes = pinned_scenes,
           .read = read_pinned}};
}

}  // namespace ogc::compare
