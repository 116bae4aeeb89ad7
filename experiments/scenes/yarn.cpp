// The curve of a row is from Crane (2023, A Simple Parametric Model of Plain-Knit Yarns): x = w t/2π + a sin 2t, y = h
// cos t, z = d cos 2t. The lengths are our choice: neighbouring yarns start 2.95 mm apart, within their contact radius
// of 3 mm. Half circles join consecutive rows, so that the cloth is one rod, as in hand knitting. Yarn of 1 g/m,
// contact radius and time step are the paper's (Table 1, §5.2). k_s, k_b, k_c (222 N/m after conversion), speeds and
// the held vertices are from the second author's public yarn code.
#include "experiments/scenes/yarn.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace ogc::experiments {
namespace {

using compare::Index;
using compare::Vec3;
using std::numbers::pi;

constexpr double loop_width = 0.4 / 33, row_height = 0.01, bow = 0.24 * loop_width, half_height = 8.6e-3,
                 depth = 2.1e-3;  // w, c, a, h, d of the curve [m]; c is the distance between rows
constexpr Index segments_a_loop = 49, segments_a_join = 15;
constexpr double held_width = 0.01;  // width of each held edge [m]

/// Returns the point with parameter t on the curve of row 0, whose first loop begins at t = −π.
Vec3 on_loop(double t) {
  return {loop_width * t / (2 * pi) + bow * std::sin(2 * t), half_height * std::cos(t), depth * std::cos(2 * t)};
}

double speed(double t) {
  return std::hypot(loop_width / (2 * pi) + 2 * bow * std::cos(2 * t), half_height * std::sin(t),
                    2 * depth * std::sin(2 * t));
}

/// Returns the parameters of `segments_a_loop` + 1 points at equal arc lengths along a loop. Simpson's rule computes
/// the arc length on a grid so fine that its error is below the rounding of single precision. Newton's method inverts
/// the arc length.
std::vector<double> equal_arcs() {
  constexpr int cells = 4096;
  const double cell = 2 * pi / cells;
  const auto length_of = [](double from, double to) {
    return (to - from) / 6 * (speed(from) + 4 * speed((from + to) / 2) + speed(to));
  };
  std::vector<double> length{0};
  for (int i = 0; i < cells; ++i) length.push_back(length.back() + length_of(-pi + i * cell, -pi + (i + 1) * cell));
  std::vector<double> parameters;
  int i = 0;
  for (Index k = 0; k <= segments_a_loop; ++k) {
    const double wanted = length.back() * k / segments_a_loop;
    while (i + 1 < cells && length[static_cast<std::size_t>(i + 1)] < wanted) ++i;
    const double from = -pi + i * cell;
    double t = from;
    for (int step = 0; step < 4; ++step)
      t += (wanted - length[static_cast<std::size_t>(i)] - length_of(from, t)) / speed(t);
    parameters.push_back(t);
  }
  return parameters;
}

/// Sets numbers below 1 nm to 0, so that exact arithmetic stays cheap.
double tidy(double x) { return std::abs(x) < 1e-9 ? 0 : x; }

/// Returns the yarn from end to end, centred in the plane z = 0. Wales (columns of loops) run along y.
std::vector<Vec3> knit(const YarnSizes& sizes) {
  const std::vector<double> parameters = equal_arcs();
  std::vector<Vec3> row;
  for (Index loop = 0; loop < sizes.loops; ++loop)
    for (Index k = 0; k < segments_a_loop; ++k) {
      Vec3 p = on_loop(parameters[static_cast<std::size_t>(k)]);
      p.x += loop_width * loop;
      row.push_back(p);
    }
  Vec3 end = on_loop(pi);
  end.x += loop_width * (sizes.loops - 1);
  row.push_back(end);
  const double middle_x = loop_width * (sizes.loops - 1) / 2, middle_y = row_height * (sizes.rows - 1) / 2;
  std::vector<Vec3> points;
  for (Index k = 0; k < sizes.rows; ++k) {
    const bool forth = k % 2 == 0;
    const std::size_t count = row.size();
    for (std::size_t i = 0; i < count; ++i) {
      Vec3 p = row[forth ? i : count - 1 - i];
      p.y += row_height * k;
      points.push_back(p);
    }
    if (k + 1 == sizes.rows) break;
    const Vec3 from = points.back();
    for (Index i = 1; i < segments_a_join; ++i) {
      const double angle = pi * i / segments_a_join;
      points.push_back({from.x + (forth ? 1 : -1) * row_height / 2 * std::sin(angle),
                        from.y + row_height / 2 * (1 - std::cos(angle)), from.z});
    }
  }
  for (Vec3& p : points) p = {tidy(p.x - middle_x), tidy(p.y - middle_y), tidy(p.z)};
  return points;
}

compare::Material yarn() {
  compare::Material material;
  material.rod = compare::RodMaterial{.density = 1e-3, .stretch = 0.1, .bend = 2e-7, .damping = 0, .diameter = 3e-3};
  material.contact_stiffness = 222;
  material.friction = 0.1;
  return material;
}

/// Returns a motion of all vertices that are within `held_width` of the highest or the lowest vertex along y.
compare::PrescribedMotion edge(const char* name, const std::vector<Vec3>& points, bool is_upper) {
  double most = is_upper ? points.front().y : -points.front().y;
  for (const Vec3& p : points) most = std::max(most, is_upper ? p.y : -p.y);
  compare::PrescribedMotion motion;
  motion.name = name;
  for (std::size_t i = 0; i < points.size(); ++i)
    if ((is_upper ? points[i].y : -points[i].y) > most - held_width) motion.vertices.push_back(static_cast<Index>(i));
  return motion;
}

compare::Scene scene_of(const char* name, std::vector<Vec3> points, const YarnSizes& sizes) {
  compare::Mesh mesh;
  mesh.positions = std::move(points);
  for (Index i = 1; i < static_cast<Index>(mesh.positions.size()); ++i) mesh.loose_edges.push_back({i - 1, i});
  compare::Scene scene;
  scene.name = name;
  append_body(scene, {.name = "yarn", .material = yarn()}, mesh);
  scene.settings.time_step = 4e-4;
  scene.settings.steps = sizes.steps;
  scene.settings.iterations = 4;
  scene.settings.contact_radius = 3e-3;
  scene.settings.friction_velocity = 1e-3;
  return scene;
}

}  // namespace

compare::Scene yarn_stretch(const YarnSizes& sizes) {
  std::vector<Vec3> points = knit(sizes);
  compare::PrescribedMotion upper = edge("upper", points, true), lower = edge("lower", points, false);
  for (Vec3& p : points) p = {p.x, p.z, -p.y};
  compare::Scene scene = scene_of("yarn_stretch", std::move(points), sizes);
  upper.velocity = {0, 0, -sizes.pull};
  lower.velocity = {0, 0, sizes.pull};
  upper.start = lower.start = scene.settings.time_step * static_cast<double>(sizes.rest_steps);
  scene.motions = {upper, lower};
  return scene;
}

compare::Scene yarn_twist(const YarnSizes& sizes) {
  std::vector<Vec3> points = knit(sizes);
  compare::PrescribedMotion upper = edge("upper", points, true), lower = edge("lower", points, false);
  compare::Scene scene = scene_of("yarn_twist", std::move(points), sizes);
  lower.axis = {0, 1, 0};
  lower.angular_velocity = pi;
  lower.end = 2 * sizes.turns;
  scene.motions = {upper, lower};
  return scene;
}

}  // namespace ogc::experiments
