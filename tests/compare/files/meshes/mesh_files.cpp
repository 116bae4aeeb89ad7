// Tests round trips bit for bit, files as other programs write them, and errors in mesh files.
#include "compare/files/meshes/mesh_files.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>

#include "compare/files/bytes.hpp"
#include "compare/files/meshes/obj.hpp"
#include "compare/files/meshes/ply.hpp"
#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/scratch.hpp"

using namespace ogc::compare;
using ogc::tests::Scratch;

namespace {

const std::vector<Triangle> two_triangles{{0, 1, 2}, {0, 2, 3}};
const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

// Returns a mesh of difficult doubles: thirds, signed zeros, the ends of the range, values with all 53 bits.
Mesh awkward_mesh() {
  Mesh mesh;
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) {
    const auto draw = [&] { return std::uniform_real_distribution<double>(-1, 1)(random) * std::exp2(i % 40 - 20); };
    mesh.positions.push_back({draw(), draw(), draw()});
  }
  mesh.positions[0] = {-0.0, 1.0 / 3, 0x1p20};
  mesh.positions[1] = {0x1p-20, -1e-5, 123456.789};
  for (Index i = 0; i + 4 < 200; ++i) mesh.triangles.push_back({i + 1, i, i + 2});
  mesh.loose_edges = {{196, 198}, {197, 199}};
  return mesh;
}

Mesh of_obj(const std::string& text) { return make_mesh(parse_obj(text, "test")).mesh; }

Mesh of_ply(const std::string& bytes) { return make_mesh(parse_ply(bytes, "test")).mesh; }

bool same_bits(const Mesh& a, const Mesh& b) {
  const auto bits = [](const Vec3& p, const Vec3& q) {
    using Bits = std::array<std::uint64_t, 3>;
    return std::bit_cast<Bits>(p) == std::bit_cast<Bits>(q);
  };
  return a.triangles == b.triangles && a.loose_edges == b.loose_edges &&
         std::equal(a.positions.begin(), a.positions.end(), b.positions.begin(), b.positions.end(), bits);
}

template <class Number>
void append(std::string& bytes, Number value, bool big_endian) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if (big_endian == (std::endian::native == std::endian::little)) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

// Returns a square in a file such as scanners write: single precision, colours, a list of confidences, a user element
// before the faces, a quality after each face.
std::string foreign_ply(bool big_endian) {
  std::string bytes = std::string("ply\r\nformat binary_") + (big_endian ? "big" : "little") +
                      "_endian 1.0\r\ncomment made by hand\r\nobj_info nothing\r\nelement vertex 4\r\nproperty float "
                      "x\r\nproperty float y\r\n"
                      "property float z\r\nproperty uchar red\r\nproperty list uchar short confidence\r\nelement "
                      "camera 2\r\nproperty double view\r\n"
                      "property list uint uchar name\r\nelement face 2\r\nproperty list uchar uint "
                      "vertex_index\r\nproperty float quality\r\nend_header\r\n";
  int i = 0;
  for (const Vec3& v : square) {
    for (const double x : {v.x, v.y, v.z}) append(bytes, static_cast<float>(x), big_endian);
    append(bytes, std::uint8_t{10}, big_endian);
    append(bytes, static_cast<std::uint8_t>(i), big_endian);
    for (int k = 0; k < i; ++k) append(bytes, static_cast<std::int16_t>(-k), big_endian);
    ++i;
  }
  for (int camera = 0; camera < 2; ++camera) {
    append(bytes, 0.5, big_endian);
    append(bytes, std::uint32_t{5}, big_endian);
    bytes += "\n end";
  }
  for (const Triangle& t : two_triangles) {
    append(bytes, std::uint8_t{3}, big_endian);
    for (const Index v : t) append(bytes, static_cast<std::uint32_t>(v), big_endian);
    append(bytes, 1.0f, big_endian);
  }
  return bytes;
}

std::string ascii_ply(const std::string& vertices, const std::string& faces, int vertex_count = 4, int face_count = 2) {
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertex_count) +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + std::to_string(face_count) +
         "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces;
}

const std::string square_text = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

}  // namespace

TEST_CASE("a mesh comes back bit for bit from OBJ, ascii PLY and binary PLY", "[unit]") {
  const Scratch scratch;
  const Mesh mesh = awkward_mesh();
  write_mesh(scratch / "mesh.obj", mesh);
  write_mesh(scratch / "ascii.ply", mesh, PlyEncoding::ascii);
  write_mesh(scratch / "binary.PLY", mesh);
  for (const char* name : {"mesh.obj", "ascii.ply", "binary.PLY"}) {
    INFO(name);
    CHECK(same_bits(read_mesh(scratch / name), mesh));
  }
}

TEST_CASE(
    "OBJ as other programs write it: attributes, normals, groups, comments, tabs, carriage returns, negative indices, "
    "polylines",
    "[unit]") {
  const Mesh mesh = of_obj(
      "# a square and a yarn\r\nmtllib none.mtl\r\no sheet\r\nv 0 0 0\r\nv\t1 0 0 1.0\r\nv 1 1 0 0.5 0.5 0.5\r\nv +0 "
      "1e0 0 # last\r\nvt 0 0\r\n"
      "vn 0 0 1\r\ns off\r\nusemtl none\r\n\r\nf 1/1 2/1/1 3//1\r\nf -4 -2/1 -1\r\nv 2 0 0\r\nv 3 0 0\r\nv 4 0 0\r\nl "
      "7 6 5\r\n");
  CHECK(mesh.triangles == two_triangles);
  CHECK(mesh.loose_edges == std::vector<Edge>{{5, 6}, {4, 5}});
  REQUIRE(mesh.positions.size() == 7);
  CHECK(std::equal(square.begin(), square.end(), mesh.positions.begin()));
}

TEST_CASE("faces may stand before their vertices in OBJ, and the last line needs no line break", "[unit]") {
  const Mesh mesh = of_obj("f 1 2 3\nf 1 3 4\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0");
  CHECK(mesh.triangles == two_triangles);
  CHECK(mesh.positions == square);
}

TEST_CASE("broken OBJ files are refused with the line and the reason", "[unit]") {
  const auto parse = [](const std::string& text) { return parse_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\n" + text, "bad.obj"); };
  CHECK_THROWS_WITH(parse("f 1 2 4"), ContainsSubstring("bad.obj: line 4: vertex 4 does not exist; the file has 3"));
  CHECK_THROWS_WITH(parse("f 1 2 -4"), ContainsSubstring("line 4: vertex -4 does not exist"));
  CHECK_THROWS_WITH(parse("f 1 2 0"), ContainsSubstring("line 4: '0' is no vertex; count from 1"));
  CHECK_THROWS_WITH(parse("f 1 2 x"), ContainsSubstring("'x' is no vertex"));
  CHECK_THROWS_WITH(parse("f 1 2 99999999999"), ContainsSubstring("vertex 99999999999 does not exist"));
  CHECK_THROWS_WITH(parse("f 1 2"), ContainsSubstring("a face has three corners or more"));
  CHECK_THROWS_WITH(parse("l 1"), ContainsSubstring("a line has at least two vertices"));
  CHECK_THROWS_WITH(parse("\nl 1 7"), ContainsSubstring("line 5: vertex 7 does not exist"));
  CHECK_THROWS_WITH(parse("v 0 0"), ContainsSubstring("'' is no finite coordinate"));
  CHECK_THROWS_WITH(parse("v 0 nan 0"), ContainsSubstring("'nan' is no finite coordinate"));
  CHECK_THROWS_WITH(parse("v 0 0 inf"), ContainsSubstring("'inf' is no finite coordinate"));
  CHECK_THROWS_WITH(parse("v 0 0 1e999"), ContainsSubstring("'1e999' is no finite coordinate"));
  CHECK_THROWS_WITH(parse("v 0,5 0 1"), ContainsSubstring("'0,5' is no finite coordinate"));
  CHECK_THROWS_WITH(parse("curv 0 1 1 2"), ContainsSubstring("'curv' is not supported"));
}

TEST_CASE("PLY as other programs write it: single precision, either byte order, unknown properties, lists and elements",
          "[unit]") {
  for (const bool big_endian : {false, true}) {
    const Mesh mesh = of_ply(foreign_ply(big_endian));
    CHECK(mesh.positions == square);
    CHECK(mesh.triangles == two_triangles);
    CHECK(mesh.loose_edges.empty());
  }
}

TEST_CASE("ascii PLY: edges, properties in any order, sized type names", "[unit]") {
  const Mesh mesh = of_ply(
      "ply\nformat ascii 1.0\nelement edge 2\nproperty uint8 red\nproperty int32 vertex2\nproperty int32 "
      "vertex1\nelement vertex 3\n"
      "property float64 z\nproperty float32 x\nproperty int16 y\nend_header\n7 0 1\n9 1 2\n 3 1 2 6 4 5\n9 7 8\n");
  CHECK(mesh.loose_edges == std::vector<Edge>{{0, 1}, {1, 2}});
  CHECK(mesh.positions == std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}});
}

TEST_CASE("a PLY file cut anywhere is refused, in every encoding", "[unit]") {
  const Mesh mesh{square, two_triangles, {}};
  for (const std::string& whole :
       {print_ply(mesh, PlyEncoding::ascii), print_ply(mesh, PlyEncoding::binary), foreign_ply(true)}) {
    const std::size_t last = whole.find_last_not_of('\n');
    for (std::size_t size = 0; size <= last; ++size) {
      INFO(size << " of " << whole.size() << " bytes");
      CHECK_THROWS_AS(parse_ply(whole.substr(0, size), "cut.ply"), InputError);
    }
  }
  const std::string binary = print_ply(mesh, PlyEncoding::binary);
  CHECK_THROWS_WITH(parse_ply(binary.substr(0, binary.size() - 1), "cut.ply"),
                    ContainsSubstring("cut.ply: face 1: the file ends here, with 2 entries announced"));
  CHECK_THROWS_WITH(parse_ply(binary + "abc", "long.ply"),
                    ContainsSubstring("long.ply: 3 bytes follow the last element"));
}

TEST_CASE("broken PLY files are refused with the element and the reason", "[unit]") {
  const auto parse = [](const std::string& text) { return parse_ply(text, "bad.ply"); };
  CHECK_THROWS_WITH(parse("obj\n"), ContainsSubstring("bad.ply: header line 1: does not begin with 'ply'"));
  CHECK_THROWS_WITH(parse("ply\nformat ascii 2.0\n"), ContainsSubstring("unknown version '2.0'"));
  CHECK_THROWS_WITH(parse("ply\nformat text 1.0\n"), ContainsSubstring("unknown format 'text'"));
  CHECK_THROWS_WITH(parse("ply\nend_header\n"), ContainsSubstring("has no 'format' line"));
  CHECK_THROWS_WITH(parse("ply\nformat ascii 1.0\nelement vertex many\n"),
                    ContainsSubstring("element 'vertex' has no count"));
  CHECK_THROWS_WITH(parse("ply\nformat ascii 1.0\nelement vertex 99999999999\n"),
                    ContainsSubstring("too many entries"));
  CHECK_THROWS_WITH(parse("ply\nformat ascii 1.0\nproperty float x\n"),
                    ContainsSubstring("a property before the first element"));
  CHECK_THROWS_WITH(parse("ply\nformat ascii 1.0\nelement vertex 1\nproperty real x\n"),
                    ContainsSubstring("header line 4: unknown type 'real'"));
  CHECK_THROWS_WITH(parse("ply\nformat ascii 1.0\nthing\n"), ContainsSubstring("'thing' does not belong there"));
  CHECK_THROWS_WITH(parse("ply\nformat ascii 1.0\nelement tristrips 1\n"),
                    ContainsSubstring("triangle strips are not supported"));
  CHECK_THROWS_WITH(
      parse("ply\nformat ascii 1.0\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n"),
      ContainsSubstring("has no element 'vertex'"));
  CHECK_THROWS_WITH(parse("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nend_header\n"),
                    ContainsSubstring("has no property 'z'"));
  CHECK_THROWS_WITH(parse("ply\nformat ascii 1.0\nelement face 0\nproperty int vertex_indices\nend_header\n"),
                    ContainsSubstring("no list property 'vertex_indices'"));
  CHECK_THROWS_WITH(parse(ascii_ply(square_text, "3 0 1 2\n3 0 2 4\n")),
                    ContainsSubstring("bad.ply: face 1: vertex 4 does not exist; the file has 4, numbered from 0"));
  CHECK_THROWS_WITH(parse(ascii_ply(square_text, "3 0 1 2\n3 0 -2 3\n")),
                    ContainsSubstring("face 1: a vertex index is negative"));
  CHECK_THROWS_WITH(parse(ascii_ply(square_text, "3 0 1 2\n3 0 1.5 3\n")), ContainsSubstring("no whole number"));
  CHECK_THROWS_WITH(parse(ascii_ply(square_text, "2 0 1\n3 0 2 3\n")),
                    ContainsSubstring("face 0: has 2 corners; a face has three or more"));
  CHECK_THROWS_WITH(parse(ascii_ply(square_text, "-1\n3 0 2 3\n")),
                    ContainsSubstring("face 0: a list of negative length"));
  CHECK_THROWS_WITH(parse(ascii_ply("0 0 0\n1 nan 0\n1 1 0\n0 1 0\n", "3 0 1 2\n3 0 2 3\n")),
                    ContainsSubstring("vertex 1: a coordinate is not finite"));
  CHECK_THROWS_WITH(parse(ascii_ply("0 0 0\n1 ? 0\n1 1 0\n0 1 0\n", "3 0 1 2\n3 0 2 3\n")),
                    ContainsSubstring("vertex 1: what stands there is no number: '?' is no finite"));
  CHECK_THROWS_WITH(
      parse(ascii_ply("0 0 0\n1 -1.#IND 0\n1 1 0\n0 1 0\n", "3 0 1 2\n3 0 2 3\n")),
      ContainsSubstring("vertex 1: what stands there is no number: '-1.#IND' is no finite coordinate but what "
                        "programs for Windows print"));
}

TEST_CASE("numbers of Windows that are none are refused as such, and are no comments", "[unit]") {
  const auto parse = [](const std::string& x) { return parse_obj("v 0 0 " + x + "\n", "bad.obj"); };
  for (const std::string word :
       {"-1.#IND", "1.#INF", "1.#QNAN", "1.#QNAN0", "-1.#IND00", "1.#R", "-1.#J", "-1.#ind", "1.#INF000e+000"})
    CHECK_THROWS_WITH(parse(word),
                      ContainsSubstring("bad.obj: line 1: '" + word +
                                        "' is no finite coordinate but what programs for Windows print for "
                                        "infinity or for no number"));
  for (const char* comment : {"1#corner", "1.# corner", "1. #IND", "1 # 1.#IND", "1.#"})
    CHECK(parse(comment).positions == std::vector<Vec3>{{0, 0, 1}});
}

TEST_CASE("lines of OBJ that go on behind a backslash are one, and errors name the line of the word", "[unit]") {
  const std::string text =
      "# a comment does not go on \\\nv 0 \\\n 0 0\nv 1 0\\\r\n 0\nv 1 1 0 \\\n 0.5 0.5 0.5\nv 0 1 0\nvn 0 0 \\\n 1\n"
      "f 1/1 2/1 \\\n\\\n 3/1\nf 1 3 \\\n 4\n";
  const PolygonMesh mesh = parse_obj(text, "m.obj");
  CHECK(mesh.positions == square);
  CHECK(make_mesh(mesh).mesh.triangles == two_triangles);
  CHECK(mesh.source.face_lines == std::vector<std::size_t>{11, 14});
  CHECK_THROWS_WITH(parse_obj("v 0 \\\n zero 0\n", "m.obj"), ContainsSubstring("m.obj: line 2: 'zero' is no finite"));
  CHECK_THROWS_WITH(parse_obj("v 0 0 \\", "m.obj"), ContainsSubstring("m.obj: line 1: '' is no finite"));
}

TEST_CASE("lines end with a line feed, a carriage return or both, and a byte order mark is none of a file's words",
          "[unit]") {
  const Mesh mesh{square, two_triangles, {}};
  const auto with_ends = [](std::string text, const std::string& end) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size())
      text.replace(at, 1, end);
    return text;
  };
  const std::string off = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
  for (const std::string end : {"\n", "\r", "\r\n"}) {
    for (const std::string mark : {"", "\xef\xbb\xbf"}) {
      INFO(mark << end);
      const auto read = [&](const std::string& text, const std::string& name) {
        return make_mesh(parse_polygon_mesh(mark + with_ends(text, end), name));
      };
      CHECK(read(print_obj(mesh), "m.obj").mesh == mesh);
      CHECK(read(off, "m.off").mesh == mesh);
      const LoadedMesh ply = read(print_ply(mesh, PlyEncoding::ascii), "m.ply");
      CHECK(ply.mesh == mesh);
      CHECK(ply.source.face_lines == std::vector<std::size_t>{14, 15});
    }
  }
  CHECK_THROWS_WITH(parse_polygon_mesh(std::string("\xff\xfev\0 \0", 6), "m.obj"),
                    ContainsSubstring("m.obj: begins as text in UTF-16"));
  std::string binary = print_ply(mesh, PlyEncoding::binary);  // the line feed that begins its data must stay
  const std::size_t end = binary.find("end_header\n") + 11;
  binary = with_ends(binary.substr(0, end), "\r") + "\n" + binary.substr(end + 1);
  CHECK(of_ply(binary).positions[0].x != 0);
}

TEST_CASE("a header that announces more than the file holds takes no memory for it", "[unit]") {
  CHECK_THROWS_WITH(parse_ply(ascii_ply(square_text, "", 2000000000), "huge.ply"),
                    ContainsSubstring("huge.ply: vertex 4: the file ends here"));
}

TEST_CASE("missing files, folders, unknown formats and full disks are named", "[unit]") {
  const Scratch scratch;
  CHECK_THROWS_AS(read_mesh(scratch / "none.ply"), InputError);
  CHECK_THROWS_WITH(read_mesh(scratch / "none.ply"), ContainsSubstring("none.ply: no such file"));
  CHECK_THROWS_WITH(read_mesh(scratch / "mesh.max"),
                    ContainsSubstring("'.max' is no mesh format; use .obj, .ply, .vtp, .stl"));
  CHECK_THROWS_WITH(write_mesh(scratch / "mesh.stl", awkward_mesh()),
                    ContainsSubstring("'.stl' is no mesh format that is written; use .obj or .ply"));
  std::filesystem::create_directories(scratch / "folder.obj");
  CHECK_THROWS_WITH(read_mesh(scratch / "folder.obj"), ContainsSubstring("is a folder"));
  CHECK_THROWS_AS(write_mesh(scratch / "folder.obj", awkward_mesh()), InputError);
  if (std::filesystem::exists("/dev/full")) {
    CHECK_THROWS_WITH(write_bytes("/dev/full", std::string(100000, 'x')),
                      ContainsSubstring("/dev/full: can't be written; check free space"));
  }
}
