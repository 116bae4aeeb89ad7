#include "experiments/program/runs/mesh_scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "compare/problem/error.hpp"
#include "compare/problem/material_table.hpp"
#include "compare/problem/text.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/runs/set_material.hpp"
#include "experiments/program/runs/suggestion.hpp"
#include "experiments/scenes/materials.hpp"
#include "experiments/scenes/shapes.hpp"

namespace ogc::experiments {

namespace {

using compare::Vec3;

constexpr double ground_widths = 3;  ///< width of the ground divided by that of the mesh
constexpr double ground_edges =
    10;  ///< edge length of the ground divided by that of the mesh; triangles are at most a hundred times as large
constexpr double most_ground_cells = 100;

struct Box {
  Vec3 low, high;
  double width() const { return std::max(high.x - low.x, high.z - low.z); }
  double size() const { return std::max(width(), high.y - low.y); }
  double fall() const { return size() / 10; }
};

Box box_of(const compare::Mesh& mesh) {
  Box box{mesh.positions.front(), mesh.positions.front()};
  for (const Vec3& p : mesh.positions) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

/// Makes a body's name from the file's name, with characters that are allowed in names of files.
std::string usable_name(const std::string& file) {
  std::string name = std::filesystem::path(file).stem().string();
  const auto is_usable = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  };
  std::ranges::replace_if(
      name, [&](char c) { return !is_usable(c); }, '_');
  return name.empty() ? "mesh" : name;
}

/// Returns the height of the ground relative to `origin`. `box` is relative to `origin`, too, but `ground` is in the
/// file's coordinates.
double height_of_ground(const std::string& file, const Box& box, std::optional<double> ground, double origin) {
  if (!ground) return box.low.y - box.fall();
  if (!std::isfinite(*ground)) throw compare::InputError("--ground " + number(*ground) + ": give a height [m]");
  if (*ground - origin < box.low.y) return *ground - origin;
  throw compare::InputError("--ground " + compare::shortest(*ground) + " is not below " + file +
                            ", whose lowest point is at y = " + compare::shortest(origin + box.low.y) +
                            " m; give less");
}

compare::Mesh ground_below(const Box& box, double height, double edge) {
  const double side = ground_widths * box.width();
  const double cells = std::clamp(std::ceil(side / (ground_edges * edge)), 1.0, most_ground_cells);
  compare::Mesh mesh = grid(static_cast<compare::Index>(cells) + 1, side, height);
  const double x = (box.low.x + box.high.x) / 2, z = (box.low.z + box.high.z) / 2;
  for (Vec3& p : mesh.positions) p = {p.x + x, p.y, p.z + z};
  return mesh;
}

/// Describes the falling body in words.
std::string made_of(const compare::Body& body) {
  const compare::Material& material = body.material;
  if (!body.is_solid()) return "cloth of " + number(material.density) + " kg/m²";
  const compare::Elasticity elasticity = compare::elasticity_of(material);
  return "a solid of " + compare::shortest(material.solid_density) + " kg/m³ (solid_density), " +
         number(elasticity.young) + " Pa (solid_young), Poisson's ratio " + number(elasticity.poisson) +
         " (solid_poisson), damping " + number(material.solid_damping) + " s (solid_damping)";
}

void say(const compare::Scene& scene, const Suggestion& found) {
  const auto line = [](const char* what, const SuggestedNumber& suggested, const char* unit) {
    log_line(std::string("  ") + what + " " + number(suggested.value) + unit + ": " + suggested.reason);
  };
  log_line("ogc: " + scene.name + " is taken as " + made_of(scene.bodies[0]) +
           " with these settings (--set changes them):");
  line("contact_radius", found.contact_radius, " m");
  line("query radius", found.query_radius, " m");
  line("contact stiffness", found.contact_stiffness, " N/m");
  line("time_step", found.time_step, " s");
  line("iterations", found.iterations, "");
}

std::int64_t steps_of(double fall, double gravity, double step) {
  const double falling = std::sqrt(2 * fall / gravity);
  return static_cast<std::int64_t>(std::ceil(std::max(1.0, falling + 0.5) / step));
}

}  // namespace

double default_fall(const compare::Mesh& mesh) { return box_of(mesh).fall(); }

double lowest_point(const compare::Mesh& mesh) { return box_of(mesh).low.y; }

compare::SceneFile mesh_scene(const std::string& file, const compare::MeshOptions& options,
                              std::optional<double> ground, const std::vector<std::string>& assignments) {
  MeshInput input = read_mesh_input(file, options);
  expect_solid(input);
  if (!input.mesh.loose_edges.empty())
    throw compare::InputError(file + ": " + input.names.loose_edge(0, input.mesh.loose_edges[0]) +
                              " belongs to no face; cloth is made of triangles: remove such edges");
  const Box box = box_of(input.mesh);
  const double height = height_of_ground(file, box, ground, input.origin.y), fall = box.low.y - height;
  compare::Scene scene;
  scene.name = usable_name(file);
  if (input.mesh.tetrahedra.empty()) {
    append_body(scene, {.name = "cloth", .material = layer_cloth()}, input.mesh);
  } else {
    append_body(scene, {.name = "solid", .material = soft_rubber()}, input.mesh);
    set_solid_constants(scene, assignments);
  }
  const Suggestion found = suggest(input.mesh, scene.bodies[0].material, fall);
  append_body(scene, {.name = "ground", .fixed = true, .material = driven_surface()},
              ground_below(box, height, found.edge_length));
  apply(found, scene);
  scene.settings.steps = steps_of(fall, -scene.gravity.y, found.time_step.value);
  say(scene, found);
  return {std::move(scene), {std::make_shared<const compare::MeshSource>(std::move(input.source))}, {}, input.origin};
}

}  // namespace ogc::experiments
