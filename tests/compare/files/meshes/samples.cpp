#include "tests/compare/files/meshes/samples.hpp"

#include <initializer_list>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/problem/error.hpp"

namespace ogc::tests {
namespace {

/// Tetrahedra of the unit cube; bits of v are the coordinates x, y, z of corner v. All tetrahedra have the diagonal 0 7
/// and positive volume.
constexpr std::array<std::array<int, 4>, 6> cube{
    {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}}};

int coordinate(int v, int axis) { return v >> axis & 1; }

std::string words(std::initializer_list<int> numbers) {
  std::string text;
  for (const int number : numbers) text += (text.empty() ? "" : " ") + std::to_string(number);
  return text + "\n";
}

std::string vertex_lines(bool has_reference) {
  std::string text;
  for (int v = 0; v < 8; ++v) {
    text += std::to_string(coordinate(v, 0)) + " " + std::to_string(coordinate(v, 1)) + " " +
            std::to_string(coordinate(v, 2)) + (has_reference ? " 0\n" : "\n");
  }
  return text;
}

std::string base64(const std::string& bytes) {
  constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? alphabet[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

}  // namespace

std::string error_of(const std::string& bytes, const std::string& name) {
  try {
    make_mesh(compare::parse_polygon_mesh(bytes, name));
  } catch (const compare::InputError& error) {
    return error.what();
  }
  return "";
}

std::string square_stl() {
  std::string text = "solid square of two\n";
  for (std::size_t k = 0; k < square_corners.size(); ++k) {
    if (k % 3 == 0) text += " facet normal 0 0 1\n  outer loop\n";
    const auto& [x, y, z] = square_corners[k];
    text += "   vertex " + words({x, y, z});
    if (k % 3 == 2) text += "  endloop\n endfacet\n";
  }
  return text + "endsolid square of two\n";
}

std::string binary_stl(std::uint32_t announced) {
  std::string bytes(80, ' ');
  append_number(bytes, announced);
  for (std::size_t k = 0; k < square_corners.size(); ++k) {
    if (k % 3 == 0) bytes += std::string(12, '\0');
    for (const int x : square_corners[k]) append_number(bytes, static_cast<float>(x));
    if (k % 3 == 2) bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string gltf_data() {
  std::string bytes;
  for (const std::array<float, 3>& p : {std::array{0.F, 0.F, 0.F}, {1.F, 0.F, 0.F}, {1.F, 1.F, 0.F}, {0.F, 1.F, 0.F}})
    for (const float x : p) append_number(bytes, x);
  for (const int corner : {0, 1, 2, 0, 2, 3}) append_number(bytes, static_cast<std::uint16_t>(corner));
  return bytes;
}

std::string base64_uri(const std::string& bytes) {
  return "\"uri\":\"data:application/octet-stream;base64," + base64(bytes) + "\",";
}

std::string square_gltf(const std::string& uri) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[1]}],)"
         R"("nodes":[{"mesh":0,"matrix":[0,1,0,0,-1,0,0,0,0,0,1,0,0,0,0,1]},)"
         R"({"children":[2],"translation":[0,0,3]},{"children":[0],"scale":[1,2,1]}],)"
         R"("meshes":[{"primitives":[{"indices":1,"attributes":{"POSITION":0}}]}],"accessors":[)"
         R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],"bufferViews":[)"
         R"({"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],"buffers":[{)" +
         uri + R"("byteLength":60}]})";
}

std::string square_glb() {
  std::string json = square_gltf("");
  json += std::string((4 - json.size() % 4) % 4, ' ');
  const std::string data = gltf_data();
  std::string bytes = "glTF";
  for (const std::size_t number : {std::size_t{2}, 28 + json.size() + data.size(), json.size()})
    append_number(bytes, static_cast<std::uint32_t>(number));
  bytes += "JSON" + json;
  append_number(bytes, static_cast<std::uint32_t>(data.size()));
  return bytes + std::string("BIN\0", 4) + data;
}

std::string binary_msh(bool is_new, std::endian order) {
  std::string bytes = std::string("$MeshFormat\n") + (is_new ? "4.1" : "2.2") + " 1 8\n";
  const auto put = [&](std::initializer_list<int> numbers) {
    for (const int number : numbers) append_number(bytes, static_cast<std::int32_t>(number), order);
  };
  const auto put_wide = [&](std::initializer_list<int> numbers) {
    for (const int number : numbers) append_number(bytes, static_cast<std::uint64_t>(number), order);
  };
  const auto put_place = [&](int v) {
    for (int axis = 0; axis < 3; ++axis) append_number(bytes, static_cast<double>(coordinate(v, axis)), order);
  };
  put({1});
  bytes += "\n$EndMeshFormat\n$PhysicalNames\n1\n3 1 \"block\"\n$EndPhysicalNames\n$Nodes\n";
  if (is_new) {
    put_wide({1, 8, 1, 8}), put({3, 1, 0}), put_wide({8, 1, 2, 3, 4, 5, 6, 7, 8});
  } else {
    bytes += "8\n";
  }
  for (int v = 0; v < 8; ++v) {
    if (!is_new) put({v + 1});
    put_place(v);
  }
  bytes += "\n$EndNodes\n$Elements\n";
  if (is_new) {
    put_wide({2, 7, 1, 7}), put({2, 1, 2}), put_wide({1, 1, 1, 2, 3}), put({3, 1, 4}), put_wide({6});
  } else {
    bytes += "7\n";
    put({2, 1, 2, 1, 0, 0, 1, 2, 3, 4, 6, 0});
  }
  int tag = 2;
  for (const auto& [a, b, c, d] : cube) {
    is_new ? put_wide({tag, a + 1, b + 1, c + 1, d + 1}) : put({tag, a + 1, b + 1, c + 1, d + 1});
    ++tag;
  }
  return bytes + "\n$EndElements\n";
}

std::string cube_medit() {
  std::string text = "MeshVersionFormatted 2\n# a cube\nDimension\n3\nVertices\n8\n" + vertex_lines(true);
  text += "Triangles\n1\n1 2 4 5\nEdges 1\n1 2 0\nRequiredVertices 2 1 2\nTetrahedra\n6\n";
  for (const auto& [a, b, c, d] : cube) text += words({a + 1, b + 1, c + 1, d + 1, 0});
  return text + "End\n";
}

std::string cube_vtk(bool is_binary, bool is_new) {
  std::string bytes = std::string("# vtk DataFile Version ") + (is_new ? "5.1" : "3.0") + "\na cube\n" +
                      (is_binary ? "BINARY" : "ASCII") +
                      "\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 1\nTIME 1 1 int\n";
  const auto put = [&](auto number) {
    is_binary ? append_number(bytes, number, std::endian::big) : void(bytes += std::to_string(number) + " ");
  };
  const auto index = [&](int number) {
    is_new ? put(static_cast<std::int64_t>(number)) : put(static_cast<std::int32_t>(number));
  };
  put(std::int32_t{7});
  bytes += "\nPOINTS 8 double\n";
  for (int v = 0; v < 8; ++v)
    for (int axis = 0; axis < 3; ++axis) put(static_cast<double>(coordinate(v, axis)));
  bytes += is_new ? "\nCELLS 7 24\nOFFSETS vtktypeint64\n" : "\nCELLS 6 30\n";
  for (int end = 0; is_new && end <= 24; end += 4) index(end);
  if (is_new) bytes += "\nCONNECTIVITY vtktypeint64\n";
  for (const auto& corners : cube) {
    if (!is_new) index(4);
    for (const int v : corners) index(v);
  }
  bytes += "\nCELL_TYPES 6\n";
  for (int k = 0; k < 6; ++k) put(std::int32_t{10});
  return bytes + "\nPOINT_DATA 8\nSCALARS none float\n";
}

std::string cube_vtu() {
  std::string corners, ends, kinds;
  int end = 0;
  for (const auto& [a, b, c, d] : cube) {
    corners += words({a, b, c, d});
    ends += words({end += 4});
    kinds += "10 ";
  }
  const auto array = [](const std::string& type, const std::string& name, const std::string& text) {
    return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">\n" + text + "</DataArray>\n";
  };
  return "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n<Piece><Points>" +
         array("Float64", "Points", vertex_lines(false)) + "</Points><Cells>" +
         array("Int64", "connectivity", corners) + array("Int64", "offsets", ends) + array("UInt8", "types", kinds) +
         "</Cells></Piece></UnstructuredGrid></VTKFile>\n";
}

}  // namespace ogc::tests
