// Tests OFF, STL and glTF: their contents are read, and errors name the line, face, facet, accessor or byte.
#include <algorithm>
#include <bit>

#include "compare/files/bytes.hpp"
#include "compare/files/meshes/mesh_files.hpp"
#include "compare/files/meshes/off.hpp"
#include "compare/files/meshes/stl.hpp"
#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/meshes/samples.hpp"
#include "tests/compare/files/scratch.hpp"

using namespace ogc::compare;
using namespace ogc::tests;

namespace {

const std::vector<Triangle> two_triangles{{0, 1, 2}, {0, 2, 3}};

std::string off_error(const std::string& text) { return error_of(text, "m.off"); }
std::string stl_error(const std::string& bytes) { return error_of(bytes, "m.stl"); }
std::string gltf_error(const std::string& bytes) { return error_of(bytes, "m.gltf"); }

}  // namespace

TEST_CASE("OFF with colours, normals, comments, counts in the first line and polygons is read", "[unit]") {
  CHECK(make_mesh(parse_off(square_off, "m.off")).mesh.triangles == two_triangles);
  const PolygonMesh mesh = parse_off(
      "# made by hand\nSTCNOFF # with colours\n\n 5 3 0 # counts\n0 0 0 0 0 1 255 0 0\n1 0 0\n1 1 0\n0 1 0\n2 2 0\n"
      "4 0 1 2 3 0.5 0.5 0.5 # a square\n2 3 4\n1 4\n",
      "m.off");
  CHECK(mesh.corners == std::vector<Index>{0, 1, 2, 3});
  CHECK(mesh.loose_edges == std::vector<Edge>{{3, 4}});
  CHECK(mesh.notes == std::vector<std::string>{"m.off: 1 of the faces are single points and were left out"});
  CHECK(parse_off("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", "m.off").face_count() == 1);
  CHECK(parse_off("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", "m.off").face_count() == 1);
}

TEST_CASE("a count beyond an OFF file's size is refused before memory is taken, in vertices and in faces", "[unit]") {
  CHECK_THAT(off_error("OFF\n400000000000 1 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n"),
             ContainsSubstring("m.off: line 2: 400000000000 is no possible number of vertices, as "));
  CHECK_THAT(off_error("OFF\n3 400000000000 0\n0 0 0\n1 0 0\n0 0 1\n3 0 1 2\n"),
             ContainsSubstring("m.off: line 2: 400000000000 is no possible number of faces, as "));
  CHECK_THAT(off_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 0 1\n4000000000 0 1 2\n"),
             ContainsSubstring("m.off: line 6: 4000000000 is no possible number of corners of face 0"));
  CHECK_THAT(off_error("OFF\n99999999999999999999 1 0\n"), ContainsSubstring("is no whole number"));
}

TEST_CASE("what is wrong with an OFF file is named with its line and face", "[unit]") {
  CHECK_THAT(off_error(replaced(square_off, "3 0 2 3", "3 0 1 12")),
             ContainsSubstring("m.off: line 8: face 1: vertex 12 does not exist; the file has 4, numbered from 0"));
  CHECK_THAT(off_error(replaced(square_off, "3 0 2 3", "3 0 -1 2")),
             ContainsSubstring("face 1: vertex -1 does not exist"));
  CHECK_THAT(off_error(replaced(square_off, "3 0 2 3\n", "")),
             ContainsSubstring("m.off: ends after line 7, where face 1 of 2 should stand: the file is truncated"));
  CHECK_THAT(off_error(replaced(square_off, "0 1 0\n", "")), ContainsSubstring("truncated"));  // a vertex is missing
  CHECK_THAT(off_error(square_off + "3 0 1 3\n"),
             ContainsSubstring("m.off: line 9: stands behind the last of the 2 faces"));
  CHECK_THAT(off_error(replaced(square_off, "3 0 2 3", "3 0 2")),
             ContainsSubstring("line 8: '' is no whole number: corner 2 of 3 of face 1 should stand there"));
  CHECK_THAT(off_error(replaced(square_off, "1 1 0", "1 -1.#IND 0")),
             ContainsSubstring("line 5: '-1.#IND' is no finite"));
  CHECK_THAT(off_error(replaced(square_off, "1 1 0", "1 nan 0")),
             ContainsSubstring("line 5: 'nan' is no finite coordinate"));
  CHECK_THAT(off_error(replaced(square_off, "OFF", "4OFF")), ContainsSubstring("has vertices of another dimension"));
  CHECK_THAT(off_error(replaced(square_off, "OFF", "QOFF")),
             ContainsSubstring("'QOFF' is no kind of OFF that is read"));
  CHECK_THAT(off_error("OFF BINARY\n1234"), ContainsSubstring("the file is binary: write it as text"));
  CHECK_THAT(off_error("solid cube\n"),
             ContainsSubstring("'solid' is no number of vertices; an OFF file begins with OFF"));
  CHECK_THAT(off_error(""), ContainsSubstring("m.off: ends after line 0, where OFF should stand"));
}

TEST_CASE("STL in text and in binary is read, whatever its header begins with and its normals are", "[unit]") {
  const std::string text = square_stl();
  for (const std::string& bytes :
       {text, replaced(text, "normal 0 0 1", "normal -1.#IND nan 1.#QNAN"), replaced(text, "facet", "FACET"),
        text + text, binary_stl(2), "solid" + binary_stl(2).substr(5)}) {
    const LoadedMesh loaded = make_mesh(parse_stl(bytes, "m.stl"));
    CHECK(loaded.mesh.triangles == two_triangles);
    CHECK(loaded.mesh.positions == std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  }
}

TEST_CASE("an STL file that is cut, goes on or has a wrong word is refused with the reason", "[unit]") {
  const std::string binary = binary_stl(2), text = square_stl();
  CHECK_THAT(
      stl_error(binary + "\1\2\3\4\5\6\7"),
      ContainsSubstring("m.stl: 7 bytes follow the 2 facets that its header announces: header and data disagree"));
  CHECK_THAT(stl_error(binary.substr(0, 160)),
             ContainsSubstring(
                 "m.stl: ends within facet 1 of the 2 facets that its header announces, at byte 160: the file is "
                 "truncated"));
  CHECK_THAT(stl_error("solid" + binary.substr(5, 155)), ContainsSubstring("ends within facet 1 of the 2 facets"));
  CHECK_THAT(stl_error(binary.substr(0, 50)), ContainsSubstring("m.stl: ends at byte 50"));
  CHECK_THAT(stl_error(text.substr(0, text.rfind("vertex 0 1 0"))),
             ContainsSubstring("m.stl: line 13: the file ends here, within facet 1 (line 9): it is truncated"));
  CHECK_THAT(stl_error(text.substr(0, text.find("endsolid"))),
             ContainsSubstring("the file ends here, within the solid of line 1"));
  CHECK_THAT(stl_error(replaced(text, "vertex 1 1 0", "vertex 1 -1.#IND 0")),
             ContainsSubstring("line 6: '-1.#IND' is no finite"));
  CHECK_THAT(stl_error(replaced(text, "   vertex 1 1 0\n", "")),
             ContainsSubstring("line 7: facet 0 (line 2) has 2 vertices; a facet has three"));
  CHECK_THAT(stl_error(replaced(text, "outer loop", "outer hoop")),
             ContainsSubstring("'hoop' stands where 'loop' should"));
  CHECK_THAT(stl_error("solid nothing\nfacet"),
             ContainsSubstring("line 2: the file ends here, within facet 0 (line 2)"));
  std::string huge = binary;
  huge.replace(80, 4, "\xff\xff\xff\xff");
  CHECK_THAT(stl_error(huge), ContainsSubstring("ends within facet 2 of the 4294967295 facets"));
  std::string wrong = binary;
  wrong.replace(96, 4, std::string("\0\0\xc0\x7f", 4));
  CHECK_THAT(stl_error(wrong), ContainsSubstring("m.stl: facet 0: a coordinate is not finite"));
}

TEST_CASE("glTF is read with its nodes, in one file, beside its buffer and in base64", "[unit]") {
  const Scratch scratch;
  const std::string data = gltf_data();
  write_bytes(scratch / "a b.bin", data);
  write_bytes(scratch / "beside.gltf", square_gltf(R"("uri":"a%20b.bin",)"));
  write_bytes(scratch / "whole.glb", square_glb());
  write_bytes(scratch / "text.gltf", square_gltf());
  for (const char* name : {"beside.gltf", "whole.glb", "text.gltf"}) {
    const Mesh mesh = read_mesh(scratch / name);
    CHECK(mesh.triangles == two_triangles);
    // The nodes rotate the square by 90° about z, double its y, then move it by 3 along z.
    CHECK(mesh.positions == std::vector<Vec3>{{0, 0, 3}, {0, 2, 3}, {-1, 2, 3}, {-1, 0, 3}});
  }
  const std::string strip = replaced(replaced(square_gltf(), "\"indices\":1,", "\"mode\":5,"), "\"scene\":0,", "");
  CHECK(make_mesh(parse_polygon_mesh(strip, "m.gltf")).mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}});
  const std::string loop = replaced(square_gltf(), "\"indices\":1,", "\"mode\":2,");
  CHECK(make_mesh(parse_polygon_mesh(loop, "m.gltf")).mesh.loose_edges.size() == 4);
}

TEST_CASE("what is wrong with a glTF file is named with its primitive, accessor, view, buffer or node", "[unit]") {
  const std::string whole = square_gltf(), glb = square_glb();
  std::string out_of_range = gltf_data();
  out_of_range[48 + 10] = 9;
  CHECK_THAT(gltf_error(square_gltf(base64_uri(out_of_range))),
             ContainsSubstring(
                 "m.gltf: mesh 0, primitive 0, corner 5 (of triangle 1 if it is a list of triangles): vertex 9 does "
                 "not exist; the primitive has 4"));
  CHECK_THAT(gltf_error(replaced(whole, "\"count\":6", "\"count\":4000000000")),
             ContainsSubstring("m.gltf: accessor 1 has 4000000000 entries, which its view of 12 bytes can't hold"));
  CHECK_THAT(gltf_error(replaced(whole, "\"count\":6", "\"count\":5")),
             ContainsSubstring("has 5 corners, no multiple of 3"));
  CHECK_THAT(gltf_error(replaced(whole, "\"byteOffset\":48,\"byteLength\":12", "\"byteOffset\":48,\"byteLength\":900")),
             ContainsSubstring("buffer view 1 lies beyond its buffer of 60 bytes"));
  CHECK_THAT(gltf_error(replaced(whole, "\"byteLength\":60", "\"byteLength\":6000000000000")),
             ContainsSubstring("buffer 0 has 60 of the 6000000000000 bytes that are announced"));
  CHECK_THAT(gltf_error(replaced(whole, "\"mesh\":0", "\"mesh\":7")),
             ContainsSubstring("node 0 names entry 7 of 'meshes'"));
  CHECK_THAT(gltf_error(replaced(whole, "\"mesh\":0", "\"mesh\":0,\"children\":[0]")),
             ContainsSubstring("node 0 has two parents or is its own ancestor"));
  std::string nodes, numbers;
  for (int i = 3; i < 100'003; ++i) {
    nodes += ",{\"mesh\":0}";
    numbers += "," + std::to_string(i);
  }
  CHECK_THAT(gltf_error(replaced(replaced(whole, "\"scale\":[1,2,1]}", "\"scale\":[1,2,1]}" + nodes), "\"nodes\":[1]",
                                 "\"nodes\":[1" + numbers + "]")),
             !ContainsSubstring("repeat"));   // repeats meshes with six corners in nineteen bytes
  const std::string corners(3'000'000, 'A');  // indices of one byte, all 0
  const std::string large = replaced(
      replaced(square_gltf("\"uri\":\"data:;base64," + corners + "\","), "\"componentType\":5123,\"count\":6",
               "\"componentType\":5121,\"count\":2249997"),
      "\"byteOffset\":48,\"byteLength\":12", "\"byteOffset\":0,\"byteLength\":2250000");
  const std::string many = replaced(replaced(large, "\"scale\":[1,2,1]}", "\"scale\":[1,2,1]},{\"mesh\":0}"),
                                    "\"nodes\":[1]", "\"nodes\":[1,3]");
  CHECK_THAT(
      gltf_error(replaced(many, "\"byteLength\":60", "\"byteLength\":2250000")),
      ContainsSubstring("has nodes that repeat meshes until they have 4499994 corners and more, of a file of 300"));
  CHECK_THAT(gltf_error(replaced(whole, "\"mesh\":0", "\"mesh\":-1")),
             ContainsSubstring("'mesh' is no whole number from 0 on"));
  CHECK_THAT(gltf_error(replaced(whole, "\"bufferView\":0,", "")), ContainsSubstring("accessor 0 has no data"));
  CHECK_THAT(gltf_error(replaced(whole, "\"bufferView\":0,", "\"bufferView\":0,\"sparse\":{},")),
             ContainsSubstring("is sparse"));
  CHECK_THAT(gltf_error(replaced(whole, "\"2.0\"", "\"1.0\"")),
             ContainsSubstring("is of another version than 2 of glTF"));
  CHECK_THAT(gltf_error(replaced(whole, "[1,2,1]", "[1,1.7e308,\"x\"]")),
             ContainsSubstring("node 2: 'scale' are not 3 numbers"));
  CHECK_THAT(gltf_error(replaced(replaced(whole, "[1,2,1]", "[1,1.7e308,1]"), "[0,1,0,0,-1", "[0,9,0,0,-1")),
             ContainsSubstring("mesh 0, primitive 0, vertex 0: a coordinate is not finite"));
  CHECK_THAT(gltf_error(square_gltf(R"("uri":"gone.bin",)")),
             ContainsSubstring("m.gltf: buffer 0 can't be read: gone.bin: no such file"));
  CHECK_THAT(gltf_error("{\"nodes\":"), ContainsSubstring("m.gltf: no valid JSON"));
  CHECK_THAT(gltf_error("{}"), ContainsSubstring("has no 'asset'"));
  CHECK_THAT(error_of(glb.substr(0, glb.size() - 3), "m.glb"),
             ContainsSubstring("bytes that its header announces: the file is"));
  const std::string meshopt = R"("byteOffset":48,"extensions":{"EXT_meshopt_compression":{}},)";
  CHECK_THAT(gltf_error(replaced(whole, "\"byteOffset\":48,", meshopt)), ContainsSubstring("EXT_meshopt_compression"));
}
