// The extension decides the format.
#include "compare/files/mesh_files.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "compare/files/bytes.hpp"
#include "compare/files/obj.hpp"
#include "compare/files/ply.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

enum class MeshFormat { obj, ply };

MeshFormat format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  throw InputError(path.string() + ": '" + extension + "' is no mesh format; use .obj or .ply");
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& path) {
  const MeshFormat format = format_of(path);
  const std::string bytes = read_bytes(path), name = path.string();
  return format == MeshFormat::obj ? parse_obj(bytes, name) : parse_ply(bytes, name);
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, PlyEncoding encoding) {
  write_bytes(path, format_of(path) == MeshFormat::obj ? print_obj(mesh) : print_ply(mesh, encoding));
}

}  // namespace ogc::compare
