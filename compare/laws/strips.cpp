// Tests hanging strips and bars. A strip of membrane with λ = 0 keeps its width when it is drawn out (St.
// Venant–Kirchhoff, method.md §4.6). With a stretch s along gravity its energy density is ψ = μ (s² − 1)²/4, so the
// force in a strip of width w is
//
//     T = μ w s (s² − 1).
//
// In a row of cells T is the weight of all vertices below the row. This gives the row's stretch, and the sum over the
// rows gives the length. In a bar of tetrahedra with λ = 0 (method.md §8.1) and cross section A the force is 2 μ A (s −
// 1), up to terms of second order in the strain, which balance the sideways stress μ (s − 1)² A.
//
// Tolerances. Inside a row masses and forces are not distributed equally over the vertices, because diagonals
// alternate. With n rows this changes the extension by a share of less than (1/n)².
//
// Sweeps. Let the strip be z too low at the start of a step. The sweeps start from y, which is z + h² g too low. The
// step's solution is too low by a·z, where a = (m/h²)/(m/h² + k₁). N sweeps leave a share ρᴺ of the distance from y to
// the solution. So the strip comes to rest where z = a z + ρᴺ (z + h² g − a z). A uniform load excites the longest wave
// with 4/π of its size, which gives
//
//     z = (4/π) h² g ρᴺ/((1 − ρᴺ)(1 − a)),    ρ = (2 k cos q/(m/h² + 2 k))²,   q = π/(2 n + 1),   k₁ = 2 k (1 − cos q).
//
// Here m is the mass of a row, k = E w/ℓ the stiffness between two rows at the distance ℓ, k₁ the stiffness of the
// longest wave of a chain, and ρ the factor by which Gauss–Seidel reduces this wave. A vertex's block also has the
// shear stiffness, E/4 for each E along the strip. So N sweeps of the strip are at least as good as N/2 sweeps of the
// chain, and z with N/2 is the limit.
#include <algorithm>
#include <cmath>

#include "compare/laws/groups.hpp"
#include "compare/laws/measures.hpp"
#include "compare/laws/shapes.hpp"

namespace ogc::compare {
namespace {

using namespace law_measures;
using namespace law_shapes;

constexpr double cell = 0.025;

/// Returns the stretch s ≥ 1 of a row that bears `load` = T/(μ w): the root of s (s² − 1) = load.
double stretch(double load) {
  double low = 1, high = 2 + load;
  for (int k = 0; k < 100; ++k) {
    const double middle = (low + high) / 2;
    (middle * (middle * middle - 1) < load ? low : high) = middle;
  }
  return low;
}

/// Returns the mass of all vertices from row `first` on; a row has `width` vertices.
double mass_below(const std::vector<double>& m, std::size_t first, std::size_t width) {
  double sum = 0;
  for (std::size_t v = first * width; v < m.size(); ++v) sum += m[v];
  return sum;
}

/// Hangs the scene's first body along x: moves each row to its position in the closed-form answer, and holds row 0.
template <class Stretch>
void hang(Scene& scene, std::size_t width, Stretch stretch_under) {
  const std::vector<double> m = masses(scene);
  double x = scene.mesh.positions[0].x;
  std::vector<Index> held;
  for (std::size_t v = 0; v < scene.mesh.positions.size(); ++v) {
    if (v >= width && v % width == 0) x += cell * stretch_under(mass_below(m, v / width, width) * standard_gravity);
    scene.mesh.positions[v].x = x;
    if (v < width) held.push_back(static_cast<Index>(v));
  }
  pin(scene, held);
  scene.gravity = {standard_gravity, 0, 0};
  round_to_single(scene);
}

constexpr double strip_mu = 100, strip_density = 0.2;

Scene strip(Index rows, std::int64_t iterations, std::int64_t steps) {
  Scene scene = empty_scene("hanging_strip", 0.005, steps, iterations);
  Material material = cloth(0);
  material.density = strip_density;
  material.membrane = MembraneModel::st_venant_kirchhoff;  // the formula of T assumes this model
  material.lame_mu = strip_mu;
  material.lame_lambda = 0;
  append_body(scene, {.name = "strip", .material = material}, sheet(rows, 3, cell, 0));
  hang(scene, 3, [](double weight) { return stretch(weight / (strip_mu * 2 * cell)); });
  return scene;
}

/// Returns by how much unfinished sweeps may leave the end below the law's answer: z in the head of this file [m].
double swept_sag(const Trajectory& run, double young, double density, double area, double rows) {
  const double h = run.scene.settings.time_step, m = density * area * cell, k = young * area / cell;
  const double q = std::numbers::pi / (2 * rows + 1), rho = std::pow(2 * k * std::cos(q) / (m / (h * h) + 2 * k), 2);
  const double left = std::pow(rho, static_cast<double>(run.scene.settings.iterations) / 2);
  const double wave = 2 * k * (1 - std::cos(q)), kept = wave / (m / (h * h) + wave);
  return 4 / std::numbers::pi * h * h * standard_gravity * left / ((1 - left) * kept);
}

/// Reads the extension at the end of the run. The run starts from the law's answer.
Reading read_hanging(const Trajectory& run, std::size_t width, double young, double density, double area) {
  const auto end = [&](const std::vector<Vec3>& x) {
    double sum = 0;
    for (std::size_t v = x.size() - width; v < x.size(); ++v) sum += x[v].x - run.scene.rest_positions[v].x;
    return sum / static_cast<double>(width);
  };
  const double law = end(run.scene.mesh.positions);
  const double rows = static_cast<double>(run.scene.mesh.positions.size() / width) - 1;
  const double tolerance = (1 / (rows * rows) + force_left(run)) * law;
  const double sag = run.by.is_solved ? 0 : swept_sag(run, young, density, area, rows);
  return {.what = "extension",
          .unit = "m",
          .measured = end(run.states.back().positions),
          .answer = law,
          .tolerance = tolerance,
          .limit = sag > 0 ? tolerance + sag : 0,
          .why = "sweeps leave part of each step's fall; iterations moves it"};
}

std::vector<Scene> strip_scenes(LawSize size) {
  return size == LawSize::least ? std::vector{strip(11, 300, 100)}
                                : std::vector{strip(11, 300, 100), strip(41, 40, 200)};
}

std::vector<Reading> read_strip(std::span<const Trajectory> runs) {
  std::vector<Reading> readings;
  for (const Trajectory& run : runs) readings.push_back(read_hanging(run, 3, 2 * strip_mu, strip_density, 2 * cell));
  return readings;
}

constexpr double bar_mu = 1e5, bar_density = 1000;

std::vector<Scene> bar_scenes(LawSize size) {
  Scene scene = empty_scene("hanging_bar", 0.005, 100, size == LawSize::least ? 100 : 200);
  Material material = cloth(0);
  material.solid_density = bar_density;
  material.solid_mu = bar_mu;
  material.solid_lambda = 0;
  append_body(scene, {.name = "bar", .material = material}, box({8, 1, 1}, cell, {0, 0, 0}));
  hang(scene, 4, [](double weight) { return 1 + weight / (2 * bar_mu * cell * cell); });
  return {scene};
}

std::vector<Reading> read_bar(std::span<const Trajectory> runs) {
  return {read_hanging(runs[0], 4, 2 * bar_mu, bar_density, cell * cell)};
}

}  // namespace

std::vector<Law> strips() {
  return {{.name = "hanging_strip",
           .group = "strips",
           .meaning = "a strip of cloth hangs as long as Hooke has it",
           .answer = "row by row T = μ w s (s² − 1), T the weight below",
           .scenes = strip_scenes,
           .read = read_strip},
          {.name = "hanging_bar",
           .group = "strips",
           .meaning = "a bar of tetrahedra hangs as long as Hooke has it",
           .answer = "layer by layer T = 2 μ A (s − 1), T the weight below",
           .scenes = bar_scenes,
           .read = read_bar}};
}

}  // namespace ogc::compare
