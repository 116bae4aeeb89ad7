// Grid point (p, q) of the shirt lies above the table at (x, z) = (p, −q) times the spacing. The shirt is open where
// front and back have separate vertices at a grid point.
#include "experiments/scenes/robot_shirt.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "experiments/scenes/driven_contact.hpp"
#include "experiments/scenes/materials.hpp"
#include "experiments/scenes/shapes.hpp"

namespace ogc::experiments {
namespace {

using compare::Index;
using compare::Scene;
using compare::Triangle;
using compare::Vec3;

constexpr double shirt_width = 0.45;      // [m]
constexpr double stitch_stiffness = 100;  // [N/m]
constexpr double table_edge = -0.06;      // z [m]

enum class Layer { back, front };

/// Builds the shirt from cells (i, j). Columns i run from −across/2 − sleeve_columns to +across/2 + sleeve_columns;
/// rows j count from the shoulders down.
class Pattern {
 public:
  Pattern(const RobotShirtSizes& sizes, double spacing, double radius)
      : sizes_(sizes), side_(sizes.across / 2), spacing_(spacing), radius_(radius) {}

  void append(Scene& scene, const compare::Material& material) {
    const Index widest = side_ + sizes_.sleeve_columns;
    for (const Layer layer : {Layer::back, Layer::front}) {
      for (Index j = 0; j < sizes_.length; ++j) {
        for (Index i = -widest; i < widest; ++i) {
          if (has_cell(layer, i, j)) add_cell(layer, i, j);
        }
      }
    }
    append_body(scene, {.name = "shirt", .material = material}, mesh_);
    for (const auto& [place, vertex] : vertices_[1]) {
      if (is_shoulder(place[0], place[1])) add_stitch(scene, vertex, vertices_[0].at(place), -1, 0, stitch_stiffness);
    }
  }

 private:
  bool has_cell(Layer layer, Index i, Index j) const {
    const Index out = i < 0 ? -1 - i : i;  // column counted from the middle of the shirt
    if (out >= side_) return j < sizes_.sleeve_rows;
    const double share = (out + 0.5) / sizes_.neck_columns;
    const Index depth = layer == Layer::front ? sizes_.front_neck : sizes_.back_neck;
    return share > 1 || j >= std::lround(depth * std::sqrt(1 - share * share));
  }
  /// Returns whether front and back share the vertex at grid point (p, q): along the sides, and below and above the
  /// sleeves.
  bool is_joined(Index p, Index q) const {
    const Index out = std::abs(p);
    return out >= side_ && (q == 0 || (out == side_ && q >= sizes_.sleeve_rows) || q == sizes_.sleeve_rows);
  }
  bool is_shoulder(Index p, Index q) const {
    return q == 0 && std::abs(p) >= sizes_.neck_columns && std::abs(p) < side_;
  }

  Index vertex(Layer layer, Index p, Index q) {
    const bool joined = is_joined(p, q);
    auto& numbers = vertices_[joined ? 0 : static_cast<std::size_t>(layer)];
    const auto [entry, is_new] = numbers.try_emplace({p, q}, static_cast<Index>(mesh_.positions.size()));
    const double height = joined || is_shoulder(p, q) ? 1.575 : layer == Layer::front ? 2.1 : 1.05;
    if (is_new) mesh_.positions.push_back({spacing_ * p, height * radius_, -spacing_ * q});
    return entry->second;
  }

  /// Adds a cell. Both layers are cut along the same diagonals. Different diagonals would intersect near shared
  /// vertices, where the gap is halved.
  void add_cell(Layer layer, Index i, Index j) {
    const Index a = vertex(layer, i, j), b = vertex(layer, i, j + 1), c = vertex(layer, i + 1, j + 1),
                d = vertex(layer, i + 1, j);
    const bool even = (i + j) % 2 == 0;
    for (const Triangle& t :
         {even ? Triangle{a, b, c} : Triangle{a, b, d}, even ? Triangle{a, c, d} : Triangle{b, c, d}})
      mesh_.triangles.push_back(layer == Layer::back ? t : Triangle{t[0], t[2], t[1]});
  }

  RobotShirtSizes sizes_;
  Index side_;
  double spacing_, radius_;
  compare::Mesh mesh_;
  /// by layer: vertex of each grid point; vertices that both layers share are in the first map
  std::array<std::map<std::array<Index, 2>, Index>, 2> vertices_;
};

compare::Material cloth() {
  compare::Material material = layer_cloth();
  material.friction = 0.5;
  return material;
}

compare::Mesh table(double spacing) {
  constexpr double half_width = 0.65, depth = 1.30;
  const double cell = 5 * spacing;  // cells have fifty times the area of the shirt's triangles
  const auto rows = static_cast<Index>(std::ceil(2 * half_width / cell)),
             columns = static_cast<Index>(std::ceil(depth / cell));
  compare::Mesh mesh;
  for (Index i = 0; i <= rows; ++i) {
    for (Index j = 0; j <= columns; ++j)
      mesh.positions.push_back(
          {half_width * (2.0 * i / rows - 1), 0, table_edge + depth * (static_cast<double>(j) / columns - 1)});
  }
  mesh.triangles = cross_diagonals(rows + 1, columns + 1);
  return mesh;
}

/// Holds the pose of both grippers [m]: the position (y, z) of the upper side of the lower jaws, and the distance
/// `opening` of the upper jaws above it.
struct Pose {
  double y, z, opening;
};

struct Waypoint {
  double time;  ///< [s]
  Pose pose;
};

/// Interpolates smoothly between waypoints, from rest to rest, and adds the shake.
class Trajectory {
 public:
  explicit Trajectory(double radius) {
    const double open = 0.03 + 4 * radius, shut = 2.2 * radius, low = 0.05 + 4 * radius;
    points_ = {{0.0, {0, 0, open}},        {0.3, {0, 0, 4 * radius}}, {0.5, {0, 0, shut}},
               {2.0, {0.32, 0, shut}},     {3.0, {0.32, 0, shut}},    {3.7, {0.32, -0.15, shut}},
               {4.5, {0.20, -0.27, shut}}, {5.3, {low, -0.17, shut}}, {5.5, {low, -0.17, open}},
               {5.95, {low, -0.03, open}}};
  }

  Pose at(double t) const {
    const auto next = std::find_if(points_.begin() + 1, points_.end() - 1,
                                   [&](const Waypoint& w) { return t <= w.time; });
    const Waypoint &from = *(next - 1), &to = *next;
    const double u = std::clamp((t - from.time) / (to.time - from.time), 0.0, 1.0), s = u * u * (3 - 2 * u);
    const auto between = [&](double a, double b) { return a + s * (b - a); };
    return {between(from.pose.y, to.pose.y), between(from.pose.z, to.pose.z) + shake(t),
            between(from.pose.opening, to.pose.opening)};
  }

 private:
  /// Returns the displacement [m] of the shake at time t. Its amplitude grows to 1.5 cm and fades.
  static double shake(double t) {
    constexpr double begin = 2.0, end = 3.0, hertz = 2.5;
    if (t <= begin || t >= end) return 0;
    const double window = std::sin(std::numbers::pi * (t - begin) / (end - begin));
    return 0.015 * window * window * std::sin(2 * std::numbers::pi * hertz * (t - begin));
  }
  std::vector<Waypoint> points_;
};

/// Appends two boxes at x = `centre` that form a gripper. They open and close vertically and share all other motion.
void append_gripper(Scene& scene, const char* name, double centre, double spacing, const Trajectory& trajectory) {
  constexpr double thickness = 0.012, inner = -0.045, outer = 0.03, seconds_a_frame = 1.0 / 60, seconds = 6;
  const double half = std::max(0.03, 1.1 * spacing);
  const auto cells = [&](double size) { return std::max<Index>(1, static_cast<Index>(std::lround(size / spacing))); };
  const std::array<Index, 3> cut{cells(2 * half), cells(thickness), cells(outer - inner)};
  const Pose start = trajectory.at(0);
  compare::Mesh jaws = box(cut, {centre - half, -thickness, inner}, {centre + half, 0, outer});
  const std::size_t lower = jaws.positions.size();
  const compare::Mesh upper = box(cut, {centre - half, start.opening, inner},
                                  {centre + half, start.opening + thickness, outer});
  jaws.positions.insert(jaws.positions.end(), upper.positions.begin(), upper.positions.end());
  const auto first = static_cast<Index>(lower);
  for (const auto& [a, b, c] : upper.triangles) jaws.triangles.push_back({first + a, first + b, first + c});
  compare::PrescribedMotion motion;
  motion.name = name;
  for (std::size_t v = 0; v < jaws.positions.size(); ++v)
    motion.vertices.push_back(static_cast<Index>(scene.mesh.positions.size() + v));
  for (int k = 0; k <= std::lround(seconds / seconds_a_frame); ++k) {
    motion.keyframes.times.push_back(seconds_a_frame * k);
    const Pose pose = trajectory.at(seconds_a_frame * k);
    for (std::size_t v = 0; v < jaws.positions.size(); ++v) {
      const Vec3& x = jaws.positions[v];
      const double rise = pose.y + (v < lower ? 0 : pose.opening - start.opening);
      motion.keyframes.positions.push_back(
          {static_cast<float>(x.x), static_cast<float>(x.y + rise), static_cast<float>(x.z + pose.z)});
    }
  }
  append_body(scene, {.name = name, .material = driven_surface()}, jaws);
  scene.motions.push_back(std::move(motion));
}

}  // namespace

Scene robot_shirt(const RobotShirtSizes& sizes) {
  const double spacing = shirt_width / sizes.across, radius = 2e-3 * 56 / sizes.across;
  Scene scene;
  scene.name = "robot_shirt";
  Pattern(sizes, spacing, radius).append(scene, cloth());
  append_body(scene, {.name = "table", .fixed = true, .material = driven_surface()}, table(spacing));
  const Trajectory trajectory(radius);
  append_gripper(scene, "left_gripper", -0.15, spacing, trajectory);
  append_gripper(scene, "right_gripper", 0.15, spacing, trajectory);
  // Makes a step move the jaws by the same fraction of r at every scale.
  scene.settings.time_step = 1.0 / 600 * 56 / sizes.across;
  scene.settings.steps = sizes.steps;
  scene.settings.iterations = 10;
  scene.settings.contact_radius = radius;
  for (const std::size_t b : driven_bodies(scene)) scene.bodies[b].contact = compare::BodyContact::volume;
  return scene;
}

}  // namespace ogc::experiments
