// Reads and writes scene files: JSON that references meshes. Reading is strict: an unknown key, a wrong type, a value
// out of range or a missing file is an error that names the file and the path inside it.
#pragma once

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compare/problem/element_names.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Newest version of the format that is read. For a newer file the error names the file's version. Since version 2:
/// - bodies may have tetrahedra, and materials may have `solid_…`
/// - `body_contact` may make a body a volume
/// - a material's `rod` makes the body's loose edges a rod, whose `orientations` are in a file of their own
/// The scene's `body_pairs` is reserved and must be empty: the reader refuses what this program does not simulate.
inline constexpr int scene_format_version = 2;

/// Reads and validates a scene file; dust of its meshes becomes 0 (compare/problem/dust.hpp). Throws InputError that
/// lists every problem found.
Scene read_scene(const std::filesystem::path& file);

/// Holds a scene, and what is known about the files that it was read from.
struct SceneFile {
  Scene scene;                     ///< the valid scene, rounded to single precision
  MeshSources sources;             ///< places of the bodies' elements in their files
  std::vector<std::string> notes;  ///< a sentence for each difference from the file
  Vec3 origin{};                   ///< point that positions are relative to, in the coordinates of a mesh's file [m]
};

/// Reads and validates a scene file as read_scene does, but also returns sources, notes and origin.
SceneFile load_scene_file(const std::filesystem::path& file);

/// Writes `folder`/NAME.json and the meshes of each body: a PLY or, for a solid, an MSH. Rest positions and velocities
/// have further files if needed. Returns the path of the JSON file.
std::filesystem::path write_scene(const std::filesystem::path& folder, const Scene& scene);

/// Returns the `excluded_pairs` of a scene file. Successive pairs between the same two bodies share one entry; entries
/// keep the order of `pairs`. Vertices are numbered within each body.
nlohmann::ordered_json excluded_pairs_json(std::span<const Body> bodies, std::span<const std::array<Index, 2>> pairs);

/// Returns the JSON Schema of scene files.
std::string scene_schema();

}  // namespace ogc::compare
