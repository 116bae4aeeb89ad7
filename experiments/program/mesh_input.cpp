#include "experiments/program/mesh_input.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/problem/dust.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/scene.hpp"
#include "compare/problem/tetrahedra.hpp"
#include "compare/problem/validate.hpp"
#include "compare/problem/validate_mesh.hpp"
#include "experiments/program/output.hpp"

namespace ogc::experiments {

namespace {

/// Describes how many vertices share a position. At a sharp bend, modelling programs write one vertex for each face;
/// the faces touch there, but nothing connects them.
std::string repeated_places(const compare::Mesh& mesh) {
  std::vector<std::array<double, 3>> places;
  for (const compare::Vec3& p : mesh.positions) places.push_back({p.x, p.y, p.z});
  std::ranges::sort(places);
  std::size_t repeated = 0;
  for (std::size_t i = 1; i < places.size(); ++i) repeated += places[i] == places[i - 1];
  if (repeated == 0) return {};
  return std::to_string(repeated) + (repeated == 1 ? " vertex has" : " vertices have") +
         " exactly the coordinates of another: faces touch there and do not hang together; --weld merges them";
}

/// Describes how many tetrahedra are flat or inverted, unless all of them are.
std::string wrong_tetrahedra(const compare::LoadedMesh& loaded) {
  compare::Mesh seen = loaded.mesh;
  clear_dust(seen);
  seen.positions = compare::to_double(compare::to_single(seen.positions));
  std::size_t wrong = 0, first = 0;
  for (std::size_t t = 0; t < seen.tetrahedra.size(); ++t) {
    const auto place = [&](std::size_t k) { return seen.positions[static_cast<std::size_t>(seen.tetrahedra[t][k])]; };
    if (compare::orientation(place(0), place(1), place(2), place(3)) > 0) continue;
    if (wrong++ == 0) first = t;
  }
  if (wrong == 0) return {};
  const compare::ElementNames names(loaded.source);
  return std::to_string(wrong) + " of " + std::to_string(seen.tetrahedra.size()) +
         (wrong == 1 ? " tetrahedra is" : " tetrahedra are") + " inverted or flat, the first: " +
         names.tetrahedron(static_cast<compare::Index>(first), seen.tetrahedra[first]) +
         "; the surface is taken as it is, and no solid can rest so";
}

}  // namespace

void expect_solid(const MeshInput& input) {
  std::vector<compare::Problem> problems;
  check_volumes({input.mesh, input.names, 10, problems}, input.mesh.positions);
  if (!problems.empty()) throw compare::InputError(input.source.file + ":\n" + compare::describe(problems));
}

void add_mesh_options(CLI::App& command, compare::MeshOptions& options) {
  command.add_flag("--triangulate,!--no-triangulate", options.triangulate,
                   "Mesh files: faces of four corners and more are cut into triangles, and a note says so (the "
                   "default); --no-triangulate refuses them");
  command.add_flag("--drop-unused,!--no-drop-unused", options.drop_unused,
                   "Mesh files: vertices that no face uses are left out, and a note says so (the default); "
                   "--no-drop-unused refuses them");
  command.add_flag("--strict", options.strict,
                   "Mesh files: faces that name a vertex twice, have no area or are there twice are refused, and so "
                   "are inverted tetrahedra (default: faces are left out, tetrahedra turned, and a note says so)");
  command.add_flag("--weld", options.weld,
                   "Mesh files: vertices with exactly equal coordinates are merged (always in STL and glTF, which "
                   "share no vertices)");
}

std::vector<std::string> words_about(const compare::LoadedMesh& loaded, const std::string& dust_treatment) {
  std::vector<std::string> words = loaded.notes;
  compare::Mesh copy{loaded.mesh.positions, {}, {}};
  const std::string prefix = loaded.source.file.empty() ? "" : loaded.source.file + ": ";
  for (const std::string& word :
       {repeated_places(loaded.mesh), wrong_tetrahedra(loaded), describe(clear_dust(copy), dust_treatment)})
    if (!word.empty()) words.push_back(prefix + word);
  return words;
}

MeshInput read_mesh_input(const std::string& file, const compare::MeshOptions& options) {
  compare::MeshOptions as_stages_see = options;
  as_stages_see.rounded = as_stages_see.local = true;
  compare::LoadedMesh loaded = compare::load_mesh(file, as_stages_see);
  for (const std::string& word : words_about(loaded, "taken as 0")) log_line("ogc: " + word);
  MeshInput input{std::move(loaded.mesh), loaded.source, compare::ElementNames(loaded.source), loaded.origin};
  clear_dust(input.mesh);
  input.mesh.positions = compare::to_double(compare::to_single(input.mesh.positions));
  const std::string problems = compare::describe(compare::validate(input.mesh, 10, input.names));
  if (!problems.empty()) throw compare::InputError(file + ":\n" + problems);
  return input;
}

}  // namespace ogc::experiments
