#include "compare/record/run_folder.hpp"

#include <sys/wait.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <limits>

#include "compare/files/hdf5.hpp"
#include "compare/problem/error.hpp"
#include "compare/record/checkpoint.hpp"
#include "compare/record/frame_file.hpp"
#include "compare/record/steps_csv.hpp"
#include "tests/catch.hpp"
#include "tests/compare/record/small_run.hpp"

using namespace ogc::compare;
using namespace ogc::tests;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void replace_in(const std::filesystem::path& path, const std::string& what, const std::string& by) {
  std::string text = text_of(path);
  text.replace(text.find(what), what.size(), by);
  std::ofstream(path, std::ios::binary) << text;
}

RunWriter start(const std::filesystem::path& folder, std::vector<std::string> stage_names = {}) {
  return {folder, recorded_scene(), recorded_provenance(), std::move(stage_names)};
}

}  // namespace

TEST_CASE("a finished run comes back: scene, provenance, steps, frames in the order of steps", "[unit]") {
  const Scratch folder;
  {
    RunWriter run = start(folder / "run", {"detect"});
    for (const std::int64_t step : {0, 10, 2, 1234567}) run.add_frame(recorded_frame(step));
    run.add_steps({recorded_metrics(1), recorded_metrics(2)});
    run.add_steps({recorded_metrics(3)});
    run.set_extra("guarantee_kept", "yes");
    run.set_extra("scale", "smoke");
    run.finish("finished");
  }
  const RunReader run(folder / "run");
  CHECK(run.scene() == recorded_scene());
  CHECK(run.provenance().status == "finished");
  CHECK(run.provenance().command == "ogc run \"small\"");
  CHECK(run.provenance().dirty);
  CHECK(run.provenance().started.size() == 20);  // as in 2026-01-31T23:59:59Z
  CHECK(run.provenance().ended >= run.provenance().started);
  CHECK(run.provenance().extra == std::map<std::string, std::string>{{"guarantee_kept", "yes"}, {"scale", "smoke"}});
  CHECK(run.stage_names() == std::vector<std::string>{"detect"});
  REQUIRE(run.frame_count() == 4);
  const std::array<std::int64_t, 4> steps{0, 2, 10, 1234567};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(run.frame_step(i) == steps[i]);
    CHECK(run.frame(i) == recorded_frame(steps[i]));
  }
  CHECK(read_steps(folder / "run").rows.size() == 3);
}

TEST_CASE("run.json says what plots need: sizes, bodies, settings with units, extra entries at the top", "[unit]") {
  const Scratch folder;
  RunWriter run = start(folder / "run");
  run.set_extra("guarantee_kept", "no");
  run.finish("failed: audit");
  const std::string text = text_of(folder / "run/run.json");
  for (const char* part : {"\n  \"status\": \"failed: audit\"", "\n  \"guarantee_kept\": false", "\n  \"seed\": 42",
                           "\"vertices\": 10", "\"first_triangle\": 2", "\"unit\": \"kg/m²\"", "\"contact_radius\": {",
                           "\"meaning\"", "\"file\": \"scene/small.json\""})
    CHECK_THAT(text, ContainsSubstring(part));
  run.set_extra("status", "wonderful");
  CHECK_THROWS_AS(run.finish("finished"), std::invalid_argument);
}

TEST_CASE("what began is readable before the first step and after a run without frames", "[unit]") {
  const Scratch folder;
  RunWriter run = start(folder / "deep/in/run");
  CHECK(RunReader(folder / "deep/in/run").provenance().status == "running");
  CHECK(RunReader(folder / "deep/in/run").frame_count() == 0);
  CHECK(read_steps(folder / "deep/in/run").rows.empty());
  CHECK_THROWS_AS(assemble_trajectory(folder / "deep/in/run"), InputError);
  run.finish("finished");
  CHECK_FALSE(std::filesystem::exists(folder / "deep/in/run/trajectory.vtkhdf"));
}

TEST_CASE("a killed run leaves every finished frame, every whole row and the status running", "[unit]") {
  const Scratch folder;
  const pid_t child = fork();
  if (child == 0) {
    RunWriter run = start(folder / "run");
    for (std::int64_t step = 0; step < 3; ++step) {
      run.add_frame(recorded_frame(step));
      run.add_steps({recorded_metrics(step + 1)});
    }
    run.flush();
    std::ofstream(partial_name(folder / "run/frames/frame_000003.h5")) << "half a fra";
    std::ofstream(folder / "run/steps.csv", std::ios::app) << "4,0.4,40," << std::flush;
    raise(SIGKILL);
  }
  REQUIRE(child > 0);
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
  const RunReader run(folder / "run");
  CHECK(run.provenance().status == "running");
  CHECK(run.provenance().ended.empty());
  REQUIRE(run.frame_count() == 3);
  CHECK(run.frame(2) == recorded_frame(2));
  CHECK(read_steps(folder / "run").rows.size() == 3);
  assemble_trajectory(folder / "run");
  CHECK(std::filesystem::exists(folder / "run/trajectory.vtkhdf"));
}

TEST_CASE("a folder that holds a run, or a part of one, is not touched; another file in it does no harm", "[unit]") {
  const Scratch folder;
  start(folder / "run").finish("finished");
  const std::string before = text_of(folder / "run/run.json");
  CHECK_THROWS_WITH(start(folder / "run"),
                    ContainsSubstring((folder / "run").string()) && ContainsSubstring("run.json"));
  CHECK(text_of(folder / "run/run.json") == before);
  std::filesystem::create_directories(folder / "mine/scene");
  CHECK_THROWS_AS(start(folder / "mine"), InputError);
  std::ofstream(folder / "file") << "x";
  CHECK_THROWS_WITH(start(folder / "file"), ContainsSubstring("is a file"));
  std::filesystem::create_directories(folder / "with_log");
  std::ofstream(folder / "with_log/log.txt") << "x";
  CHECK_NOTHROW(start(folder / "with_log"));
}

TEST_CASE("a run of a newer format is refused by name, a damaged one with its file", "[unit]") {
  const Scratch folder;
  const std::filesystem::path manifest = folder / "run/run.json";
  {
    RunWriter run = start(folder / "run");
    run.add_frame(recorded_frame(0));
    run.finish("finished");
  }
  replace_in(manifest, "\"format_version\": 2", "\"format_version\": 3");
  CHECK_THROWS_WITH(RunReader(folder / "run"),
                    ContainsSubstring("run.json") && ContainsSubstring("run format 3") && ContainsSubstring("newer"));
  replace_in(manifest, "\"format_version\": 3", "\"format_version\": 1");
  CHECK_NOTHROW(RunReader(folder / "run"));
  replace_in(manifest, "\"ogc run\"", "\"ogc walk\"");
  CHECK_THROWS_AS(RunReader(folder / "run"), InputError);
  replace_in(manifest, "\"ogc walk\"", "\"ogc run\",,");
  CHECK_THROWS_WITH(RunReader(folder / "run"), ContainsSubstring(manifest.string()));
  CHECK_THROWS_WITH(RunReader(folder / "nowhere"), ContainsSubstring("nowhere"));
}

TEST_CASE("frames that do not fit the scene are refused, when written and when read", "[unit]") {
  const Scratch folder;
  RunWriter run = start(folder / "run");
  CHECK_THROWS_AS(run.add_frame(recorded_frame(0, 9)), std::invalid_argument);
  Hdf5File other = Hdf5File::create_in_memory("other");
  const Frame frame = recorded_frame(0, 4);
  other.write("positions", as_floats(frame.positions), 3);
  other.write("velocities", as_floats(frame.velocities), 3);
  write_durably(folder / "run/frames/frame_000001.h5", other.image());
  CHECK_THROWS_WITH(RunReader(folder / "run").frame(0),
                    ContainsSubstring("frame_000001.h5") && ContainsSubstring("'bounds'"));
  other.write("bounds", std::span<const float>(frame.bounds));
  other.set_attribute("/", "step", std::array<std::int64_t, 1>{1});
  other.set_attribute("/", "time", 0.0);
  write_durably(folder / "run/frames/frame_000001.h5", other.image());
  CHECK_THROWS_WITH(RunReader(folder / "run").frame(0), ContainsSubstring("4 vertices") && ContainsSubstring("10"));
}

TEST_CASE("a frame in which any byte of its state, step or time is changed is refused by name", "[property]") {
  const Scratch folder;
  start(folder / "run").add_frame(recorded_frame(7));
  const std::filesystem::path file = folder / "run/frames/frame_000007.h5";
  const std::string whole = text_of(file);
  const Frame frame = recorded_frame(7);
  CHECK(read_frame(file) == frame);
  const auto place_of = [&](const auto* values, std::size_t count) {
    const std::string_view bytes(reinterpret_cast<const char*>(values), count * sizeof *values);
    REQUIRE(whole.find(bytes) != std::string::npos);
    return std::pair(whole.find(bytes), bytes.size());
  };
  const auto places = {place_of(frame.positions.data(), 10), place_of(frame.velocities.data(), 10),
                       place_of(frame.bounds.data(), 10), place_of(&frame.time, 1), place_of(&frame.step, 1)};
  for (const auto& [begin, size] : places)
    for (std::size_t i = begin; i < begin + size; ++i) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
      std::ofstream(file, std::ios::binary) << damaged;
      CHECK_THROWS_WITH(read_frame(file), ContainsSubstring("frame_000007.h5") && ContainsSubstring("damaged"));
    }
}

TEST_CASE("orientations of rods come back from frames, are part of their checksum, and are unit quaternions",
          "[property]") {
  const Scratch folder;
  Frame frame = recorded_frame(7);
  frame.orientations = {{0, 0, 0, 1}, {0.6f, 0, 0.8f, 0}};
  start(folder / "run").add_frame(frame);
  const std::filesystem::path file = folder / "run/frames/frame_000007.h5";
  CHECK(read_frame(file) == frame);
  CHECK(frame_bytes(read_packed_frame(file)) == text_of(file));
  const std::string whole = text_of(file);
  const std::string_view bytes(reinterpret_cast<const char*>(frame.orientations.data()), 2 * sizeof(Quaternion));
  const std::size_t begin = whole.find(bytes);
  REQUIRE(begin != std::string::npos);
  for (std::size_t i = begin; i < begin + bytes.size(); ++i) {
    std::string damaged = whole;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
    std::ofstream(file, std::ios::binary) << damaged;
    CHECK_THROWS_WITH(read_frame(file), ContainsSubstring("damaged"));
  }
  frame.orientations[1][1] = 0.1f;
  write_durably(file, frame_bytes(pack(frame)));
  CHECK_THROWS_WITH(read_frame(file), ContainsSubstring("frame_000007.h5: orientation 1 is no unit quaternion"));
}

TEST_CASE(
    "a checkpoint holds orientations of rods, unit quaternions alone, and search limits, and nothing without them",
    "[unit]") {
  const Scratch folder;
  const Frame frame = recorded_frame(7);
  Checkpoint checkpoint;
  checkpoint.state.step = 7;
  checkpoint.state.positions = frame.positions;
  checkpoint.state.velocities = frame.velocities;
  checkpoint.state.bounds = frame.bounds;
  checkpoint.state.capacities = {1};
  write_checkpoint(folder.folder(), checkpoint, "scene");
  CHECK(text_of(folder / "checkpoint.h5").find("orientations") == std::string::npos);
  CHECK(text_of(folder / "checkpoint.h5").find("search_limits") == std::string::npos);
  CHECK(read_checkpoint(folder.folder(), "scene").state.search_limits.empty());
  checkpoint.state.search_limits = {0.5f, std::numeric_limits<float>::infinity()};
  write_checkpoint(folder.folder(), checkpoint, "scene");
  CHECK(read_checkpoint(folder.folder(), "scene").state.search_limits == checkpoint.state.search_limits);
  checkpoint.state.orientations = {{0, 0, 0, 1}, {0.6f, 0, 0.8f, 0}};
  write_checkpoint(folder.folder(), checkpoint, "scene");
  CHECK(read_checkpoint(folder.folder(), "scene").state.orientations == checkpoint.state.orientations);
  checkpoint.state.orientations[0][3] = 0.5f;
  write_checkpoint(folder.folder(), checkpoint, "scene");
  CHECK_THROWS_WITH(read_checkpoint(folder.folder(), "scene"),
                    ContainsSubstring("checkpoint.h5: orientation 0 is no unit quaternion"));
}

TEST_CASE("a frame without rods has no trace of them", "[unit]") {
  const std::string bytes = frame_bytes(pack(recorded_frame(7)));
  CHECK(bytes.find("orientations") == std::string::npos);
}

TEST_CASE("a frame holds measures of vertices if the run has them, and refuses those of another number", "[unit]") {
  const Scratch folder;
  Frame frame = recorded_frame(7);
  CHECK(frame_bytes(pack(frame)).find("residual") == std::string::npos);
  for (std::size_t v = 0; v < frame.positions.size(); ++v) {
    frame.residual.push_back(static_cast<float>(v) / 3);
    frame.cut.push_back(v % 2 == 0 ? 1.0f : 0.0f);
  }
  write_durably(folder / "frame.h5", frame_bytes(pack(frame)));
  CHECK(read_frame(folder / "frame.h5") == frame);
  const PackedFrame packed = read_packed_frame(folder / "frame.h5");
  CHECK(frame_bytes(packed) == text_of(folder / "frame.h5"));
  // A change of either is noticed: both are in the checksum.
  for (std::vector<float> Frame::*measure : {&Frame::residual, &Frame::cut}) {
    Frame other = frame;
    (other.*measure)[3] += 1;
    PackedFrame changed = pack(other);
    changed.checksum = packed.checksum;
    write_durably(folder / "frame.h5", frame_bytes(changed));
    CHECK_THROWS_WITH(read_frame(folder / "frame.h5"), ContainsSubstring("damaged"));
  }
  frame.cut.pop_back();
  write_durably(folder / "frame.h5", frame_bytes(pack(frame)));
  CHECK_THROWS_WITH(read_frame(folder / "frame.h5"), ContainsSubstring("'cut' is not one number for each of the 10"));
}

TEST_CASE("frames of a newer format are refused by name, those of the oldest, without a checksum, are read", "[unit]") {
  const Scratch folder;
  const Frame frame = recorded_frame(7);
  const auto write = [&](std::int64_t version) {
    Hdf5File file = Hdf5File::create_in_memory("frame");
    if (version > 1) file.set_attribute("/", "format_version", std::array{version});
    file.set_attribute("/", "step", std::array{frame.step});
    file.set_attribute("/", "time", frame.time);
    file.write("positions", as_floats(frame.positions), 3);
    file.write("velocities", as_floats(frame.velocities), 3);
    file.write("bounds", std::span<const float>(frame.bounds));
    write_durably(folder / "frame.h5", file.image());
    return folder / "frame.h5";
  };
  CHECK(read_frame(write(1)) == frame);
  CHECK_THROWS_WITH(read_frame(write(2)), ContainsSubstring("frame.h5") && ContainsSubstring("crc32"));
  CHECK_THROWS_WITH(read_frame(write(frame_format_version + 1)),
                    ContainsSubstring("frame.h5: is of frame format " + std::to_string(frame_format_version + 1) +
                                      ", newer than format " + std::to_string(frame_format_version)));
}

TEST_CASE("a trajectory holds the frames one behind the other and the cells once", "[unit]") {
  const Scratch folder;
  {
    RunWriter run = start(folder / "run");
    for (const std::int64_t step : {0, 5, 10}) run.add_frame(recorded_frame(step));
    run.finish("finished");
  }
  const Hdf5File file = Hdf5File::open(folder / "run/trajectory.vtkhdf");
  using Integers = std::vector<std::int64_t>;
  CHECK(file.read<double>("VTKHDF/Steps/Values") == std::vector{0.0, 0.05, 0.1});
  CHECK(file.read<std::int64_t>("VTKHDF/Steps/PointOffsets") == Integers{0, 10, 20});
  CHECK(file.read<std::int64_t>("VTKHDF/Steps/PointDataOffsets/body") == Integers{0, 0, 0});
  CHECK(file.read<std::int64_t>("VTKHDF/Steps/CellOffsets") == Integers(12, 0));
  CHECK(file.read<std::int64_t>("VTKHDF/Polygons/Connectivity") == Integers{0, 1, 2, 1, 3, 2, 4, 5, 6});
  CHECK(file.read<std::int64_t>("VTKHDF/Polygons/Offsets") == Integers{0, 3, 6, 9});
  CHECK(file.read<std::int64_t>("VTKHDF/Lines/Connectivity") == Integers{7, 8, 8, 9});
  CHECK(file.read<std::int64_t>("VTKHDF/Vertices/NumberOfCells") == Integers{0});
  CHECK(file.read<std::int32_t>("VTKHDF/PointData/body") == std::vector<std::int32_t>{0, 0, 0, 0, 1, 1, 1, 2, 2, 2});
  REQUIRE(file.shape("VTKHDF/Points") == std::vector<std::size_t>{30, 3});
  const std::vector<float> points = file.read<float>("VTKHDF/Points"),
                           bounds = file.read<float>("VTKHDF/PointData/bound");
  const Frame last = recorded_frame(10);
  CHECK(std::equal(points.begin() + 60, points.end(), as_floats(last.positions).begin()));
  CHECK(std::equal(bounds.begin() + 20, bounds.end(), last.bounds.begin()));
}
