// The extension decides the format.
#include "compare/files/meshes/mesh_files.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>

#include "compare/files/bytes.hpp"
#include "compare/files/meshes/gltf.hpp"
#include "compare/files/meshes/medit.hpp"
#include "compare/files/meshes/msh.hpp"
#include "compare/files/meshes/obj.hpp"
#include "compare/files/meshes/off.hpp"
#include "compare/files/meshes/ply.hpp"
#include "compare/files/meshes/stl.hpp"
#include "compare/files/meshes/vtk_legacy.hpp"
#include "compare/files/meshes/vtk_mesh.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

enum class MeshFormat { obj, ply, vtp, vtu, vtk, msh, medit, stl, off, gltf, glb };
constexpr std::array<std::string_view, 11> extensions{".obj",  ".ply", ".vtp", ".vtu",  ".vtk", ".msh",
                                                      ".mesh", ".stl", ".off", ".gltf", ".glb"};  // by MeshFormat

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

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError(path.string() + ": '" + path.extension().string() + "' is no mesh format" + what);
}

}  // namespace

std::vector<std::string> mesh_extensions() { return {extensions.begin(), extensions.end()}; }

bool is_mesh_file(const std::filesystem::path& path) { return format_of(path).has_value(); }

PolygonMesh parse_polygon_mesh(std::string_view bytes, const std::string& name) {
  const std::optional<MeshFormat> format = format_of(name);
  if (!format) fail(name, "; use .obj, .ply, .vtp, .stl, .off, .gltf or .glb, of tetrahedra .msh, .mesh, .vtk or .vtu");
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);  // the byte order mark of UTF-8
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    throw InputError(name + ": begins as text in UTF-16 does; save it as UTF-8");
  switch (*format) {
    case MeshFormat::obj: return parse_obj(bytes, name);
    case MeshFormat::ply: return parse_ply(bytes, name);
    case MeshFormat::vtp:
    case MeshFormat::vtu: return parse_vtk_xml_mesh(bytes, name);
    case MeshFormat::vtk: return parse_vtk_legacy(bytes, name);
    case MeshFormat::msh: return parse_msh(bytes, name);
    case MeshFormat::medit: return parse_medit(bytes, name);
    case MeshFormat::stl: return parse_stl(bytes, name);
    case MeshFormat::off: return parse_off(bytes, name);
    case MeshFormat::gltf:
    case MeshFormat::glb: return parse_gltf(bytes, name);
  }
  fail(name, "");
}

PolygonMesh read_polygon_mesh(const std::filesystem::path& path) {
  return parse_polygon_mesh(is_mesh_file(path) ? read_bytes(path) : "", path.string());
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
