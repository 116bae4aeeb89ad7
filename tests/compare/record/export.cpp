#include "compare/record/export.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/solid_scene.hpp"
#include "tests/compare/record/small_run.hpp"

using namespace ogc::compare;
using namespace ogc::tests;

namespace {

void write_run(const std::filesystem::path& folder) {
  RunWriter run(folder, recorded_scene(), recorded_provenance(), {});
  for (const std::int64_t step : {0, 25}) run.add_frame(recorded_frame(step));
  run.finish("finished");
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Returns the appended array with this name, found by the offset in the XML.
template <class T>
std::vector<T> appended_array(const std::string& vtp, const std::string& name) {
  const std::size_t tag = vtp.find("Name=\"" + name + "\""), key = vtp.find("offset=\"", tag) + 8;
  const char* const begin = vtp.data() + vtp.find("<AppendedData encoding=\"raw\">\n_") + 31 +
                            std::stoul(vtp.substr(key));
  std::uint64_t size = 0;
  std::memcpy(&size, begin, sizeof size);
  std::vector<T> values(size / sizeof(T));
  std::memcpy(values.data(), begin + sizeof size, size);
  return values;
}

}  // namespace

TEST_CASE("OBJ and PLY sequences hold each frame's mesh without loss", "[unit]") {
  const Scratch folder;
  write_run(folder / "run");
  for (const std::string extension : {"obj", "ply"}) {
    const auto files = export_run(folder / "run", parse_export_format(extension), folder / extension);
    REQUIRE(files == std::vector{folder / extension / ("frame_000000." + extension),
                                 folder / extension / ("frame_000025." + extension)});
    const Mesh mesh = read_mesh(files[1]);
    CHECK(mesh.positions == to_double(recorded_frame(25).positions));
    CHECK(mesh.triangles == recorded_scene().mesh.triangles);
    CHECK(mesh.loose_edges == recorded_scene().mesh.loose_edges);
  }
}

TEST_CASE("a VTP sequence holds the arrays bit for bit, and its index the times", "[unit]") {
  const Scratch folder;
  write_run(folder / "run");
  const auto files = export_run(folder / "run", ExportFormat::vtp, folder / "out/deep");
  REQUIRE(files.size() == 3);
  CHECK(files[2] == folder / "out/deep/small.pvd");
  CHECK_THAT(text_of(files[2]), ContainsSubstring("timestep=\"0.25\" part=\"0\" file=\"frame_000025.vtp\""));
  const std::string vtp = text_of(files[1]);
  const Frame frame = recorded_frame(25);
  CHECK_THAT(vtp, ContainsSubstring("NumberOfPoints=\"10\"") && ContainsSubstring("NumberOfLines=\"2\"") &&
                      ContainsSubstring("NumberOfPolys=\"3\""));
  CHECK(std::ranges::equal(appended_array<float>(vtp, "Points"), as_floats(frame.positions)));
  CHECK(std::ranges::equal(appended_array<float>(vtp, "velocity"), as_floats(frame.velocities)));
  CHECK(appended_array<float>(vtp, "bound") == frame.bounds);
  CHECK(appended_array<Index>(vtp, "body") == std::vector<Index>{0, 0, 0, 0, 1, 1, 1, 2, 2, 2});
  const std::string polygons = vtp.substr(vtp.find("<Polys>"));
  CHECK(appended_array<Index>(polygons, "connectivity") == std::vector<Index>{0, 1, 2, 1, 3, 2, 4, 5, 6});
  CHECK(appended_array<Index>(polygons, "offsets") == std::vector<Index>{3, 6, 9});
}

TEST_CASE("a VTU sequence holds tetrahedra with J, and the triangles of sheets beside them", "[unit]") {
  const Scratch folder;
  Scene scene = solid_scene();
  append_body(scene, {.name = "sheet", .material = {}}, {{{9, 0, 0}, {10, 0, 0}, {9, 0, 1}}, {{0, 1, 2}}, {}});
  round_to_single(scene);
  Frame frame;
  frame.positions = to_single(scene.mesh.positions);
  for (Vec3f& x : frame.positions) x.y *= x.x > 5 ? 1 : -2;
  frame.velocities.resize(frame.positions.size());
  frame.bounds.resize(frame.positions.size());
  RunWriter run(folder / "run", scene, recorded_provenance(), {});
  run.add_frame(frame);
  run.finish("finished");
  const auto files = export_run(folder / "run", parse_export_format("vtu"), folder / "out");
  REQUIRE(files.size() == 2);
  const std::string vtu = text_of(files[0]);
  const std::vector<float> growth = appended_array<float>(vtu, "J");
  REQUIRE(growth.size() == 49);
  CHECK(std::all_of(growth.begin(), growth.end() - 1, [](float j) { return std::abs(j + 2) < 1e-5f; }));
  CHECK(std::isnan(growth.back()));
  CHECK(appended_array<std::uint8_t>(vtu, "types")[47] == 10);
  CHECK(appended_array<std::uint8_t>(vtu, "types")[48] == 5);
  CHECK(appended_array<Index>(vtu, "offsets").back() == 4 * 48 + 3);
}

TEST_CASE("what can't be exported is said: unknown formats, runs without a frame, no run, a folder that can't be made",
          "[unit]") {
  const Scratch folder;
  CHECK_THROWS_WITH(parse_export_format("vtk"), ContainsSubstring("'vtk'") && ContainsSubstring("obj, ply, vtp, vtu"));
  { RunWriter run(folder / "empty", recorded_scene(), recorded_provenance(), {}); }
  CHECK_THROWS_AS(export_run(folder / "empty", ExportFormat::obj, folder / "out"), InputError);
  CHECK_THROWS_AS(export_run(folder / "nowhere", ExportFormat::obj, folder / "out"), InputError);
  write_run(folder / "run");
  CHECK_THROWS_AS(export_run(folder / "run", ExportFormat::obj, folder / "run/run.json/out"), InputError);
}
