// The extension decides the format.
#include "compare/files/mesh_files.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "compare/files/bytes.hpp"
#include "compare/files/obj.hpp"
#include "compare/files/ply.hpp"
#include "compare/files/vtp_parse.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

enum class MeshFormat { obj, ply, vtp };

MeshFormat format_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".obj") return MeshFormat::obj;
  if (extension == ".ply") return MeshFormat::ply;
  if (extension == ".vtp") return MeshFormat::vtp;
  throw InputError(path.string() + ": '" + extension + "' is no mesh format; use .obj, .ply or .vtp");
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& path) {
  const MeshFormat format = format_of(path);
  const std::string bytes = read_bytes(path), name = path.string();
  switch (format) {
    case MeshFormat::obj: return parse_obj(bytes, name);
    case MeshFormat::ply: return parse_ply(bytes, name);
    case MeshFormat::vtp: break;
  }
  return parse_vtp(bytes, name);
}

void write_mesh(const std::filesystem::path& path, const Mesh& mesh, PlyEncoding encoding) {
  const MeshFormat format = format_of(path);
  if (format == MeshFormat::vtp) throw InputError(path.string() + ": meshes are written as .obj or .ply");
  write_bytes(path, format == MeshFormat::obj ? print_obj(mesh) : print_ply(mesh, encoding));
}

}  // namespace ogc::compare
