// The curve and the parameters are as the authors published them. Start positions are rounded to 2⁻²⁰ m, because
// rounding errors dominate the normals where the curve is nearly straight.
#include "experiments/scenes/knot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "experiments/scenes/shapes.hpp"

namespace ogc::experiments {
namespace {

using compare::Index;
using compare::Vec3;

constexpr double rest_length = 9.613, rest_width = 0.045;  // [m]

Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
Vec3 unit(const Vec3& a) { return 1 / length(a) * a; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Returns a point of a coil about an axis along x, with radius 0.09 m and pitch 0.12 m. `turn`: number of revolutions
/// from the coil's top.
Vec3 coil(const Vec3& axis, double turn) {
  const double angle = 2 * std::numbers::pi * turn;
  return axis + Vec3{0.12 * turn, 0.09 * std::cos(angle), 0.09 * std::sin(angle)};
}

/// Returns the control points [m]: three coils, four overhand knots, and three more coils about the extended axis of
/// the first coils.
std::vector<Vec3> control_points() {
  std::vector<Vec3> points{{-0.9, -0.4, 0.035}};
  for (int third = 4; third < 12; ++third) points.push_back(coil({-0.9, -0.3, 0.035}, third / 3.0));
  points.insert(points.end(), {{-0.3, -0.3, 0}, {0.1, -0.3, 0}});
  for (int i = 0; i < 4; ++i) {
    for (const Vec3& p : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}, Vec3{0, -1, 0}, Vec3{1, 0, 1.5}, Vec3{1, 1, 1},
                          Vec3{1, 1, -0.75}, Vec3{0, 0, -0.75}, Vec3{0, 0, 1.25}, Vec3{-1, 0, 1.5}, Vec3{-2, 0, 0}}) {
      points.push_back(0.07 * (p + Vec3{-3.5 * i, 0, 0}));
    }
  }
  points.insert(points.end(), {{-0.8, -0.3, 0}, {-0.7, -0.3, 0}, {-0.4, -0.3, 0}});
  for (int quarter = 4; quarter < 16; ++quarter) points.push_back(coil({-0.4, -0.3, 0}, quarter / 4.0));
  points.insert(points.end(), {{0.2, -0.3, 0}, {0.3, -0.3, 0}});
  return points;
}

/// A centripetal Catmull–Rom curve: the parameters of successive points differ by the square root of the points'
/// distance. At each end one more point is added: the neighbour of the end point, reflected in the end point.
class Curve {
 public:
  explicit Curve(const std::vector<Vec3>& through) {
    points_.push_back(2 * through[0] - through[1]);
    points_.insert(points_.end(), through.begin(), through.end());
    points_.push_back(2 * through.back() - through[through.size() - 2]);
    knots_.push_back(0);
    for (std::size_t i = 1; i < points_.size(); ++i)
      knots_.push_back(knots_.back() + std::sqrt(length(points_[i] - points_[i - 1])));
  }

  /// Returns the point at `s` from 0 to segments(); the control points are at integers.
  Vec3 at(double s) const {
    const std::size_t i = std::min(static_cast<std::size_t>(s), segments() - 1);
    const std::array<double, 4> k{knots_[i], knots_[i + 1], knots_[i + 2], knots_[i + 3]};
    const double t = k[1] + (s - static_cast<double>(i)) * (k[2] - k[1]);
    const auto blend = [&](const Vec3& a, const Vec3& b, double from, double to) {
      return (to - t) / (to - from) * a + (t - from) / (to - from) * b;
    };
    const Vec3 a = blend(points_[i], points_[i + 1], k[0], k[1]), b = blend(points_[i + 1], points_[i + 2], k[1], k[2]);
    const Vec3 c = blend(points_[i + 2], points_[i + 3], k[2], k[3]);
    return blend(blend(a, b, k[0], k[2]), blend(b, c, k[1], k[3]), k[1], k[2]);
  }
  std::size_t segments() const { return points_.size() - 3; }

 private:
  std::vector<Vec3> points_;
  std::vector<double> knots_;
};

/// Returns `count` points at equal distances along the curve. Lengths are measured on a polyline of 48,000 points;
/// parameters are interpolated linearly between its points.
std::vector<Vec3> equally_spaced(const Curve& curve, Index count) {
  constexpr int fine = 48'000;
  const auto parameter = [&](int k) { return static_cast<double>(curve.segments()) * k / (fine - 1); };
  std::vector<double> along{0};
  for (int k = 1; k < fine; ++k)
    along.push_back(along.back() + length(curve.at(parameter(k)) - curve.at(parameter(k - 1))));
  std::vector<Vec3> points;
  for (Index i = 0; i < count; ++i) {
    const double wanted = along.back() * i / (count - 1);
    const auto next = std::clamp<std::ptrdiff_t>(std::upper_bound(along.begin(), along.end(), wanted) - along.begin(),
                                                 1, fine - 1);
    const double before = along[static_cast<std::size_t>(next - 1)], after = along[static_cast<std::size_t>(next)];
    const double share = (wanted - before) / (after - before);
    points.push_back(
        curve.at((1 - share) * parameter(static_cast<int>(next - 1)) + share * parameter(static_cast<int>(next))));
  }
  return points;
}

/// Returns the direction across the strip at each row: normal × tangent. The normal is the change of the unit chords,
/// with signs chosen so that it does not flip.
std::vector<Vec3> across(const std::vector<Vec3>& centres) {
  std::vector<Vec3> chords;
  for (std::size_t i = 1; i < centres.size(); ++i) chords.push_back(unit(centres[i] - centres[i - 1]));
  std::vector<Vec3> result;
  Vec3 normal = unit(chords[1] - chords[0]);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Vec3 &before = chords[i == 0 ? 0 : i - 1], &after = chords[std::min(i, chords.size() - 1)];
    if (i > 0 && i + 1 < centres.size()) {
      const Vec3 turn = unit(after - before);
      normal = dot(turn, normal) < 0 ? -1 * turn : turn;
    }
    result.push_back(unit(cross(normal, before + after)));
  }
  return result;
}

compare::Mesh laid_along(const std::vector<Vec3>& centres, Index columns) {
  const std::vector<Vec3> directions = across(centres);
  compare::Mesh mesh;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    for (Index j = 0; j < columns; ++j)
      mesh.positions.push_back(tidy(centres[i] + rest_width * j / (columns - 1) * directions[i]));
  }
  mesh.triangles = cross_diagonals(static_cast<Index>(centres.size()), columns);
  return mesh;
}

compare::Material cloth() {
  compare::Material material;
  material.density = 0.2;
  material.lame_mu = material.lame_lambda = 100;
  material.bending_stiffness = 2.5e-6;
  material.membrane_damping = material.bending_damping = 1e-7;
  material.contact_stiffness = 100;
  material.friction = 0.4;
  return material;
}

compare::PrescribedMotion pull(const char* name, Index row, const KnotSizes& sizes, double velocity, double start) {
  compare::PrescribedMotion motion;
  motion.name = name;
  for (Index j = 0; j < sizes.columns; ++j) motion.vertices.push_back(row * sizes.columns + j);
  motion.velocity = {velocity, 0, 0};
  motion.start = start;
  return motion;
}

}  // namespace

compare::Scene knot(const KnotSizes& sizes) {
  compare::Scene scene;
  scene.name = "knot";
  append_body(scene, {.name = "strip", .material = cloth()},
              laid_along(equally_spaced(Curve(control_points()), sizes.rows), sizes.columns));
  for (Index i = 0; i < sizes.rows; ++i) {
    for (Index j = 0; j < sizes.columns; ++j)
      scene.rest_positions[static_cast<std::size_t>(i * sizes.columns + j)] = {rest_length * i / (sizes.rows - 1), 0,
                                                                               rest_width * j / (sizes.columns - 1)};
  }
  scene.gravity = {};
  scene.settings.time_step = 1.0 / 300;
  scene.settings.steps = sizes.steps;
  scene.settings.iterations = 50;
  scene.settings.contact_radius = 2e-3 * 19 / (sizes.columns - 1);
  const double start = scene.settings.time_step * static_cast<double>(sizes.hold_steps);
  scene.motions.push_back(pull("first_row", 0, sizes, -0.10, start));
  scene.motions.push_back(pull("last_row", sizes.rows - 1, sizes, 0.10, start));
  return scene;
}

}  // namespace ogc::experiments
