// Tests the formats of tetrahedral meshes: each file contains the same cube, and each error is named.
#include <algorithm>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/scene.hpp"
#include "compare/problem/tetrahedra.hpp"
#include "compare/problem/validate.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/meshes/samples.hpp"

using namespace ogc::compare;
using namespace ogc::tests;

namespace {

struct Sample {
  std::string name, bytes;
};

std::vector<Sample> cubes() {
  std::vector<Sample> samples{{"m.mesh", cube_medit()}, {"m.vtu", cube_vtu()}};
  for (const bool is_new : {false, true}) {
    for (const std::endian order : {std::endian::little, std::endian::big})
      samples.push_back({"m.msh", binary_msh(is_new, order)});
    for (const bool is_binary : {false, true}) samples.push_back({"m.vtk", cube_vtk(is_binary, is_new)});
  }
  return samples;
}

}  // namespace

TEST_CASE("a cube of six tetrahedra is the same in each format, and valid", "[unit]") {
  const Mesh first = make_mesh(parse_polygon_mesh(cube_medit(), "m.mesh")).mesh;
  CHECK(first.positions.size() == 8);
  CHECK(first.tetrahedra.size() == 6);
  CHECK(first.triangles.size() == 12);
  for (const auto& [name, bytes] : cubes()) {
    INFO(name << ", " << bytes.substr(0, 50));
    const LoadedMesh loaded = make_mesh(parse_polygon_mesh(bytes, name));
    CHECK(loaded.mesh == first);
    CHECK(describe(validate(loaded.mesh)) == "");
    CHECK(std::ranges::none_of(loaded.notes, [](const std::string& note) { return note.find("turned") != note.npos; }));
  }
  CHECK(make_mesh(parse_polygon_mesh(cube_medit(), "m.mesh")).notes ==
        std::vector<std::string>{
            "m.mesh: 1 face and 1 line were left out: the surface is the boundary of the tetrahedra"});
  const LoadedMesh msh = make_mesh(parse_polygon_mesh(binary_msh(true), "m.msh"));
  CHECK(ElementNames(msh.source).tetrahedron(0, msh.mesh.tetrahedra[0]) == "tetrahedron 2 (vertices 1, 2, 4, 8)");
}

TEST_CASE("a cube whose file is cut anywhere is refused with a reason, whatever its format", "[unit]") {
  for (const auto& [name, bytes] : cubes()) {
    std::size_t needed = bytes.find_last_not_of('\n') + 1;  // bytes after the cells of a .vtk file are not read
    if (name == "m.vtk") needed = bytes.find("\nPOINT_DATA");
    for (std::size_t size = 0; size + 1 < needed; ++size) {
      INFO(name << ", " << size << " of " << bytes.size() << " bytes");
      CHECK(error_of(bytes.substr(0, size), name) != "");
    }
  }
}

TEST_CASE("counts beyond a file's size, vertices that are not there and other cells are refused by name", "[unit]") {
  const std::string medit = cube_medit(), old_vtk = cube_vtk(false, false), new_vtk = cube_vtk(false, true);
  CHECK_THAT(error_of(replaced(medit, "Vertices\n8", "Vertices\n800000000000"), "m.mesh"),
             ContainsSubstring("m.mesh: line 6: 800000000000 is no possible number of vertices"));
  CHECK_THAT(error_of(replaced(medit, "Tetrahedra\n6", "Tetrahedra\n4000000000"), "m.mesh"),
             ContainsSubstring("is no possible number of Tetrahedra"));
  CHECK_THAT(error_of(replaced(medit, "Tetrahedra\n6", "Tetrahedra\n5"), "m.mesh"),
             ContainsSubstring("line 28: '1' stands where a keyword should: the count of the section before is wrong"));
  CHECK_THAT(error_of(replaced(medit, "1 2 4 8 0", "1 2 4 9 0"), "m.mesh"),
             ContainsSubstring("m.mesh: line 23: vertex 9 does not exist; the file has 8, numbered from 1"));
  CHECK_THAT(error_of(replaced(medit, "Dimension\n3", "Dimension\n2"), "m.mesh"),
             ContainsSubstring("dimension 2 is not read"));
  CHECK_THAT(error_of("GIF89a", "m.mesh"), ContainsSubstring("it is no Medit file in text"));
  CHECK_THAT(error_of(replaced(medit, "Triangles\n1\n1 2 4 5", "Hexahedra 1 1 2 3 4 5 6 7 8 0"), "m.mesh"),
             ContainsSubstring("Hexahedra are not read"));
  CHECK_THAT(error_of(replaced(old_vtk, "POINTS 8", "POINTS 800000000000"), "m.vtk"),
             ContainsSubstring("line 8: 800000000000 points can't stand in the "));
  CHECK_THAT(error_of(replaced(old_vtk, "CELLS 6 30", "CELLS 6 3000000000"), "m.vtk"),
             ContainsSubstring("can't stand in the"));
  CHECK_THAT(
      error_of(replaced(old_vtk, "CELLS 6 30", "CELLS 6000000000 30"), "m.vtk"),
      ContainsSubstring("cell 6 of 6000000000 has -1 corners, with 0 numbers left: the counts of CELLS are wrong"));
  CHECK_THAT(error_of(replaced(old_vtk, "4 0 1 3 7", "4 0 1 3 8"), "m.vtk"),
             ContainsSubstring("m.vtk: CELLS 0: vertex 8 does not exist; its piece has 8, numbered from 0"));
  CHECK_THAT(error_of(replaced(old_vtk, "10 10", "12 10"), "m.vtk"),
             ContainsSubstring("cell 0 is a hexahedron, which is not read"));
  CHECK_THAT(error_of(replaced(new_vtk, "0 4 8", "0 4 80"), "m.vtk"),
             ContainsSubstring("CELLS 1: its offset is out of order"));
  CHECK_THAT(error_of(replaced(new_vtk, "UNSTRUCTURED_GRID", "STRUCTURED_GRID"), "m.vtk"),
             ContainsSubstring("m.vtk: line 4: a data set of kind 'STRUCTURED_GRID' is not read"));
  CHECK_THAT(error_of(replaced(new_vtk, "0.000000 ", "-1.#IND "), "m.vtk"),
             ContainsSubstring("'-1.#IND' is no finite"));
  CHECK_THAT(error_of(replaced(cube_vtu(), "10 10", "14 10"), "m.vtu"), ContainsSubstring("cell 0 is a pyramid"));
  CHECK_THAT(error_of(replaced(cube_vtu(), "10 10", "10"), "m.vtu"),
             ContainsSubstring("has 6 cells and 5 types of cells"));
  const std::string msh = binary_msh(true), begin = msh.substr(0, msh.find("$Nodes\n") + 7);
  CHECK_THAT(error_of(begin + std::string(6, '\0') + "\1" + msh.substr(begin.size() + 7), "m.msh"),
             ContainsSubstring(" blocks of nodes can't stand in the "));
}

TEST_CASE("tetrahedra that are inverted, all of them, are turned with a word; strictly they are refused", "[unit]") {
  PolygonMesh turned = parse_polygon_mesh(cube_medit(), "m.mesh");
  for (Tetrahedron& t : turned.tetrahedra) std::swap(t[0], t[1]);
  const LoadedMesh loaded = make_mesh(turned);
  CHECK(loaded.notes.back() ==
        "m.mesh: all 6 tetrahedra are inverted and were turned: the last two vertices of each were exchanged");
  for (const Tetrahedron& t : loaded.mesh.tetrahedra) {
    const auto at = [&](std::size_t k) { return loaded.mesh.positions[static_cast<std::size_t>(t[k])]; };
    CHECK(orientation(at(0), at(1), at(2), at(3)) == 1);
  }
  CHECK_THROWS_WITH(make_mesh(turned, {.strict = true}),
                    ContainsSubstring("m.mesh: all 6 tetrahedra are inverted; leave --strict"));
  // Only five of six tetrahedra are inverted, so none is reoriented.
  std::swap(turned.tetrahedra[2][0], turned.tetrahedra[2][1]);
  CHECK(make_mesh(turned).mesh.tetrahedra == turned.tetrahedra);
}

TEST_CASE("of tetrahedra with the same vertices the first stays, and so does the surface; strictly they are refused",
          "[unit]") {
  const LoadedMesh cube = make_mesh(parse_polygon_mesh(cube_medit(), "m.mesh"));
  PolygonMesh doubled = parse_polygon_mesh(cube_medit(), "m.mesh");
  const Tetrahedron second = doubled.tetrahedra[1];
  doubled.tetrahedra.push_back(second);
  doubled.tetrahedra.insert(doubled.tetrahedra.begin() + 2, {second[1], second[2], second[0], second[3]});
  doubled.source.tetrahedra.assign({0, 1, 2, 3, 4, 5, 6, 7});
  doubled.source.tetrahedron_lines.assign({10, 11, 12, 13, 14, 15, 16, 17});
  const LoadedMesh loaded = make_mesh(doubled);
  CHECK(loaded.mesh.tetrahedra == cube.mesh.tetrahedra);
  CHECK(loaded.mesh.triangles == cube.mesh.triangles);
  CHECK(loaded.source.tetrahedra == std::vector<Index>{0, 1, 3, 4, 5, 6});
  CHECK(loaded.source.tetrahedron_lines == std::vector<std::size_t>{10, 11, 13, 14, 15, 16});
  REQUIRE(loaded.notes.size() == cube.notes.size() + 1);
  CHECK_THAT(loaded.notes.back(),
             ContainsSubstring("2 tetrahedra with the vertices of another were left out: the first, tetrahedron "
                               "3 (") &&
                 ContainsSubstring("line 12), has those of tetrahedron 2 (") && ContainsSubstring("line 11)"));
  CHECK_THROWS_WITH(make_mesh(doubled, {.strict = true}),
                    ContainsSubstring("2 tetrahedra") && ContainsSubstring("line 12"));
}
