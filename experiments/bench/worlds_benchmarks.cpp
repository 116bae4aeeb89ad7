#include "experiments/bench/worlds_benchmarks.hpp"

#include <chrono>
#include <functional>

#include <benchmark/benchmark.h>

#include "compare/problem/scene.hpp"
#include "experiments/bench/floor.hpp"
#include "experiments/scenes/registry.hpp"
#include "experiments/scenes/shapes.hpp"
#include "fast/worlds.hpp"

namespace ogc::experiments {

namespace {

using WorldClock = std::chrono::steady_clock;
using WorldRows = std::vector<std::vector<compare::StepMetrics>>;
using WorldScenes = std::vector<compare::Scene>;

/// Worlds that repeat one window.
class WorldsWindow {
 public:
  WorldsWindow(const WorldScenes& scenes, fast::Backend backend, std::int64_t steps)
      : steps_(steps), work_(fast::sweep_work(scenes.front())), worlds_(fast::start_worlds(backend, scenes, {})) {
    for (int w = 0; w < worlds_->count(); ++w) {
      starts_.push_back(worlds_->snapshot(w));
      starts_.back().capacities.clear();
    }
    // This first run is not measured: lists grow to their final size, and programs are recorded.
    worlds_->advance(steps);
  }

  /// Runs the window once more, and returns its rows and its time [s].
  std::pair<WorldRows, double> repeat() {
    for (int w = 0; w < worlds_->count(); ++w) worlds_->reset(w, starts_[static_cast<std::size_t>(w)]);
    const WorldClock::time_point begin = WorldClock::now();
    WorldRows rows = worlds_->advance(steps_);
    return {std::move(rows), std::chrono::duration<double>(WorldClock::now() - begin).count()};
  }
  std::int64_t steps() const { return steps_; }
  const fast::SweepWork& work() const { return work_; }
  std::string device() const { return worlds_->device(); }

 private:
  std::int64_t steps_;
  fast::SweepWork work_;
  std::unique_ptr<fast::Worlds> worlds_;
  std::vector<compare::Snapshot> starts_;
};

/// Adds what a step of all worlds has: contacts, detections, the device's time, and the floor of the sweeps: their
/// counted instructions and bytes, without any launch.
void count_worlds(benchmark::State& state, const WorldsWindow& window, const WorldRows& rows) {
  double contacts = 0, detections = 0, device = 0, repeats = 0;
  IterationWork sum;
  for (const auto& of_world : rows) {
    for (const compare::StepMetrics& row : of_world) {
      contacts += static_cast<double>(row.vertex_facet_contacts + row.edge_edge_contacts);
      detections += static_cast<double>(row.discrete_detections);
      repeats += static_cast<double>(row.repeats);
      sum += static_cast<double>(row.iterations) * iteration_work(row, window.work());
    }
  }
  for (const compare::StepMetrics& row : rows.front()) device += row.wall_ms;
  const auto steps = static_cast<double>(window.steps()), worlds = static_cast<double>(rows.size());
  state.counters["worlds"] = worlds;
  state.counters["free_vertices"] = window.work().vertices;
  state.counters["contacts"] = contacts / steps / worlds;
  state.counters["detections"] = detections / steps / worlds;
  state.counters["repeats"] = repeats;
  state.counters["device_ms"] = device / steps;
  state.counters["bytes"] = sum.bytes / steps;
  const std::optional<MachineLimits> machine = limits_of(window.device());
  if (!machine) return;
  state.counters["floor_ms"] = 1e3 * worlds_floor(*machine, sum) / steps;
}

void add_worlds(const BenchOptions& options, const std::string& name, const std::function<WorldScenes()>& make) {
  for (const fast::Backend backend : options.backends) {
    // A window is made by the first repetition and goes with the last one: worlds take much memory.
    const auto window = std::make_shared<std::unique_ptr<WorldsWindow>>();
    const auto left = std::make_shared<int>(options.repetitions);
    const auto body = [=, steps = options.steps](benchmark::State& state) {
      if (*window == nullptr) *window = std::make_unique<WorldsWindow>(make(), backend, steps);
      const auto [rows, seconds] = (*window)->repeat();
      bool is_whole = true;
      for (const auto& of_world : rows) is_whole = is_whole && static_cast<std::int64_t>(of_world.size()) == steps;
      if (is_whole) {
        for (auto _ : state) state.SetIterationTime(seconds / static_cast<double>(steps));
        count_worlds(state, **window, rows);
      } else {
        state.SkipWithError("a world stopped in its window");
      }
      if (--*left == 0) window->reset();
    };
    benchmark::RegisterBenchmark((name + "/" + name_of(backend)).c_str(), body)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(options.steps)
        ->Repetitions(options.repetitions);
  }
}

}  // namespace

compare::Scene small_cloths(int count, double speed) {
  compare::Scene scene;
  scene.name = "small_cloths";
  scene.settings.iterations = 10;
  compare::Material material;
  material.bending_damping = material.membrane_damping = 2e-6;
  for (int c = 0; c < count; ++c) {
    const double x = 0.2 * (c % 32), z = 0.2 * (c / 32);
    const auto place = [&](compare::Mesh mesh, bool falls) {
      for (compare::Vec3& p : mesh.positions) {
        if (falls) p.y += 0.1 * p.x + 0.05 * p.z;
        p.x += x, p.z += z;
      }
      return mesh;
    };
    append_body(scene, {.name = "cloth", .material = material}, place(grid(9, 0.10, 0.012), true));
    scene.velocities.resize(scene.mesh.positions.size(), {0.1, -speed, 0.05});
    append_body(scene, {.name = "floor", .fixed = true, .material = material}, place(grid(5, 0.12, 0), false));
    scene.velocities.resize(scene.mesh.positions.size());
  }
  return scene;
}

void register_worlds_benchmarks(const BenchOptions& options) {
  const int worlds = options.worlds;
  if (worlds == 0) return;
  const std::string label = "worlds/" + std::to_string(worlds) + "/";
  add_worlds(options, label + "small_cloth", [worlds] {
    WorldScenes scenes;
    for (int w = 0; w < worlds; ++w) scenes.push_back(small_cloths(1, 0.3 + 1e-5 * w));
    return scenes;
  });
  for (const SceneInfo& info : scenes())
    add_worlds(options, label + std::string(info.name) + "/" + options.scale,
               [worlds, name = info.name, scale = parse_scale(options.scale)] {
                 return WorldScenes(static_cast<std::size_t>(worlds), make_scene(name, scale));
               });
}

}  // namespace ogc::experiments
