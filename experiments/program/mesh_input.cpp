#include "experiments/program/mesh_input.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/problem/dust.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/scene.hpp"
#include "compare/problem/validate.hpp"
#include "experiments/program/output.hpp"

namespace ogc::experiments {

namespace {

/// Says how many vertices share a position. Modellers write a vertex once for each face that bends there; such faces
/// touch, and nothing holds them together.
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

}  // namespace

void add_mesh_options(CLI::App& command, compare::MeshOptions& options) {
  command.add_flag("--triangulate,!--no-triangulate", options.triangulate,
                   "Mesh files: cut faces of four corners and more into triangles, with a word "
                   "(the default; --no-triangulate refuses them)");
  command.add_flag(
      "--drop-unused,!--no-drop-unused", options.drop_unused,
      "Mesh files: leave out vertices that no face uses, with a word (the default; --no-drop-unused refuses them)");
  command.add_flag(
      "--weld", options.weld,
      "Mesh files: merge vertices with exactly equal coordinates (STL and glTF have no shared vertices: always)");
}

std::vector<std::string> words_about(const compare::LoadedMesh& loaded, const std::string& dust_treatment) {
  std::vector<std::string> words = loaded.notes;
  compare::Mesh copy{loaded.mesh.positions, {}, {}};
  const std::string prefix = loaded.source.file.empty() ? "" : loaded.source.file + ": ";
  for (const std::string& word : {repeated_places(loaded.mesh), describe(clear_dust(copy), dust_treatment)})
    if (!word.empty()) words.push_back(prefix + word);
  return words;
}

MeshInput read_mesh_input(const std::string& file, const compare::MeshOptions& options) {
  compare::LoadedMesh loaded = compare::load_mesh(file, options);
  for (const std::string& word : words_about(loaded, "taken as 0")) log_line("ogc: " + word);
  MeshInput input{std::move(loaded.mesh), loaded.source, compare::ElementNames(loaded.source)};
  clear_dust(input.mesh);
  input.mesh.positions = compare::to_double(compare::to_single(input.mesh.positions));
  const std::string problems = compare::describe(compare::validate(input.mesh, 10, input.names));
  if (!problems.empty()) throw compare::InputError(file + ":\n" + problems);
  return input;
}

}  // namespace ogc::experiments
