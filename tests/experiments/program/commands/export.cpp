#include <nlohmann/json.hpp>

#include <cstring>

#include "compare/files/bytes.hpp"
#include "compare/files/frames/printed_digits.hpp"
#include "compare/files/meshes/mesh_files.hpp"
#include "compare/record/run_folder.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

TEST_CASE("ogc export writes each frame as a mesh, and an index for ParaView", "[unit]") {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string();
  REQUIRE(run_ogc("run cloth_on_sphere --scale smoke --steps 4 --audit off --out " + run).status == 0);
  const compare::RunReader reader(run);
  for (const std::string format : {"obj", "ply", "vtp"}) {
    const ProgramResult result = run_ogc("export " + run + " --json --format " + format + " --out " +
                                         (folder / format).string());
    INFO(format << "\n" << result.err);
    REQUIRE(result.status == 0);
    const nlohmann::json files = nlohmann::json::parse(result.out).at("files");
    CHECK(files.size() == reader.frame_count() + (format == "vtp" ? 1 : 0));
    for (const auto& file : files) CHECK(std::filesystem::file_size(file.get<std::string>()) > 0);
  }
}

TEST_CASE("what ogc export writes reads back to the same bits, in every format", "[unit]") {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string();
  REQUIRE(run_ogc("run cloth_on_sphere --scale smoke --steps 2 --audit off --jitter 1e-5 --out " + run).status == 0);
  const compare::RunReader reader(run);
  for (const std::string format : {"obj", "ply", "vtp", "vtu"}) {
    const std::string out = (folder / format).string();
    REQUIRE(run_ogc("export " + run + " --format " + format + " --out " + out).status == 0);
    for (std::size_t i = 0; i < reader.frame_count(); ++i) {
      const compare::Frame frame = reader.frame(i);
      const std::string file = out + "/" + compare::frame_name(frame.step) + "." + format;
      INFO(file);
      CHECK_FALSE(compare::printed_digits(file));  // files contain all digits of a double
      if (format == "vtu") {                       // stores its points in binary
        std::string bytes(frame.positions.size() * sizeof(compare::Vec3f), '\0');
        std::memcpy(bytes.data(), frame.positions.data(), bytes.size());
        CHECK(compare::read_bytes(file).find(bytes) != std::string::npos);
        continue;
      }
      const compare::Mesh mesh = compare::read_mesh(file);
      CHECK(mesh.triangles == reader.scene().mesh.triangles);
      CHECK(mesh.positions == compare::to_double(frame.positions));  // exact as doubles, without further rounding
    }
  }
}

TEST_CASE("ogc export assembles the trajectory of a run that was killed", "[unit]") {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string();
  REQUIRE(run_ogc("run cloth_on_sphere --scale smoke --steps 4 --audit off --out " + run).status == 0);
  std::filesystem::remove(folder / "run/trajectory.vtkhdf");
  REQUIRE(run_ogc("export " + run).status == 0);
  CHECK(std::filesystem::exists(folder / "run/trajectory.vtkhdf"));
  CHECK(std::filesystem::exists(folder / "run/vtp/cloth_on_sphere.pvd"));
}

TEST_CASE("ogc export refuses what is no run, and unknown formats, with exit status 2", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_ogc("export " + (folder / "nothing").string());
  CHECK(result.status == 2);
  CHECK(contains(result.err, {"nothing"}));
  CHECK(run_ogc("export " + (folder / "nothing").string() + " --format usd").status == 2);
}
