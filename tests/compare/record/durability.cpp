// Tests what a run folder contains after kill -9 ended its writer at any moment, or after the disk became full.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <thread>

#include "compare/files/hdf5.hpp"
#include "compare/problem/error.hpp"
#include "compare/record/run_folder.hpp"
#include "compare/record/steps_csv.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/small_disk.hpp"
#include "tests/compare/record/small_run.hpp"

using namespace ogc::compare;
using namespace ogc::tests;

namespace {

Scene strip_scene(Index vertices) {
  Scene scene;
  scene.name = "strip";
  for (Index v = 0; v < vertices; ++v) scene.mesh.positions.push_back({0.01 * (v / 2), 0, 0.01 * (v % 2)});
  for (Index v = 0; v + 2 < vertices; ++v) scene.mesh.triangles.push_back({v, v + 1, v + 2});
  scene.rest_positions = scene.mesh.positions;
  scene.velocities.resize(scene.mesh.positions.size());
  scene.bodies = {{.name = "strip",
                   .first_vertex = 0,
                   .vertex_count = vertices,
                   .first_triangle = 0,
                   .triangle_count = vertices - 2,
                   .fixed = false,
                   .material = {}}};
  round_to_single(scene);
  return scene;
}

Frame strip_frame(std::int64_t step, Index vertices) {
  return recorded_frame(step, static_cast<std::size_t>(vertices));
}

/// What a writer reported before it was killed.
struct Report {
  std::int64_t frames = 0, last_step = -1, rows = 0;
};

/// Writes frames and rows without end. After each step reports to `pipe` what is written.
[[noreturn]] void write_for_ever(const std::filesystem::path& folder, Index vertices, int pipe) {
  RunWriter run(folder, strip_scene(vertices), recorded_provenance(), {});
  for (std::int64_t step = 0;; ++step) {
    run.add_frame(strip_frame(step, vertices));
    run.add_steps({recorded_metrics(step + 1)});
    if (step % 7 == 6) run.flush();
    const RunWriter::Written written = run.written();
    const Report report{written.frames, written.last_step, step + 1};
    if (write(pipe, &report, sizeof report) != sizeof report) std::abort();
  }
}

/// Starts a writer, kills it after this many milliseconds, and returns its last report.
Report killed_after(int milliseconds, const std::filesystem::path& folder, Index vertices) {
  std::array<int, 2> ends{};
  REQUIRE(pipe(ends.data()) == 0);
  const pid_t child = fork();
  if (child == 0) write_for_ever(folder, vertices, ends[1]);
  close(ends[1]);
  std::thread killer([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    kill(child, SIGKILL);
  });
  Report last, report;
  while (read(ends[0], &report, sizeof report) == sizeof report) last = report;
  killer.join();
  int status = 0;
  waitpid(child, &status, 0);
  close(ends[0]);
  REQUIRE(WIFSIGNALED(status));
  return last;
}

std::vector<float> points_of_step(const Hdf5File& file, std::size_t step, std::size_t vertices) {
  const std::vector<float> points = file.read<float>("VTKHDF/Points");
  const auto first = points.begin() + 3 * file.read<std::int64_t>("VTKHDF/Steps/PointOffsets").at(step);
  return {first, first + static_cast<std::ptrdiff_t>(3 * vertices)};
}

/// Checks that the trajectory contains every frame of the folder, in order and bit for bit.
void check_trajectory(const std::filesystem::path& folder) {
  const RunReader run(folder);
  const Hdf5File file = Hdf5File::open(folder / "trajectory.vtkhdf");
  const std::vector<double> times = file.read<double>("VTKHDF/Steps/Values");
  REQUIRE(times.size() == run.frame_count());
  for (const std::size_t i : {std::size_t{0}, run.frame_count() / 2, run.frame_count() - 1}) {
    const Frame frame = run.frame(i);
    CHECK(times[i] == frame.time);
    CHECK(std::ranges::equal(points_of_step(file, i, frame.positions.size()), as_floats(frame.positions)));
  }
}

}  // namespace

TEST_CASE("kill -9 at any moment leaves every frame and row that was reported as written, whole, and the run goes on",
          "[property]") {
  constexpr Index vertices = 2000;
  const unsigned seed = std::random_device{}();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  std::int64_t reported = 0;
  for (int attempt = 0; attempt < 5; ++attempt) {
    const Scratch folder;
    const Report report = killed_after(100 + static_cast<int>(random() % 500), folder / "run", vertices);
    if (report.rows == 0) continue;  // killed too early
    reported += report.frames;
    {
      const RunReader run(folder / "run");
      CHECK(run.provenance().status == "running");
      REQUIRE(static_cast<std::int64_t>(run.frame_count()) >= report.frames);
      for (std::size_t i = 0; i < run.frame_count(); ++i)
        CHECK(run.frame(i) == strip_frame(static_cast<std::int64_t>(i), vertices));
      CHECK(static_cast<std::int64_t>(read_steps(folder / "run").rows.size()) >= report.rows);
      CHECK_FALSE(std::filesystem::exists(folder / "run/trajectory.vtkhdf"));
    }
    const std::int64_t step = report.last_step;
    RunWriter run(folder / "run", strip_scene(vertices), step, "");
    for (const auto& entry : std::filesystem::directory_iterator(folder / "run/frames"))
      CHECK(entry.path().extension() == ".h5");
    run.keep_frames([&](std::int64_t kept) { return kept <= step; });
    for (std::int64_t next = step + 1; next < step + 4; ++next) run.add_frame(strip_frame(next, vertices));
    run.finish("finished");
    CHECK(static_cast<std::int64_t>(RunReader(folder / "run").frame_count()) == step + 4);
    CHECK_FALSE(std::filesystem::exists(folder / "run/trajectory.vtkhdf.growing"));
    check_trajectory(folder / "run");
  }
  CHECK(reported > 0);
}

TEST_CASE("frames are reported as written once they have their names, within seconds and without being asked for",
          "[unit]") {
  const Scratch folder;
  RunWriter run(folder / "run", recorded_scene(), recorded_provenance(), {});
  CHECK(run.written().last_step == -1);
  run.add_frame(recorded_frame(0));
  run.add_frame(recorded_frame(5));
  for (int i = 0; i < 100 && run.written().frames < 2; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(100));
  CHECK(run.written().frames == 2);
  CHECK(run.written().last_step == 5);
  CHECK(RunReader(folder / "run").frame_count() == 2);
}

TEST_CASE(
    "the trajectory grows with the frames, and is that which is assembled from them, whatever the size of a frame",
    "[property]") {
  // The mesh has too few vertices for a packed chunk, enough for one chunk, or more than one chunk holds.
  const Index vertices = GENERATE(10, 1500, 70001);
  const Scratch folder;
  RunWriter run(folder / "run", strip_scene(vertices), recorded_provenance(), {});
  const std::filesystem::path growing = folder / "run/trajectory.vtkhdf.growing";
  std::uintmax_t before = 0;
  for (std::int64_t step = 0; step < 4; ++step) {
    run.add_frame(strip_frame(step, vertices));
    run.flush();
    CHECK(std::filesystem::file_size(growing) > before);
    before = std::filesystem::file_size(growing);
  }
  assemble_trajectory(folder / "run");  // Assembling it in another program does not disturb the writer.
  check_trajectory(folder / "run");
  run.finish("finished");
  CHECK_FALSE(std::filesystem::exists(growing));
  check_trajectory(folder / "run");
}

TEST_CASE(
    "a full disk is told with the path, by the next call; frames that were written stay, and the run goes on later",
    "[property]") {
  constexpr Index vertices = 2000;
  const Scratch folder;
  {
    RunWriter run(folder / "run", strip_scene(vertices), recorded_provenance(), {});
    const SmallDisk disk(2500000);  // limit of a file's size, which the trajectory exceeds after some frames
    const auto write_many = [&] {
      for (std::int64_t step = 0; step < 100; ++step) run.add_frame(strip_frame(step, vertices));
      run.flush();
    };
    CHECK_THROWS_WITH(write_many(), ContainsSubstring((folder / "run/trajectory.vtkhdf").string()) &&
                                        ContainsSubstring("can't reserve"));
    CHECK_THROWS_AS(run.add_frame(strip_frame(101, vertices)), ResourceError);
    CHECK_THROWS_AS(run.finish("finished"), ResourceError);
    CHECK(RunReader(folder / "run").provenance().status == "running");
    run.give_up("failed: the disk is full");
  }
  std::int64_t frames = 0;
  {
    const RunReader run(folder / "run");
    CHECK(run.provenance().status == "failed: the disk is full");
    frames = static_cast<std::int64_t>(run.frame_count());
    REQUIRE(frames > 1);
    for (std::int64_t i = 0; i < frames; ++i) CHECK(run.frame(static_cast<std::size_t>(i)) == strip_frame(i, vertices));
  }
  RunWriter run(folder / "run", strip_scene(vertices), frames - 1, "");
  run.add_frame(strip_frame(frames, vertices));
  run.finish("finished");
  check_trajectory(folder / "run");
}

TEST_CASE("files of HDF5 may be used by several threads, each by one", "[property]") {
  const Scratch folder;
  std::vector<std::thread> threads;
  std::atomic<int> wrong = 0;
  for (std::int64_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (std::int64_t step = 10 * t; step < 10 * t + 10; ++step) {
        const std::filesystem::path path = folder / (frame_name(step) + ".h5");
        write_durably(path, frame_bytes(pack(strip_frame(step, 1500))));
        if (read_frame(path) != strip_frame(step, 1500)) ++wrong;
      }
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(wrong == 0);
}
