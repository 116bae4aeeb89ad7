// Tests rods (compare/rods.md). Let n_j be the force in segment j, which is the weight of all nodes beyond it, d_j its
// director and D_j the vector from end to end. The rod is at rest if
//
//     D_j = l (d_j + n_j/k_s),    M_j − M_{j+1} = l d_j × n_j,    M_j = 2 k_b/l sin(θ_j/2)                    (1)
//
// with the angle θ_j between d_{j−1} and d_j. A rod in a plane, clamped at segment 0, has angles φ_j to the horizontal
// with φ_0 = 0 and φ_j = φ_{j−1} + 2 asin(M_j l/(2 k_b)). Here M_j = Σ_{i ≥ j} l cos φ_i W_i, and W_i is the weight
// beyond segment i.
//
// Without bending d_j lies along n_j = (H, V_j), and the rod is a chain of springs. V_j grows from segment to segment
// by the weight of a node. H has the value with which the chain spans the gap between its ends,
//
//     Σ_j l (1 + ‖n_j‖/k_s) H/‖n_j‖ = span,                                                                   (2)
//
// the discrete catenary. A cord in a groove of two perpendicular planes rests on both: each contact of a node has the
// force m g/√2. Without friction no force acts along the groove, so the cord keeps its speed. For solvers whose
// contacts are barriers, the law tests that the cord rests, but not the force of springs.
//
// Each tolerance is a share of the weight, law_measures::force_left. Sums over nodes are exact for any number of nodes.
#include <algorithm>
#include <cmath>

#include "compare/laws/groups.hpp"
#include "compare/laws/measures.hpp"
#include "compare/laws/shapes.hpp"

namespace ogc::compare {
namespace {

using namespace law_measures;
using namespace law_shapes;

constexpr double segment = 0.01, rod_density = 0.005, rod_stretch = 1, rod_bend = 1e-4;
constexpr std::size_t segments = 10;

Material cord(double bend) {
  Material material = cloth(0);
  material.contact_stiffness = 10;
  material.rod = RodMaterial{.density = rod_density, .stretch = rod_stretch, .bend = bend};
  return material;
}

Mesh straight(std::size_t count, const Vec3& start) {
  std::vector<Vec3> nodes;
  for (std::size_t k = 0; k <= count; ++k) nodes.push_back(plus(start, {static_cast<double>(k) * segment, 0, 0}));
  return chain(nodes);
}

Scene rod_scene(const char* name, const Mesh& mesh, double bend) {
  Scene scene = empty_scene(name, 0.005, 100, 200);
  scene.gravity = down;
  scene.settings.contact_radius = 0.002;
  append_body(scene, {.name = "rod", .material = cord(bend)}, mesh);
  return scene;
}

/// Returns the nodes of a clamped rod that obeys (1).
std::vector<Vec3> clamped(const Scene& scene) {
  const std::vector<double> m = masses(scene);
  std::vector<double> weight(segments), angle(segments, 0);
  for (std::size_t j = segments; j-- > 0;)
    weight[j] = m[j + 1] * standard_gravity + (j + 1 < segments ? weight[j + 1] : 0);
  for (int round = 0; round < 200; ++round)
    for (std::size_t j = 1; j < segments; ++j) {
      double moment = 0;
      for (std::size_t i = j; i < segments; ++i) moment += segment * std::cos(angle[i]) * weight[i];
      angle[j] = angle[j - 1] + 2 * std::asin(std::min(1., moment * segment / (2 * rod_bend)));
    }
  std::vector<Vec3> node{scene.rest_positions[0], scene.rest_positions[1]};
  for (std::size_t j = 1; j < segments; ++j)
    node.push_back(plus(node.back(), {std::cos(angle[j]), -std::sin(angle[j]) - weight[j] / rod_stretch, 0}, segment));
  return node;
}

std::vector<Scene> clamped_scenes(LawSize) {
  Scene scene = rod_scene("cantilever_rod", straight(segments, {0, 0, 0}), rod_bend);
  const std::vector<Vec3> node = clamped(scene);
  scene.mesh.positions = node;
  pin(scene, {0, 1});
  round_to_single(scene);
  return {scene};
}

std::vector<Reading> read_clamped(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const double law = -clamped(run.scene).back().y;
  return {{.what = "deflection of the end",
           .unit = "m",
           .measured = -run.states.back().positions.back().y,
           .answer = law,
           .tolerance = (force_left(run) + 1e-3) * law}};
}

constexpr double span = 0.08;

/// Returns the nodes of a chain that is held at both ends and obeys (2).
std::vector<Vec3> hanging(const std::vector<double>& m, double across) {
  const auto chain_of = [&](double pull) {
    double inner = 0;
    for (std::size_t k = 1; k < segments; ++k) inner += m[k] * standard_gravity;
    double vertical = -inner / 2;
    std::vector<Vec3> node{{0, 0, 0}};
    for (std::size_t j = 0; j < segments; ++j) {
      const double force = std::hypot(pull, vertical), drawn = segment * (1 + force / rod_stretch) / force;
      node.push_back(plus(node.back(), {drawn * pull, drawn * vertical, 0}));
      vertical += m[j + 1] * standard_gravity;
    }
    return node;
  };
  double low = 1e-9, high = 10;  // [N]
  for (int k = 0; k < 200; ++k) {
    const double middle = (low + high) / 2;
    (chain_of(middle).back().x < across ? low : high) = middle;
  }
  return chain_of(low);
}

std::vector<Scene> catenary_scenes(LawSize) {
  Scene scene = rod_scene("catenary", straight(segments, {0, 0, 0}), 0);
  scene.mesh.positions = hanging(masses(scene), span);
  pin(scene, {0, static_cast<Index>(segments)});
  round_to_single(scene);
  return {scene};
}

std::vector<Reading> read_catenary(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const std::vector<Vec3> law = hanging(masses(run.scene), span);
  double most = 0;
  for (std::size_t k = 0; k < law.size(); ++k)
    most = std::max(most, length(plus(run.states.back().positions[k], law[k], -1)));
  const double sag = -law[segments / 2].y;
  return {{.what = "sag",
           .unit = "m",
           .measured = -run.states.back().positions[segments / 2].y,
           .answer = sag,
           .tolerance = (force_left(run) + 1e-3) * sag},
          {.what = "distance from the catenary",
           .unit = "m",
           .measured = most,
           .answer = 0,
           .tolerance = (force_left(run) + 1e-3) * sag,
           .side = Side::at_most}};
}

/// Returns a thrown stiff cord of two segments, which moves as a point does (falls.cpp).
std::vector<Scene> thrown_scenes(LawSize) {
  Scene scene = empty_scene("cord_falls", 1. / 240, 60, 20);
  scene.gravity = down;
  Material material = cord(rod_bend);
  material.rod->stretch = 1000;
  append_body(scene, {.name = "rod", .material = material}, chain({{-0.08, 0, 0}, {0, 0, 0}, {0.08, 0, 0}}));
  set_velocity(scene, 0, {0.05, 0, 0.02});
  round_to_single(scene);
  return {scene};
}

std::vector<Reading> read_thrown(std::span<const Trajectory> runs) {
  const Trajectory& run = runs[0];
  const double h = run.scene.settings.time_step, t = h * static_cast<double>(run.rows.size());
  const auto steps = static_cast<std::int64_t>(run.rows.size());
  double most = 0;
  for (std::size_t v = 0; v < run.scene.mesh.positions.size(); ++v) {
    const Vec3 law = plus(plus(run.scene.mesh.positions[v], run.scene.velocities[v], t), run.scene.gravity,
                          (t * t + t * h) / 2);
    most = std::max(most, length(plus(run.states.back().positions[v], law, -1)));
  }
  return {{.what = "distance from free flight",
           .unit = "roundings",
           .measured = most / flight_rounding(steps, largest_coordinate(run)),
           .answer = 0,
           .tolerance = std::numbers::sqrt3,
           .side = Side::at_most}};
}

constexpr double along = 0.05, groove = 1;

std::vector<Scene> channel_scenes(LawSize) {
  Scene scene = rod_scene("cord_in_channel", straight(segments, {0, 0, 0}), rod_bend);
  const double r = scene.settings.contact_radius, k = scene.bodies[0].material.contact_stiffness;
  const std::vector<double> m = masses(scene);
  // Both planes are at the distance r − depth from the node, so the node is √2 (r − depth) above their common line.
  for (std::size_t v = 0; v <= segments; ++v) {
    const double depth = m[v] * standard_gravity / std::numbers::sqrt2 / k;
    scene.mesh.positions[v] = {segment * (static_cast<double>(v) - 0.5 * segments), std::numbers::sqrt2 * (r - depth),
                               0};
  }
  set_velocity(scene, 0, {along, 0, 0});
  append_body(scene, {.name = "channel", .fixed = true, .material = cord(rod_bend)},
              {.positions = {{-groove, 0, 0}, {groove, 0, 0}, {0, groove, -groove}, {0, groove, groove}},
               .triangles = {{0, 1, 2}, {1, 0, 3}},
               .loose_edges = {}});
  scene.bodies.back().material.rod.reset();
  Scene dropped = scene;
  for (std::size_t v = 0; v <= segments; ++v) dropped.mesh.positions[v].y += r / 2;
  round_to_single(scene);
  round_to_single(dropped);
  return {scene, dropped};
}

void add_channel(std::vector<Reading>& readings, const Trajectory& run, const std::string& how) {
  const double weight = mass_of(run.scene, 0) * standard_gravity, r = run.scene.settings.contact_radius;
  double borne = 0, across = 0;
  for (std::size_t v = 0; v <= segments; ++v) {
    const Vec3 &x = run.states.back().positions[v], &u = run.states.back().velocities[v];
    across = std::max(across, std::hypot(u.y, u.z));
    for (const double side : {-1., 1.})
      borne += std::max(0., r - (x.y + side * x.z) / std::numbers::sqrt2) *
               run.scene.bodies[0].material.contact_stiffness / std::numbers::sqrt2;
  }
  const double rounding = 2 * unit_roundoff * largest_coordinate(run) / run.scene.settings.time_step *
                          static_cast<double>(run.rows.size());
  if (run.by.has_contact_energy)
    readings.push_back({.what = "weight that the channel bears" + how,
                        .unit = "N",
                        .measured = borne,
                        .answer = weight,
                        .tolerance = force_left(run) * weight});
  readings.push_back({.what = "speed across the channel" + how,
                      .unit = "m/s",
                      .measured = across,
                      .answer = 0,
                      .tolerance = rounding / static_cast<double>(run.rows.size()) +
                                   force_left(run) * standard_gravity * run.scene.settings.time_step,
                      .side = Side::at_most});
  readings.push_back({.what = "speed along the channel" + how,
                      .unit = "m/s",
                      .measured = centre_velocity(run.scene, 0, run.states.back()).x,
                      .answer = along,
                      .tolerance = rounding + force_left(run) * along});
}

std::vector<Reading> read_channel(std::span<const Trajectory> runs) {
  std::vector<Reading> readings;
  add_channel(readings, runs[0], "");
  add_channel(readings, runs[1], ", dropped");
  return readings;
}

}  // namespace

std::vector<Law> cords() {
  return {{.name = "cord_falls",
           .group = "cords",
           .meaning = "a thrown cord moves as implicit Euler moves a point",
           .answer = "x_n = x_0 + n h v_0 + h² g n (n + 1)/2",
           .scenes = thrown_scenes,
           .read = read_thrown},
          {.name = "cantilever_rod",
           .group = "cords",
           .meaning = "a clamped rod bends under its weight",
           .answer = "2 k_b/l sin(θ_j/2) = M_j, D = l (d + n/k_s)",
           .scenes = clamped_scenes,
           .read = read_clamped},
          {.name = "catenary",
           .group = "cords",
           .meaning = "a rod without bending hangs as a chain of springs",
           .answer = "n_j = (H, V_j), Σ l (1 + ‖n_j‖/k_s) H/‖n_j‖ = span",
           .scenes = catenary_scenes,
           .read = read_catenary},
          {.name = "cord_in_channel",
           .group = "cords",
           .meaning = "a cord rests in a groove, and slides along it",
           .answer = "k_c (r − d) = m g/√2 a side; speed stays",
           .scenes = channel_scenes,
           .read = read_channel}};
}

}  // namespace ogc::compare
