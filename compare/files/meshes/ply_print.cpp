// Stores positions as double, so that reading gives the same mesh bit for bit.
#include <array>
#include <bit>

#include "compare/files/meshes/ply.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

std::string header(const Mesh& mesh, PlyEncoding encoding) {
  constexpr bool little = std::endian::native == std::endian::little;
  std::string text = "ply\nformat ";
  text += encoding == PlyEncoding::ascii ? "ascii" : little ? "binary_little_endian" : "binary_big_endian";
  text += " 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
          "\nproperty double x\nproperty double y\nproperty double z\n";
  text += "element face " + std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\n";
  if (!mesh.loose_edges.empty())
    text += "element edge " + std::to_string(mesh.loose_edges.size()) +
            "\nproperty int vertex1\nproperty int vertex2\n";
  return text + "end_header\n";
}

template <class Number>
void append(std::string& bytes, Number value) {
  const auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  bytes.append(raw.data(), raw.size());
}

void append_binary(std::string& bytes, const Mesh& mesh) {
  for (const Vec3& v : mesh.positions) {
    for (const double x : {v.x, v.y, v.z}) append(bytes, x);
  }
  for (const Triangle& t : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    for (const Index i : t) append(bytes, i);
  }
  for (const Edge& e : mesh.loose_edges) {
    for (const Index i : e) append(bytes, i);
  }
}

void append_ascii(std::string& text, const Mesh& mesh) {
  for (const Vec3& v : mesh.positions) text += shortest(v.x) + ' ' + shortest(v.y) + ' ' + shortest(v.z) + '\n';
  for (const auto& [a, b, c] : mesh.triangles)
    text += "3 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
  for (const auto& [a, b] : mesh.loose_edges) text += std::to_string(a) + ' ' + std::to_string(b) + '\n';
}

}  // namespace

std::string print_ply(const Mesh& mesh, PlyEncoding encoding) {
  std::string bytes = header(mesh, encoding);
  encoding == PlyEncoding::ascii ? append_ascii(bytes, mesh) : append_binary(bytes, mesh);
  return bytes;
}

}  // namespace ogc::compare
