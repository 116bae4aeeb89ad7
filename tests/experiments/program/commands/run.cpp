#include <cmath>
#include <fstream>
#include <set>

#include <nlohmann/json.hpp>

#include "compare/files/scenes/scene_files.hpp"
#include "compare/record/run_folder.hpp"
#include "compare/record/steps_csv.hpp"
#include "experiments/program/output.hpp"
#include "experiments/scenes/registry.hpp"
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

namespace {

/// Returns two free bodies of one triangle each. They intersect if `crossing`; otherwise they are 1 mm apart.
compare::Scene two_triangles(bool crossing) {
  compare::Scene scene;
  scene.name = "two_triangles";
  scene.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  if (crossing) {
    scene.mesh.positions.insert(scene.mesh.positions.end(), {{0.2, 0.2, -0.5}, {0.3, 0.2, 0.5}, {0.2, 0.3, 0.5}});
  } else {
    scene.mesh.positions.insert(scene.mesh.positions.end(), {{0, 0, 0.001}, {1, 0, 0.001}, {0, 1, 0.001}});
  }
  scene.mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  scene.rest_positions = scene.mesh.positions;
  scene.velocities.resize(6);
  compare::Body lower, upper;
  lower.name = "lower";
  lower.vertex_count = 3;
  lower.triangle_count = 1;
  upper = lower;
  upper.name = "upper";
  upper.first_vertex = 3;
  upper.first_triangle = 1;
  scene.bodies = {lower, upper};
  compare::round_to_single(scene);
  return scene;
}

nlohmann::json run(const std::string& arguments) {
  const ProgramResult result = run_ogc("run " + arguments + " --json");
  INFO(result.err);
  REQUIRE(result.status == 0);
  return nlohmann::json::parse(result.out);
}

}  // namespace

TEST_CASE("the smoke runs of all scenes keep the guarantee and leave a readable folder", "[property]") {
  for (const experiments::SceneInfo& info : experiments::scenes()) {
    const TemporaryFolder folder;
    const std::string name(info.name);
    const nlohmann::json json = run(name + " --scale smoke --out " + (folder / "run").string());
    INFO(json.dump(2));
    CHECK(json.at("status") == "finished");
    CHECK(json.at("guarantee_kept") == true);
    CHECK(json.at("audit").at("states").get<int>() >= 5);
    const compare::RunReader reader(folder / "run");
    CHECK(reader.scene().name == name);
    CHECK(reader.provenance().status == "finished");
    CHECK(reader.provenance().extra.at("final_hash") == json.at("final_hash").get<std::string>());
    REQUIRE(reader.frame_count() == json.at("audit").at("states").get<std::size_t>() + 1);
    const compare::Frame last = reader.frame(reader.frame_count() - 1);
    CHECK(last.step == json.at("last_step"));
    CHECK(last.step == reader.scene().settings.steps);
    CHECK(experiments::state_hash(last.positions) == json.at("final_hash").get<std::string>());
    CHECK(reader.frame(0).positions == compare::to_single(reader.scene().mesh.positions));
    // A registered scene must have contacts, except turning_rod, which is about the orientations of a rod.
    CHECK((name == "turning_rod" || std::ranges::any_of(compare::read_steps(folder / "run").rows, [](const auto& row) {
             return row.vertex_facet_contacts + row.edge_edge_contacts + row.volume_contacts > 0;
           })));
    const ProgramResult audit = run_ogc("audit --json " + (folder / "run").string());
    CHECK(audit.status == 0);
    CHECK(nlohmann::json::parse(audit.out).at("states").size() == reader.frame_count());
  }
}

TEST_CASE("the same command twice gives the same bits, whatever the number of threads and the audit", "[property]") {
  const TemporaryFolder folder;
  const std::string command = "cloth_on_sphere --scale smoke --steps 24 --out ";
  const nlohmann::json first = run(command + (folder / "a").string() + " --audit every");
  CHECK(run(command + (folder / "b").string() + " --audit off").at("final_hash") == first.at("final_hash"));
  CHECK(run(command + (folder / "c").string() + " --audit end --threads 1").at("final_hash") == first.at("final_hash"));
  CHECK(first.at("audit").at("states") == 24);
}

TEST_CASE("a run from a stored frame continues to the same bits", "[property]") {
  const TemporaryFolder folder;
  const std::string command = "cloth_on_sphere --scale smoke --audit off ";
  const nlohmann::json whole = run(command + "--steps 24 --out " + (folder / "whole").string());
  const nlohmann::json begun = run(command + "--steps 20 --out " + (folder / "begun").string());
  std::filesystem::path last;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "begun/frames"))
    last = std::max(last, entry.path());
  const nlohmann::json continued = run(command + "--steps 24 --out " + (folder / "continued").string() +
                                       " --from-state " + last.string());
  CHECK(continued.at("first_step") == 20);
  CHECK(continued.at("final_hash") == whole.at("final_hash"));
  CHECK(begun.at("final_hash") != whole.at("final_hash"));
  const ProgramResult other = run_ogc("run twist --scale smoke --from-state " + last.string() + " --out " +
                                      (folder / "other").string());
  CHECK(other.status == 2);
  CHECK(contains(other.err, {last.filename().string(), "vertices"}));
}

TEST_CASE("a scene file runs like the built-in scene that it was written from", "[property]") {
  const TemporaryFolder folder;
  REQUIRE(run_ogc("scenes cloth_on_sphere --scale smoke --write " + (folder / "mine").string()).status == 0);
  const std::string options = " --steps 6 --audit off --out ";
  const nlohmann::json file = run((folder / "mine/cloth_on_sphere.json").string() + options + (folder / "a").string());
  CHECK(file.at("final_hash") ==
        run("cloth_on_sphere --scale smoke" + options + (folder / "b").string()).at("final_hash"));
}

TEST_CASE("the option --set reaches the run and its folder", "[unit]") {
  const TemporaryFolder folder;
  run("cloth_on_sphere --scale smoke --steps 2 --audit off --set iterations=3 --set friction_velocity=0.02 --out " +
      (folder / "run").string());
  const compare::RunReader reader(folder / "run");
  CHECK(reader.scene().settings.iterations == 3);
  CHECK(reader.scene().settings.steps == 2);
  CHECK(reader.scene().settings.friction_velocity == 0.02f);
}

TEST_CASE("an activation, a model or a form of damping that is set is the one that runs", "[property]") {
  const TemporaryFolder folder;
  const std::vector<std::string> choices{"contact_activation=ogc",       "contact_activation=ogc_as_printed",
                                         "contact_activation=quadratic", "contact_activation=ipc_log",
                                         "contact_activation=cubic",     "membrane=st_venant_kirchhoff",
                                         "bending=isometric_quadratic",  "damping=per_vertex"};
  std::set<nlohmann::json> hashes;
  for (const std::string& choice : choices)
    hashes.insert(run("cloth_on_sphere --scale smoke --steps 14 --audit off --set contact_stiffness=0.05 --set " +
                      choice + " --out " + (folder / choice).string())
                      .at("final_hash"));
  CHECK(hashes.size() == choices.size());
}

TEST_CASE("the option --profile adds the times of the stages to steps.csv", "[unit]") {
  const TemporaryFolder folder;
  run("cloth_on_sphere --scale smoke --steps 2 --audit off --profile --out " + (folder / "run").string());
  CHECK(!compare::RunReader(folder / "run").stage_names().empty());
}

TEST_CASE("a start that intersects exits 2 and names each pair and body, before any folder is made", "[unit]") {
  const TemporaryFolder folder;
  const std::string file = compare::write_scene(folder / "scene", two_triangles(true)).string();
  const ProgramResult result = run_ogc("run " + file + " --out " + (folder / "run").string());
  INFO(result.err);
  CHECK(result.status == 2);
  CHECK(contains(result.err,
                 {"2 intersections", "edge of body 'upper' (vertices 0, 1; ", "edge of body 'upper' (vertices 0, 2; ",
                  "face 0 of body 'lower' (vertices 0, 1, 2; ", "lower.ply", "upper.ply"}));
  CHECK(!std::filesystem::exists(folder / "run"));
}

TEST_CASE("wrong settings, files and options of a run exit 2 and say what to do", "[unit]") {
  const TemporaryFolder folder;
  const auto fails = [&](const std::string& arguments, std::initializer_list<std::string> parts) {
    const ProgramResult result = run_ogc("run " + arguments + " --out " + (folder / "run").string());
    INFO(arguments << "\n" << result.err);
    CHECK(result.status == 2);
    CHECK(contains(result.err, parts));
    CHECK(!std::filesystem::exists(folder / "run"));
  };
  fails("twist --scale smoke --set iterations=0", {"iterations"});
  fails("twist --scale smoke --set time_step=minus", {"time_step"});
  fails("twist --scale smoke --set iteration=3", {"iteration", "iterations"});
  fails("twist --scale smoke --set iterations", {"key=value"});
  fails("twist --scale huge", {"huge", "smoke"});
  fails("twist --scale smoke --steps 0", {"--steps"});
  fails("twist --scale smoke --solver admm", {"admm", "vbd", "newton", "ipc"});
  fails("twist --scale smoke --solver newton --backend cuda", {"newton", "CPU"});
  fails("twist --scale smoke --condition", {"--condition", "newton"});
  fails("twist --scale smoke --solver reference_vbd --backend cuda", {"reference_vbd", "CPU"});
  fails("twist --scale smoke --solver newton --set contact_activation=barrier", {"contact_activation", "ipc_log"});
  fails("twist --scale smoke --set membrane=neo", {"membrane", "unknown model 'neo'"});
  fails("twist --scale smoke --solver newton --set damping=per_vertex", {"per_vertex", "vbd"});
  fails("twist --scale smoke --solver magic", {"--solver"});
  fails((folder / "missing.json").string(), {"missing.json"});
  fails("twist --scale smoke --from-state " + (folder / "missing.h5").string(), {"missing.h5"});
  const std::string file = compare::write_scene(folder / "scene", two_triangles(false)).string();
  fails(file + " --scale smoke", {"--scale"});
}

TEST_CASE("Newton runs a scene into the same kind of folder, keeps the guarantee and records its iterations",
          "[figure]") {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string();
  const ProgramResult result = run_ogc(
      "run cloth_on_sphere --scale smoke --solver newton --steps 8 --audit every --condition --json --out " + run);
  INFO(result.err);
  REQUIRE(result.status == 0);
  const auto summary = nlohmann::json::parse(result.out);
  CHECK(summary["solver"] == "newton");
  CHECK(summary["guarantee_kept"] == true);
  CHECK(summary["audit"]["states"] == 8);
  const compare::StepTable table = compare::read_steps(run);
  REQUIRE(table.rows.size() == 8);
  for (const compare::StepMetrics& row : table.rows) CHECK(row.residual < 1e-2);
  std::ifstream iterations(folder / "run" / "iterations.csv");
  std::string header, first;
  std::getline(iterations, header);
  std::getline(iterations, first);
  CHECK(header.find("residual [1]") != std::string::npos);
  CHECK(header.ends_with("condition_number [1],condition_without_friction [1],condition_without_contact [1]"));
  CHECK(first.find("nan") == std::string::npos);  // all condition numbers are numbers
}

TEST_CASE("IPC runs a scene into the same kind of folder, without an intersection, and counts its detections by kind",
          "[figure]") {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string();
  const ProgramResult result = run_ogc(
      "run cloth_on_sphere --scale smoke --solver ipc --steps 12 --audit every --profile --iterations --json --out " +
      run);
  INFO(result.err);
  REQUIRE(result.status == 0);
  const auto summary = nlohmann::json::parse(result.out);
  CHECK(summary["solver"] == "ipc");
  CHECK(summary["guarantee_kept"] == true);
  const compare::StepTable table = compare::read_steps(run);
  REQUIRE(table.rows.size() == 12);
  for (const compare::StepMetrics& row : table.rows) {
    CHECK(row.continuous_detections >= row.iterations - 1);
    CHECK(row.discrete_detections >= row.iterations);
  }
  CHECK(table.rows.back().vertex_facet_contacts > 0);
  // The run starts from a stored state, as timed parts of long runs do.
  const ProgramResult window = run_ogc("run cloth_on_sphere --scale smoke --solver ipc --steps 13 --from-state " + run +
                                       "/frames/frame_000012.h5 --out " + run + "_window");
  INFO(window.err);
  CHECK(window.status == 0);
}

TEST_CASE("rows an iteration end where the step ends, in scenes with prescribed motions, too", "[figure]") {
  const TemporaryFolder folder;
  const std::string start = (folder / "start").string(), out = (folder / "run").string();
  run("twist --scale smoke --steps 30 --audit off --out " + start);
  run("twist --scale smoke --steps 31 --iterations --residual --audit off --from-state " + start +
      "/frames/frame_000030.h5 --out " + out);
  const compare::StepTable table = compare::read_steps(out);
  REQUIRE(table.rows.size() == 1);
  // The residuals in steps.csv and iterations.csv are equal only without contacts, because the end of a step may have
  // new contacts.
  REQUIRE(table.rows[0].vertex_facet_contacts + table.rows[0].edge_edge_contacts == 0);
  std::ifstream file(folder / "run" / "iterations.csv");
  std::string line, last;
  while (std::getline(file, line)) last = line;
  std::istringstream fields(last);
  std::vector<std::string> row;
  for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
  CHECK(row.at(0) == "31");
  CHECK(row.at(1) == "10");
  CHECK(std::stod(row.at(3)) == table.rows[0].residual);
}

TEST_CASE("vbd in single and in double record their residual over iterations of a step with contacts", "[figure]") {
  const TemporaryFolder folder;
  const std::string start = (folder / "start").string(),
                    scene =
                        "cloth_on_sphere --scale smoke --set detection_fraction=0 --set detection_every=5 --audit end ";
  run(scene + "--steps 8 --out " + start);
  std::vector<double> last;
  for (const char* solver : {"vbd", "reference_vbd"}) {
    const std::string out = (folder / solver).string();
    run(scene + "--steps 9 --set iterations=60 --iterations --profile --from-state " + start +
        "/frames/frame_000008.h5 --solver " + solver + " --out " + out);
    const compare::StepTable table = compare::read_steps(out);
    REQUIRE(table.rows.size() == 1);
    last.push_back(table.rows[0].residual);
    std::ifstream file(folder / solver / "iterations.csv");
    std::string line;
    std::int64_t rows = 0, detections = 0;
    while (std::getline(file, line)) {
      if (!line.starts_with("9,")) continue;
      ++rows;
      detections += line.ends_with(",1,nan,nan,nan");  // without a matrix there are no condition numbers
    }
    CHECK(rows == 61);
    CHECK(detections >= 11);
  }
  CHECK(last[0] < 1e-3);
  CHECK(last[1] < last[0]);
}

TEST_CASE("the option --residual fills the residual of steps.csv and changes no bit", "[unit]") {
  const TemporaryFolder folder;
  const std::string options = "twist --scale smoke --steps 4 --audit off --out ";
  const nlohmann::json plain = run(options + (folder / "plain").string()),
                       with = run("--residual " + options + (folder / "with").string());
  CHECK(plain.at("final_hash") == with.at("final_hash"));
  for (const compare::StepMetrics& row : compare::read_steps(folder / "plain").rows) CHECK(std::isnan(row.residual));
  for (const compare::StepMetrics& row : compare::read_steps(folder / "with").rows)
    CHECK((row.residual > 0 && row.residual < 1));
}

TEST_CASE("a run says where its time went, in its summary and in run.json", "[unit]") {
  const TemporaryFolder folder;
  const std::string options = "cloth_on_sphere --scale smoke --set frame_steps=1 --audit frame --out ";
  const nlohmann::json seconds = run(options + (folder / "run").string()).at("seconds");
  INFO(seconds.dump());
  double sum = 0;
  for (const char* part : {"start", "steps", "audits", "writing"}) {
    CHECK(seconds.at(part) > 0);
    sum += seconds.at(part).get<double>();
  }
  // The four times are of one thread, so they do not overlap. Only the wait for the disk before the first step is in
  // two of them, `start` and `writing`.
  CHECK(sum - seconds.at("start").get<double>() < seconds.at("whole"));
  double rows = 0;
  for (const compare::StepMetrics& row : compare::read_steps(folder / "run").rows) rows += row.wall_ms / 1000;
  CHECK(seconds.at("steps").get<double>() == Approx(rows));
  const std::map<std::string, std::string> extra = compare::RunReader(folder / "run").provenance().extra;
  for (const auto& [part, key] : {std::pair{"whole", "whole_seconds"},
                                  {"start", "start_seconds"},
                                  {"steps", "step_seconds"},
                                  {"audits", "audit_seconds"},
                                  {"writing", "writing_seconds"}})
    CHECK(std::stod(extra.at(key)) == Approx(seconds.at(part).get<double>()).epsilon(1e-4));
}

TEST_CASE("a step of Newton's that does not converge exits 1, says what to do and keeps the state before it",
          "[unit]") {
  const TemporaryFolder folder;
  const std::string run = (folder / "run").string();
  const ProgramResult result = run_ogc(
      "run cloth_on_sphere --scale smoke --solver newton --steps 12 --set newton_iterations=1 --out " + run);
  CHECK(result.status == 1);
  CHECK(contains(result.err, {"did not converge", "newton_iterations", "last good state"}));
  CHECK(compare::RunReader(run).frame_count() > 0);
}

TEST_CASE("a scene file whose mesh holds a NaN exits 2 and names the file", "[unit]") {
  const TemporaryFolder folder;
  compare::Scene scene = two_triangles(false);
  const std::string file = compare::write_scene(folder / "scene", scene).string();
  std::filesystem::path mesh;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "scene"))
    if (entry.path().extension() == ".ply") mesh = std::max(mesh, entry.path());
  std::ofstream(mesh) << "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty "
                         "double z\nelement face 1\n"
                         "property list uchar int vertex_indices\nend_header\n0 0 1\n1 0 nan\n0 1 1\n3 0 1 2\n";
  const ProgramResult result = run_ogc("run " + file + " --out " + (folder / "run").string());
  INFO(result.err);
  CHECK(result.status == 2);
  CHECK(contains(result.err, {mesh.filename().string()}));
}

TEST_CASE("a folder that holds a run is not written over", "[unit]") {
  const TemporaryFolder folder;
  const std::string command = "run cloth_on_sphere --scale smoke --steps 1 --audit off --out " +
                              (folder / "run").string();
  REQUIRE(run_ogc(command).status == 0);
  const ProgramResult again = run_ogc(command);
  CHECK(again.status == 2);
  CHECK(contains(again.err, {(folder / "run").string()}));
}

TEST_CASE("without a usable device --backend cuda exits 3 and says why", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_ogc(
      "run cloth_on_sphere --scale smoke --backend cuda --out " + (folder / "run").string(), "CUDA_VISIBLE_DEVICES= ");
  INFO(result.err);
  CHECK(result.status == 3);
  CHECK(contains(result.err, {"ogc: ", "CUDA"}));
  CHECK(!std::filesystem::exists(folder / "run"));
}

// A limit of the file size (in blocks of 512 bytes) imitates a full disk.
TEST_CASE("a run whose disk is full exits 3 and names the file", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_ogc(
      "run cloth_on_sphere --scale smoke --audit off --out " + (folder / "run").string(), "ulimit -f 8; ");
  INFO(result.err);
  CHECK(result.status == 3);
  CHECK(contains(result.err, {"ogc: ", (folder / "run").string()}));
}

TEST_CASE("an interrupted run exits 130 and leaves finished frames and a manifest that says so", "[unit]") {
  const TemporaryFolder folder;
  const ProgramResult result = run_ogc("run twist --scale small --audit off --out " + (folder / "run").string(),
                                       "timeout --foreground --preserve-status -s INT 2 ");
  INFO(result.err);
  CHECK(result.status == 130);
  const compare::RunReader reader(folder / "run");
  CHECK(reader.provenance().status == "interrupted");
  REQUIRE(reader.frame_count() > 0);
  CHECK(reader.frame(reader.frame_count() - 1).step < reader.scene().settings.steps);
}
