// Tests bodies without outer forces. With the forces f of a step at xᵗ⁺¹, m (vᵗ⁺¹ − vᵗ) = h f. Translation and rotation
// do not change the energies of inner forces, so Σ f = 0 and Σ x × f = 0 at xᵗ⁺¹. Hence
//
//     Σ m vᵗ⁺¹ = Σ m vᵗ,      Lᵗ⁺¹ = Σ m xᵗ⁺¹ × vᵗ = Lᵗ + h Σ m vᵗ⁺¹ × vᵗ                                   (1)
//
// for any motion. Let a rigid body rotate by φ_n in step n about an axis through its centre. At radius R it has v_n =
// (x_n − x_{n−1})/h, and y = 2 x_n − x_{n−1} lies at the angle atan(sin φ_n/(2 − cos φ_n)) ahead of x_n. The rotation
// nearest to y in the norm of the masses has this angle:
//
//     tan φ_{n+1} = sin φ_n/(2 − cos φ_n),   φ_1 = atan(h ω),   L_n = I sin φ_n/h                            (2)
//
// By (2) L decreases in each step by a share of about φ². A sheet extends by a strain of ρ ω² R²/E, which changes R,
// and L contains R².
//
// A step that is not solved exactly leaves a force. Newton leaves newton_tolerance of the mean |f*|, the force after
// the guess loop; sweeps leave the force that they have not yet removed. So the tolerances below are shares of the
// impulses that inner forces exchange, Σ ‖m Δv‖: 10⁻⁴ (newton_tolerance) and 10⁻² (the most that sweeps of a stiff body
// may leave).
#include <cmath>

#include "compare/laws/groups.hpp"
#include "compare/laws/measures.hpp"
#include "compare/laws/shapes.hpp"

namespace ogc::compare {
namespace {

using namespace law_measures;
using namespace law_shapes;

double left_over(const Trajectory& run) { return run.by.is_solved ? 1e-4 : 1e-2; }

/// What inner forces exchange, summed over steps and vertices: impulses ‖m (vᵗ⁺¹ − vᵗ)‖ and angular impulses ‖m x ×
/// (vᵗ⁺¹ − vᵗ)‖.
struct Exchange {
  double impulse = 0, turn = 0;
};
Exchange exchanged(const Trajectory& run) {
  const std::vector<double> m = masses(run.scene);
  Exchange sum;
  for (std::size_t n = 1; n < run.states.size(); ++n)
    for (std::size_t v = 0; v < m.size(); ++v) {
      const Vec3 change = plus(run.states[n].velocities[v], run.states[n - 1].velocities[v], -1);
      sum.impulse += m[v] * length(change);
      sum.turn += m[v] * length(cross(run.states[n].positions[v], change));
    }
  return sum;
}

/// Returns the rounding error of Σ m v. Velocities (x' − x)/h are off by 2 u |x|/h, u = 2⁻²⁴, in each step; in the
/// worst case all errors have one sign. The error of Σ m x × v is this error times the lever |x|.
double momentum_rounding(const Trajectory& run) {
  const double x = largest_coordinate(run), steps = static_cast<double>(run.rows.size());
  double mass = 0;
  for (const double m : masses(run.scene)) mass += m;
  return steps * mass * 2 * unit_roundoff * x / run.scene.settings.time_step;
}

/// Returns a sheet that tumbles, stretches and flies away.
std::vector<Scene> tumbling_scenes(LawSize size) {
  Scene scene = empty_scene("momentum", 0.005, size == LawSize::least ? 40 : 200, 100);
  append_body(scene, {.name = "sheet", .material = cloth(0)}, sheet(5, 5, 0.05, 0));
  for (std::size_t v = 0; v < scene.mesh.positions.size(); ++v) {
    const Vec3 x = scene.mesh.positions[v];
    scene.velocities[v] = plus(plus({0.3, 0.1, -0.2}, cross({1, 2, 3}, x)), {x.x, 0, -x.z}, 0.5);
  }
  round_to_single(scene);
  return {scene};
}

/// Returns by how much L changes over the run according to (1): the sum of h Σ m vᵗ⁺¹ × vᵗ over the steps.
Vec3 lost_turn(const Trajectory& run) {
  const std::vector<double> m = masses(run.scene);
  Vec3 sum{};
  for (std::size_t n = 1; n < run.states.size(); ++n)
    for (std::size_t v = 0; v < m.size(); ++v)
      sum = plus(sum, cross(run.states[n].velocities[v], run.states[n - 1].velocities[v]),
                 m[v] * run.scene.settings.time_step);
  return sum;
}

std::vector<Reading> read_tumbling(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const Exchange exchange = exchanged(run);
  const double share = left_over(run), noise = momentum_rounding(run);
  const Vec3 drift = plus(momentum(run.scene, run.states.back()), momentum(run.scene, run.states.front()), -1);
  const Vec3 turn = plus(
      plus(angular_momentum(run.scene, run.states.back()), angular_momentum(run.scene, run.states.front()), -1),
      lost_turn(run), -1);
  return {{.what = "change of momentum",
           .unit = "kg m/s",
           .measured = length(drift),
           .answer = 0,
           .tolerance = share * exchange.impulse + noise,
           .side = Side::at_most},
          {.what = "change of angular momentum beside Euler's",
           .unit = "kg m²/s",
           .measured = length(turn),
           .answer = 0,
           .tolerance = share * exchange.turn + noise * largest_coordinate(run),
           .side = Side::at_most}};
}

constexpr double rate = 5;  // [rad/s]

std::vector<Scene> spin_scenes(LawSize size) {
  Scene scene = empty_scene("spin", 0.01, size == LawSize::least ? 20 : 100, 100);
  append_body(scene, {.name = "sheet", .material = cloth(0)}, sheet(5, 5, 0.05, 0));
  for (std::size_t v = 0; v < scene.mesh.positions.size(); ++v)
    scene.velocities[v] = cross({0, rate, 0}, scene.mesh.positions[v]);
  round_to_single(scene);
  return {scene};
}

std::vector<Reading> read_spin(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const double h = run.scene.settings.time_step, start = angular_momentum(run.scene, run.states.front()).y;
  double angle = std::atan(h * rate), change = 0;
  for (std::size_t n = 2; n < run.states.size(); ++n) angle = std::atan2(std::sin(angle), 2 - std::cos(angle));
  const double answer = start / (h * rate) * std::sin(angle);
  change = start - answer;
  // E of plane stress is 4 μ (λ + μ)/(λ + 2 μ); half of the diagonal is the largest radius.
  const Material& cloth_of = run.scene.bodies[0].material;
  const double young = 4 * cloth_of.lame_mu * (cloth_of.lame_lambda + cloth_of.lame_mu) /
                       (cloth_of.lame_lambda + 2 * cloth_of.lame_mu);
  const double radius = 0.1 * std::numbers::sqrt2, strain = cloth_of.density * rate * rate * radius * radius / young;
  const double drift = length(plus(momentum(run.scene, run.states.back()), {}, 1));
  return {{.what = "angular momentum at the end",
           .unit = "kg m²/s",
           .measured = angular_momentum(run.scene, run.states.back()).y,
           .answer = answer,
           .tolerance = 2 * strain * start + left_over(run) * exchanged(run).turn + 0.01 * change},
          {.what = "momentum at the end",
           .unit = "kg m/s",
           .measured = drift,
           .answer = 0,
           .tolerance = left_over(run) * exchanged(run).impulse + momentum_rounding(run),
           .side = Side::at_most}};
}

}  // namespace

std::vector<Law> free_bodies() {
  return {
      {.name = "momentum",
       .group = "free bodies",
       .meaning = "a body that tumbles and stretches keeps its momentum, and loses of its turn what Euler's rule says",
       .answer = "Σ m v stays; L' − L = h Σ m v' × v",
       .scenes = tumbling_scenes,
       .read = read_tumbling},
      {.name = "spin",
       .group = "free bodies",
       .meaning = "a stiff sheet turns on as implicit Euler turns it",
       .answer = "L = I sin φ/h with tan φ' = sin φ/(2 − cos φ), tan φ_1 = h ω",
       .scenes = spin_scenes,
       .read = read_spin}};
}

}  // namespace ogc::compare
