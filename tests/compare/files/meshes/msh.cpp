// Tests Gmsh's two text formats: their contents are read and written back, and each error is named with its line.
#include "compare/files/meshes/msh.hpp"

#include "compare/files/bytes.hpp"
#include "compare/files/meshes/mesh_files.hpp"
#include "compare/files/scenes/scene_files.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/tetrahedra.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/scratch.hpp"
#include "tests/compare/problem/solid_scene.hpp"

using namespace ogc::compare;
using ogc::tests::Scratch;
using ogc::tests::solid_scene;

namespace {

/// One tetrahedron, with a triangle of its surface, a comment, and tags out of order.
const std::string old_format = R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
3 1 "block"
$EndPhysicalNames
$Nodes
4
4 0 0 1
1 0 0 0
2 1.5 0 0
3 0 1e-1 0
$EndNodes
$Elements
2
1 2 2 1 1 1 2 3
7 4 2 1 1 1 2 3 4
$EndElements
)";

/// The same tetrahedron with tags up to 9 and two blocks of nodes.
const std::string new_format = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Entities
0 0 0 1
1 0 0 0 1 1 1 0 0
$EndEntities
$Nodes
2 4 1 9
2 1 0 3
1
2
9
0 0 0
1.5 0 0
0 0 1
3 1 0 1
3
0 1e-1 0
$EndNodes
$Elements
2 2 1 7
2 1 2 1
1 1 2 3
3 1 4 1
7 1 2 3 9
$EndElements
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

std::string error_of(const std::string& text) {
  try {
    parse_msh(text, "m.msh");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("MSH 2.2 and 4.1 hold nodes by tag and tetrahedra; what else they hold is left out with a word", "[unit]") {
  for (const std::string& text : {old_format, replaced(old_format, "2.2 0", "2 0"), new_format}) {
    const PolygonMesh mesh = parse_msh(text, "m.msh");
    CHECK(mesh.positions == std::vector<Vec3>{{0, 0, 0}, {1.5, 0, 0}, {0, 0.1, 0}, {0, 0, 1}});
    CHECK(mesh.tetrahedra == std::vector<Tetrahedron>{{0, 1, 2, 3}});
    CHECK(mesh.notes ==
          std::vector<std::string>{"m.msh: 1 triangles were left out: the surface is the boundary of the tetrahedra"});
  }
  const LoadedMesh old = make_mesh(parse_msh(old_format, "m.msh")), fresh = make_mesh(parse_msh(new_format, "m.msh"));
  CHECK(old.mesh.triangles == boundary_triangles(old.mesh.tetrahedra));
  CHECK(ElementNames(old.source).tetrahedron(0, {0, 1, 2, 3}) == "tetrahedron 7 (vertices 1, 2, 3, 4; line 18)");
  CHECK(ElementNames(old.source).vertex(3) == "vertex 4 (line 10)");
  CHECK(ElementNames(fresh.source).tetrahedron(0, {0, 1, 2, 3}) == "tetrahedron 7 (vertices 1, 2, 3, 9; line 26)");
}

TEST_CASE("a written MSH comes back bit for bit, and so does a scene with a solid", "[unit]") {
  const Scratch scratch;
  Scene scene = solid_scene();
  scene.mesh.positions[13].y += 1.0 / 300;
  scene.velocities[5] = {1.0 / 3, 0, -1};
  scene.bodies[0].material.solid_density = 1234.5;
  scene.bodies[0].material.solid_damping = 1e-4;
  append_body(scene, {.name = "sheet", .material = {}}, {{{9, 0, 0}, {10, 0, 0}, {9, 0, 1}}, {{0, 1, 2}}, {}});
  round_to_single(scene);
  const Scene again = read_scene(write_scene(scratch / "new", scene));
  CHECK(again == scene);
  const Mesh block = read_mesh(scratch / "new/solid_block.msh");
  CHECK(block.tetrahedra == solid_scene().mesh.tetrahedra);
  CHECK(block.triangles == solid_scene().mesh.triangles);
}

TEST_CASE("each thing that is wrong with an MSH is named with its line", "[unit]") {
  CHECK_THAT(error_of(""), ContainsSubstring("m.msh: has no $MeshFormat"));
  CHECK_THAT(error_of(replaced(old_format, "2.2 0", "3.0 0")),
             ContainsSubstring("line 2: format 3.0 is not read, only 2.2 and 4.1"));
  CHECK_THAT(error_of(replaced(new_format, "4.1 0", "4.1 1")),
             ContainsSubstring("byte 24: the number 1, which tells the order"));
  CHECK_THAT(error_of(replaced(new_format, "4.1 0", "4.1 2")),
             ContainsSubstring("line 2: 2 stands where 0 for text or 1"));
  CHECK_THAT(error_of("$NOD\n1\n1 0 0 0\n$ENDNOD\n"), ContainsSubstring("line 1: '$NOD' stands in format 1 of Gmsh"));
  CHECK_THAT(error_of(old_format.substr(0, old_format.find("7 4 2"))),
             ContainsSubstring("ends after line 17, where an element should stand: the file is truncated"));
  CHECK_THAT(error_of(new_format.substr(0, new_format.find("$EndElements"))),
             ContainsSubstring("where $EndElements should"));
  CHECK_THAT(error_of(replaced(old_format, "$Elements\n2", "$Elements\n9000")),
             ContainsSubstring("line 16: 9000 is no possible number of elements"));
  CHECK_THAT(error_of(replaced(old_format, "7 4 2 1 1 1 2 3 4\n", "")),
             ContainsSubstring("line 18: '$EndElements' is no whole"));
  CHECK_THAT(error_of(replaced(replaced(old_format, "7 4 2 1 1 1 2 3 4\n", ""), "$Elements\n2", "$Elements\n1")),
             ContainsSubstring("m.msh: has 1 triangles and no tetrahedron: mesh the volume"));
  CHECK_THAT(error_of(replaced(old_format, "7 4 2", "7 5 2")), ContainsSubstring("line 18: hexahedra are not read"));
  CHECK_THAT(error_of(replaced(old_format, "7 4 2", "7 99 2")),
             ContainsSubstring("line 18: elements of type 99 are not read"));
  CHECK_THAT(error_of(replaced(old_format, "1 1 1 2 3 4", "1 1 1 2 3 5")),
             ContainsSubstring("line 18: node 5 does not exist"));
  CHECK_THAT(error_of(replaced(old_format, "2 1.5", "1 1.5")), ContainsSubstring("node 1 stands in line 11 already"));
  CHECK_THAT(error_of(replaced(new_format, "1e-1", "nan")),
             ContainsSubstring("line 19: 'nan' is no finite coordinate"));
}

TEST_CASE("E and nu stand in place of the constants of Lame, and what format 2 reserves is refused by name", "[unit]") {
  const Scratch scratch;
  const std::filesystem::path file = write_scene(scratch.folder(), solid_scene());
  const std::string text = read_bytes(file);
  const auto with = [&](const std::string& from, const std::string& to) {
    write_bytes(file, replaced(text, from, to));
    try {
      const Material material = read_scene(file).bodies[0].material;
      CHECK(material.solid_mu == Approx(7142.857));
      CHECK(material.solid_lambda == Approx(28571.43));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string lame = "\"solid_mu\": 10000.0,\n        \"solid_lambda\": 10000.0,";
  CHECK(with(lame, R"("solid_young": 2e4, "solid_poisson": 0.4,)").empty());
  CHECK_THAT(with(lame, R"("solid_young": 2e4, "solid_poisson": 0.5,)"),
             ContainsSubstring("/bodies/0/material/solid_poisson: is 0.5; give a number from 0 to 0.4999"));
  CHECK_THAT(with(lame, R"("solid_young": -1, "solid_poisson": 0.4,)"), ContainsSubstring("solid_young: is -1"));
  CHECK_THAT(with(lame, R"("solid_young": 2e4,)"), ContainsSubstring("stands without 'solid_poisson'"));
  CHECK_THAT(with("\"solid_mu\"", R"("solid_young": 2e4, "solid_poisson": 0.4, "solid_mu")"),
             ContainsSubstring("stands beside 'solid_mu'"));
  CHECK_THAT(with("\"surface\"", "\"solid\""),
             ContainsSubstring("/bodies/0/body_contact: unknown body contact 'solid'; there are: surface, volume"));
  CHECK_THAT(with("\"fixed\"", R"("orientations": "q.h5", "fixed")"), ContainsSubstring("/bodies/0/orientations: "));
  CHECK_THAT(with("\"motions\"", R"("body_pairs": [{}], "motions")"),
             ContainsSubstring("/body_pairs/0: asks for materials of pairs of bodies"));
}
