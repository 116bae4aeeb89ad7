// Tests meshes from other programs: they can be loaded, each change that loading makes is reported, and `ogc audit` and
// `ogc contacts` accept them.
#include <nlohmann/json.hpp>

#include <set>

#include "compare/files/bytes.hpp"
#include "compare/files/meshes/mesh_files.hpp"
#include "compare/problem/dust.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/validate.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"
#include "tests/experiments/program/commands/stock_shapes.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

struct Writer {
  std::string file;
  std::string (*print)(const StockShape&);
  bool has_unused = false;
};

const std::vector<Writer> own_formats{{"plain.obj", plain_obj},
                                      {"dressed.obj", dressed_obj, true},
                                      {"ascii.ply", ascii_ply, true},
                                      {"little.ply", little_endian_ply},
                                      {"big.ply", big_endian_ply}};
const std::vector<Writer> other_formats{
    {"ascii.stl", ascii_stl}, {"binary.STL", binary_stl}, {"shape.off", off}, {"shape.glb", glb}};

std::string write(const TemporaryFolder& folder, const StockShape& shape, const Writer& writer) {
  return folder.write(shape.name + "_" + writer.file, writer.print(shape)).string();
}

}  // namespace

TEST_CASE(
    "55 meshes as other programs write them: ogc audit and ogc contacts take each, count it, and say what they changed",
    "[property]") {
  const TemporaryFolder folder;
  std::size_t meshes = 0, with_dust = 0, with_polygons = 0;
  for (const StockShape& shape : stock_shapes()) {
    for (const Writer& writer : own_formats) {
      const std::string file = write(folder, shape, writer);
      const ProgramResult audit = run_ogc("audit --json " + file),
                          contacts = run_ogc("contacts --engine cpu --json " + file);
      INFO(file << "\n" << audit.err << contacts.err);
      REQUIRE(audit.status == 0);
      REQUIRE(contacts.status == 0);
      CHECK(nlohmann::json::parse(audit.out).at("clean") == true);
      const nlohmann::json json = nlohmann::json::parse(contacts.out);
      CHECK(json.at("vertices") == shape.positions.size());
      CHECK(json.at("triangles").size() == shape.triangles());
      CHECK(json.at("vertex_in_file").at(0) == (writer.has_unused ? 1 : 0) + (file.ends_with(".obj") ? 1 : 0));
      CHECK(std::set<int>(json.at("face_in_file").begin(), json.at("face_in_file").end()).size() == shape.faces.size());
      CHECK(contains(audit.err, {"dust"}) == shape.has_dust());
      CHECK(contains(contacts.err, {"dust", "taken as 0"}) == shape.has_dust());
      CHECK(contains(contacts.err, {"cut into"}) == shape.has_polygons());
      CHECK(contains(contacts.err, {"left out"}) == writer.has_unused);
      ++meshes;
      with_dust += shape.has_dust();
      with_polygons += shape.has_polygons();
    }
  }
  CHECK(meshes == 55);
  CHECK(with_dust >= 40);
  CHECK(with_polygons >= 50);
}

TEST_CASE("STL, OFF and glTF are read, and those without shared vertices welded", "[property]") {
  const TemporaryFolder folder;
  for (const StockShape& shape : stock_shapes()) {
    for (const Writer& writer : other_formats) {
      const std::string file = write(folder, shape, writer);
      INFO(file);
      compare::LoadedMesh loaded = compare::load_mesh(file);
      compare::clear_dust(loaded.mesh);
      CHECK(compare::describe(compare::validate(loaded.mesh)) == "");
      CHECK(loaded.mesh.positions.size() == shape.positions.size());
      CHECK(loaded.mesh.triangles.size() == shape.triangles());
      if (writer.file == "shape.glb")
        CHECK(std::ranges::all_of(loaded.mesh.positions, [](const compare::Vec3& p) { return p.y > 2; }));
      if (writer.file != "shape.off") CHECK_THAT(loaded.notes.at(0), ContainsSubstring("merged"));
    }
  }
}

TEST_CASE("elements of files without numbered vertices are named by their faces", "[unit]") {
  const TemporaryFolder folder;
  const StockShape crossing{"crossing",
                            {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, -0.5}, {0.5, 0.25, 0.5}, {0.25, 0.5, 0.5}},
                            {{0, 1, 2}, {3, 4, 5}}};
  const ProgramResult result = run_ogc("audit " + folder.write("crossing.stl", ascii_stl(crossing)).string());
  CHECK(result.status == 1);
  CHECK(contains(result.out, {"edge (from a vertex of face 1 to a vertex of face 1) meets face 0"}));
}

TEST_CASE("a file that can't be read is refused with its reason", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_ogc("audit " + folder.write("broken.stl", "solid nothing\nfacet").string());
  CHECK(result.status == 2);
  CHECK(contains(result.err, {"broken.stl: line 2: the file ends here, within facet 0"}));
}

TEST_CASE("faces that are none are left out with a word by audit, contacts, suggest and run, and strictly refused",
          "[unit]") {
  const TemporaryFolder folder;
  const StockShape plane = stock_shapes().front();
  const std::string file =
      folder.write("doubled.obj", plain_obj(plane) + "f 1 1 2\nf 1 2 1 3\nf 1 2 3\nf 3 2 1\n").string();
  const std::string run = "run --steps 1 --out " + (folder / "run").string();
  for (const std::string& command : std::vector<std::string>{"audit", "contacts --engine cpu", "suggest", run}) {
    ProgramResult result = run_ogc(command + " " + file);
    INFO(command << "\n" << result.err);
    CHECK(result.status == 0);
    CHECK(contains(result.err, {"doubled.obj: 4 faces were left out: 1 names less than three different vertices"}));
    result = run_ogc(command + " --strict " + file);
    CHECK(result.status == 2);
    CHECK(contains(result.err, {"doubled.obj: has 4 faces that are none: ", "leave --strict out"}));
  }
}

TEST_CASE("a mesh far from 0 runs near it, said once, and its frames are exported in its own coordinates",
          "[property]") {
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      text += "v 512345." + std::to_string(10 + 5 * i) + " 30.1 5403210." + std::to_string(10 + 5 * k) + "\n";
  for (int i = 0; i < 6; i += 3)
    for (int k = 1 + i; k < 3 + i; ++k)
      text += "f " + std::to_string(k) + " " + std::to_string(k + 1) + " " + std::to_string(k + 4) + " " +
              std::to_string(k + 3) + "\n";
  const std::string file = folder.write("far.obj", text).string(), run = (folder / "run").string();
  const ProgramResult suggested = run_ogc("suggest " + file);
  CHECK(suggested.status == 0);
  CHECK(contains(suggested.out, {"ogc run ", "far.obj --ground 30.0"}));
  const ProgramResult result = run_ogc("run " + file + " --ground 30.05 --steps 2 --audit every --out " + run);
  INFO(result.err);
  REQUIRE(result.status == 0);
  const std::string said =
      "far.obj: coordinates lie 5.4e+06 m from 0, 5.4e+07 times the mesh's size: positions are taken "
      "relative to (512345.125, 30.125, 5403210.125)";
  CHECK(contains(result.err, {said}));
  CHECK(result.err.find(said) == result.err.rfind(said));
  for (const std::string format : {"obj", "ply", "vtp", "vtu"}) {
    const ProgramResult exported = run_ogc("export " + run + " --json --format " + format);
    REQUIRE(exported.status == 0);
    const std::string first = nlohmann::json::parse(exported.out).at("files").front();
    const compare::Mesh mesh = compare::read_mesh(first), own = compare::read_mesh(file);
    for (std::size_t v = 0; v < own.positions.size(); ++v) CHECK(mesh.positions[v] == own.positions[v]);
  }
  CHECK(run_ogc("run " + file + " --ground 30.2 --steps 1").status == 2);
}

TEST_CASE("audit, suggest and run say the same of inverted tetrahedra", "[unit]") {
  const TemporaryFolder folder;
  const std::string vertices =
                        "MeshVersionFormatted 2\nDimension 3\nVertices 8\n0 0 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n"
                        "2 0 0 0\n3 0 0 0\n2 1 0 0\n2 0 1 0\nTetrahedra 2\n",
                    turned = folder.write("turned.mesh", vertices + "1 2 4 3 0\n5 6 8 7 0\nEnd\n").string(),
                    out = (folder / "run").string() + " ",
                    mixed = folder.write("mixed.mesh", vertices + "1 2 3 4 0\n5 6 8 7 0\nEnd\n").string();
  for (const std::string& command : std::vector<std::string>{"audit ", "suggest ", "run --steps 1 --out " + out}) {
    ProgramResult result = run_ogc(command + turned);
    INFO(command << "\n" << result.err);
    CHECK(result.status == 0);
    CHECK(contains(result.err, {"turned.mesh: all 2 tetrahedra are inverted and were turned"}));
    CHECK(run_ogc(command + turned + " --strict").status == 2);
    result = run_ogc(command + mixed);
    CHECK(contains(result.err,
                   {"mixed.mesh: 1 of 2 tetrahedra is inverted or flat, the first: tetrahedron 2 (vertices 5, "
                    "6, 8, 7; line 14)"}));
    if (command == "audit ") {
      CHECK(result.status == 0);
    } else {
      CHECK(result.status == 2);
      CHECK(contains(result.err, {"is inverted at rest", "exchange two of its vertices"}));
    }
  }
}

TEST_CASE("vertices at one place are mentioned with the option that merges them, and --weld does", "[unit]") {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("split.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\n").string();
  const ProgramResult split = run_ogc("audit " + file), welded = run_ogc("audit --weld " + file);
  CHECK(split.status == 1);
  CHECK(contains(split.err, {"split.obj: 2 vertices have exactly the coordinates of another", "--weld"}));
  CHECK(welded.status == 0);
  CHECK(contains(welded.err, {"2 corners with exactly the coordinates of another were merged"}));
}

TEST_CASE("of a sequence, what was changed is said once", "[unit]") {
  const TemporaryFolder folder;
  const StockShape plane = stock_shapes().front();
  for (const char* frame : {"f_1.obj", "f_2.obj", "f_3.obj"}) folder.write(frame, dressed_obj(plane));
  const ProgramResult result = run_ogc("audit '" + (folder / "f_*.obj").string() + "'");
  CHECK(result.status == 0);
  CHECK(
      contains(result.err, {"f_1.obj: 48 faces of more than three corners were cut into 96 triangles (said of this"}));
  CHECK_FALSE(contains(result.err, {"f_2.obj: 48 faces"}));
}

TEST_CASE("frames that a run exported are audited and asked for contacts", "[property]") {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string();
  REQUIRE(run_ogc("run twist --scale smoke --steps 40 --audit off --out " + run).status == 0);
  for (const std::string format : {"obj", "ply"}) {
    const ProgramResult exported = run_ogc("export " + run + " --json --format " + format);
    REQUIRE(exported.status == 0);
    const std::string last = nlohmann::json::parse(exported.out).at("files").back();
    INFO(last);
    CHECK(run_ogc("audit " + last).status == 0);
    CHECK(run_ogc("contacts --engine cpu " + last).status == 0);
  }
}

TEST_CASE("the option --no-triangulate and --no-drop-unused refuse what is taken otherwise, and name the option",
          "[unit]") {
  const TemporaryFolder folder;
  const StockShape plane = stock_shapes().front();
  const std::string file = write(folder, plane, own_formats[1]);
  for (const std::string command : {"audit", "contacts", "run"}) {
    ProgramResult result = run_ogc(command + " " + file + " --no-triangulate");
    CHECK(result.status == 2);
    CHECK(contains(result.err, {file, "the first: face 1 (line ", "of 4; take --triangulate"}));
    result = run_ogc(command + " " + file + " --triangulate --no-drop-unused");
    CHECK(result.status == 2);
    CHECK(contains(result.err, {file, "the first: vertex 1 (line 4)", "take --drop-unused"}));
  }
  CHECK(run_ogc("audit " + file + " --triangulate --drop-unused").status == 0);
}

TEST_CASE("ogc run takes a mesh file as cloth above a ground, with settings that follow from it", "[property]") {
  const TemporaryFolder folder;
  const std::string file = write(folder, stock_shapes()[6], own_formats[1]);
  const ProgramResult result = run_ogc("run " + file + " --ground -0.6 --steps 60 --audit every --json --out " +
                                       (folder / "run").string());
  INFO(result.err);
  REQUIRE(result.status == 0);
  CHECK(nlohmann::json::parse(result.out).at("guarantee_kept") == true);
  CHECK(contains(result.err,
                 {"contact_radius", " of the median edge", "time_step", "iterations", "left out", "cut into"}));
  const nlohmann::json run = nlohmann::json::parse(compare::read_bytes(folder / "run" / "run.json"));
  CHECK(run.at("scene").at("bodies").size() == 2);
  CHECK(run_ogc("audit " + (folder / "run").string()).status == 0);
}

TEST_CASE("ogc run of a mesh refuses what it can't use: grounds, options of scenes, starts that intersect, loose edges",
          "[unit]") {
  const TemporaryFolder folder;
  const std::string file = write(folder, stock_shapes()[6], own_formats[0]);
  ProgramResult result = run_ogc("run " + file + " --ground 0.1");
  CHECK(result.status == 2);
  CHECK(contains(result.err, {"--ground 0.1 is not below", "lowest point is at y = -0.5 m"}));
  for (const std::string wrong : {" --ground nan", " --scale smoke", " --set data=x"})
    CHECK(run_ogc("run " + file + wrong).status == 2);
  result = run_ogc("run twist --scale smoke --ground 0");
  CHECK(result.status == 2);
  CHECK(contains(result.err, {"--ground", "mesh file"}));
  result = run_ogc("run " + folder.write("crossing.obj", crossing_triangles_obj).string());
  CHECK(result.status == 2);
  CHECK(contains(result.err, {"2 intersections", "edge of body 'cloth' (vertices 4, 5; ",
                              "crossing.obj, lines 4, 5) meets face 1 of body 'cloth' (vertices 1, 2, 3; "}));
  result = run_ogc("run " + folder.write("yarn.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nl 1 4\n").string());
  CHECK(result.status == 2);
  CHECK(contains(result.err, {"yarn.obj: loose edge 1 (vertices 1, 4; line 6) belongs to no face"}));
}
