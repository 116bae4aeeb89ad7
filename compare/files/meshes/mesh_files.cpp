// The extension decides the format.
#include "compare/files/meshes/mesh_files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include "compare/files/bytes.hpp"
#include "compare/files/meshes/assimp_mesh.hpp"
#include "compare/files/meshes/msh.hpp"
#include "compare/files/meshes/obj.hpp"
#include "compare/files/meshes/ply.hpp"
#include "compare/files/meshes/vtp_parse.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

enum class MeshFormat { obj, ply, vtp, msh, stl, off, gltf, glb };
constexpr std::array<std::string_view, 8> extensions{".obj", ".ply", ".vtp",  ".msh",
                                                     ".stl", ".off", ".gltf", ".glb"};  // by MeshFormat

std::string lower_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::optional<MeshFormat> format_of(const std::filesystem::path& path) {
  const auto found = std::ranges::find(extensions, lower_extension(path));
  if (found == extensions.end()) return std::nullopt;
  return static_cast<MeshFormat>(found - extensions.begin());
}

/// The mesh that assimp read of an OFF file; throws InputError where faces are missing, as assimp drops those of more
/// than nine corners without a word. The file's number of faces is the second number after the word that ends in OFF;
/// binary files have none there.
PolygonMesh whole_off(PolygonMesh mesh, const std::string& bytes) {
  std::istringstream lines(bytes);
  std::string line, header;
  for (int kept = 0; kept < 3 && std::getline(lines, line);) {
    line.erase(std::min(line.find('#'), line.size()));
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    header += line + " ";
    ++kept;
  }
  std::istringstream words(header);
  std::size_t vertices = 0, faces = 0;
  if (!(words >> line >> vertices >> faces) || !line.ends_with("OFF")) return mesh;
  if (faces <= mesh.face_count() + mesh.loose_edges.size()) return mesh;
  throw InputError(mesh.source.file + ": has " + std::to_string(faces) + " faces, and assimp reads " +
                   std::to_string(mesh.face_count()) +
                   ": it leaves out those of more than nine corners. Cut them, or convert the mesh to .ply");
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string() + ": '" + path.extension().string() + "' is no mesh format" + what);
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) { return format_of(path).has_value(); }

PolygonMesh read_polygon_mesh(const std::filesystem::path& path) {
  const std::optional<MeshFormat> format = format_of(path);
  if (!format) fail(path, "; use .obj, .ply, .vtp, .stl, .off, .gltf or .glb, of tetrahedra .msh");
  const std::string bytes = read_bytes(path), name = path.string();
  switch (*format) {
    case MeshFormat::obj: return parse_obj(bytes, name);
    case MeshFormat::ply: return parse_ply(bytes, name);
    case MeshFormat::vtp: return parse_vtp(bytes, name);
    case MeshFormat::msh: return parse_msh(bytes, name);
    case MeshFormat::stl:
    case MeshFormat::gltf:
    case MeshFormat::glb: return read_with_assimp(path, false);
    case MeshFormat::off: return whole_off(read_with_assimp(path, true), bytes);
  }
  fail(path, "");
}

LoadedMesh load_mesh(const std::filesystem::path& path, const MeshOptions& options) {
  return make_mesh(read_polygon_mesh(path), options);
}

Mesh read_mesh(const std::filesystem::path& path) { return load_mesh(path).mesh; }

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, PlyEncoding encoding) {
  const std::optional<MeshFormat> format = format_of(path);
  if (format == MeshFormat::obj) return write_bytes(path, print_obj(mesh));
  if (format == MeshFormat::ply) return write_bytes(path, print_ply(mesh, encoding));
  if (format == MeshFormat::msh) return write_bytes(path, print_msh(mesh));
  fail(path, " that is written; use .obj or .ply, of tetrahedra .msh");
}

}  // namespace ogc::compare
