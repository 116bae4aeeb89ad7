// Scene files: JSON that references meshes. Strict: an unknown key, a wrong type, a value out of range or a missing
// file is an error that names the file and the path inside it.
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

/// A newer file is refused by name. From format 2 on bodies may have tetrahedra, materials `solid_…`, and a body may be
/// a volume by its `contact`, and its loose edges a rod by its material's `rod`, with `orientations` in a file of its
/// own. The scene's `body_pairs` (empty) is reserved: a reader refuses what it does not simulate by name.
inline constexpr int scene_format_version = 2;

/// Reads and validates a scene file; dust of its meshes becomes 0 (compare/problem/dust.hpp). Throws InputError that
/// lists every problem found.
Scene read_scene(const std::filesystem::path& file);

/// What a scene file says beyond the scene.
struct SceneFile {
  Scene scene;                     ///< as it was read, valid or not
  MeshSources sources;             ///< where the bodies' elements stand in their files
  std::vector<std::string> notes;  ///< a sentence about whatever was taken otherwise than it stands
  Vec3 origin{};                   ///< what positions are relative to, in the coordinates of a mesh's file [m]
};

/// The same, with all of that.
SceneFile load_scene_file(const std::filesystem::path& file);

/// Writes `folder`/NAME.json and one PLY, of a solid one MSH, a body (positions and, where they differ, rest
/// positions). Returns the path of the JSON file.
std::filesystem::path write_scene(const std::filesystem::path& folder, const Scene& scene);

/// `excluded_pairs` of a scene file: runs of pairs of the same two bodies, in their order. Vertices are numbered within
/// each body.
nlohmann::ordered_json excluded_pairs_json(std::span<const Body> bodies, std::span<const std::array<Index, 2>> pairs);

/// The JSON Schema of scene files.
std::string scene_schema();

}  // namespace ogc::compare
