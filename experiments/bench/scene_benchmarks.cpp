#include "experiments/bench/scene_benchmarks.hpp"

#include <array>
#include <functional>
#include <stdexcept>

#include <benchmark/benchmark.h>

#include "compare/problem/error.hpp"
#include "compare/record/run_folder.hpp"
#include "experiments/bench/floor.hpp"
#include "experiments/bench/worlds_benchmarks.hpp"
#include "experiments/scenes/registry.hpp"

namespace ogc::experiments {

namespace {

using compare::StepMetrics;
using Rows = std::vector<StepMetrics>;

/// Holds the repetitions of one scene on one backend, each a window of steps, and the counted work of the scene.
class Windows {
 public:
  Windows(const BenchScene& from, fast::Backend backend, bool profile, std::int64_t steps)
      : steps_(steps), scene_(from.scene), work_(fast::sweep_work(from.scene)) {
    simulation_ = fast::contestant(backend).start(from.scene, {.profile = profile, .energies = false});
    if (from.start) simulation_->restore(*from.start);
    start_ = simulation_->snapshot();
    start_.capacities.clear();
    // This first run is not measured: lists grow to their final size, and a device records its graph.
    simulation_->advance(steps_);
  }

  const Rows& repetition(std::size_t i) {
    while (rows_.size() <= i) {
      simulation_->restore(start_);
      rows_.push_back(simulation_->advance(steps_));
    }
    return rows_[i];
  }
  std::vector<std::string> stage_names() const { return simulation_->stage_names(); }
  std::string device() const { return simulation_->device(); }
  const fast::SweepWork& work() const { return work_; }
  /// Returns the work of one detection's searches at the state after the last repetition.
  const fast::SearchWork& searches() {
    if (!searches_) {
      const compare::Snapshot end = simulation_->snapshot();
      searches_ = fast::search_work(scene_, end.positions, end.query_radius);
    }
    return *searches_;
  }

 private:
  std::int64_t steps_;
  compare::Scene scene_;
  fast::SweepWork work_;
  std::unique_ptr<compare::Simulation> simulation_;
  compare::Snapshot start_;
  std::vector<Rows> rows_;
  std::optional<fast::SearchWork> searches_;
};

/// Returns the windows for this key. Keeps only the windows of the last key, because scenes are large and all
/// benchmarks of a scene follow each other.
Windows& windows_of(const std::string& key, const std::function<std::unique_ptr<Windows>()>& make) {
  static std::string last;
  static std::unique_ptr<Windows> windows;
  if (last != key) {
    windows.reset();
    windows = make();
    last = key;
  }
  return *windows;
}

double mean(const Rows& rows, const std::function<double(const StepMetrics&)>& of) {
  double sum = 0;
  for (const StepMetrics& row : rows) sum += of(row);
  return rows.empty() ? 0 : sum / static_cast<double>(rows.size());
}

/// Work that is counted in a measured step or part of a step.
enum class Counted { nothing, sweep, searches, both };

Counted counted_of(std::string_view stage) {
  if (stage == "sweep") return Counted::sweep;
  return stage == "detection" ? Counted::searches : Counted::nothing;
}

double detections(const StepMetrics& row) { return static_cast<double>(row.discrete_detections); }

/// Holds the mean work of a step, and its floor [s] if the machine's limits are known; otherwise the floor is 0.
struct Work {
  double flop = 0, bytes = 0, floor = 0;
};

Work sweep_work(const Rows& rows, const fast::SweepWork& work, const std::optional<MachineLimits>& machine) {
  const auto of_step = [&](const auto& of_iteration) {
    return mean(rows, [&](const StepMetrics& row) { return static_cast<double>(row.iterations) * of_iteration(row); });
  };
  return {
      of_step([&](const StepMetrics& row) {
        return work.flop + static_cast<double>(row.vertex_facet_contacts) * work.flop_vertex_facet +
               static_cast<double>(row.edge_edge_contacts) * work.flop_edge_edge;
      }),
      of_step([&](const StepMetrics& row) { return iteration_work(row, work).bytes; }),
      of_step([&](const StepMetrics& row) { return machine ? sweep_floor(*machine, iteration_work(row, work)) : 0; })};
}

Work search_work(benchmark::State& state, double each_step, const fast::SearchWork& work,
                 const std::optional<MachineLimits>& machine) {
  state.counters["nodes"] = each_step * work.nodes;
  state.counters["candidates"] = each_step * work.candidates;
  state.counters["distances"] = each_step * work.distances;
  return {each_step * work.flop, each_step * work.bytes, machine ? each_step * search_floor(*machine, work) : 0};
}

void count_work(benchmark::State& state, const Rows& rows, Windows& windows, Counted counted, double mean_ms) {
  const std::optional<MachineLimits> machine = limits_of(windows.device());
  const Work sweep = counted == Counted::searches ? Work{} : sweep_work(rows, windows.work(), machine);
  const Work searches = counted == Counted::sweep
                            ? Work{}
                            : search_work(state, mean(rows, detections), windows.searches(), machine);
  state.counters["flop"] = sweep.flop + searches.flop;
  state.counters["bytes"] = sweep.bytes + searches.bytes;
  if (!machine || !(mean_ms > 0)) return;
  state.counters["floor_ms"] = 1e3 * (sweep.floor + searches.floor);
  state.counters["share_of_floor"] = (sweep.floor + searches.floor) / (1e-3 * mean_ms);
}

void count_steps(benchmark::State& state, const Rows& rows) {
  state.counters["contacts"] = mean(rows, [](const StepMetrics& row) {
    return static_cast<double>(row.vertex_facet_contacts + row.edge_edge_contacts);
  });
  state.counters["detections"] = mean(rows, detections);
  state.counters["repeats"] = mean(rows, [](const StepMetrics& row) { return static_cast<double>(row.repeats); });
}

/// Reports the times of one repetition. `stage`: index of a part in StepMetrics::stage_ms; empty for the whole step.
void measure(benchmark::State& state, Windows& windows, std::size_t repetition, std::optional<std::size_t> stage,
             Counted counted) {
  const Rows& rows = windows.repetition(repetition);
  const auto milliseconds = [&](const StepMetrics& row) { return stage ? row.stage_ms[*stage] : row.wall_ms; };
  if (static_cast<benchmark::IterationCount>(rows.size()) < state.max_iterations) {
    state.SkipWithError("the simulation stopped in its window");
    return;
  }
  std::size_t k = 0;
  for (auto _ : state) state.SetIterationTime(1e-3 * milliseconds(rows[k++]));
  count_steps(state, rows);
  if (counted != Counted::nothing) count_work(state, rows, windows, counted, mean(rows, milliseconds));
}

class Registrar {
 public:
  explicit Registrar(const BenchOptions& options) : options_(options) {}

  void add(const std::string& label, const std::function<BenchScene()>& make) const {
    for (const fast::Backend backend : options_.backends) {
      add_one("step/" + label, make, backend, std::nullopt);
      for (std::size_t stage = 0; stage < stages.size(); ++stage)
        add_one("part/" + std::string(stages[stage]) + "/" + label, make, backend, stage);
    }
  }

 private:
  /// Names of the measured parts of a step, in the order of StepMetrics::stage_ms. A measurement compares them with the
  /// names that the simulation gives.
  static constexpr std::array<std::string_view, 5> stages{"begin", "detection", "initial_guess", "sweep", "metrics"};

  void add_one(const std::string& name, const std::function<BenchScene()>& make, fast::Backend backend,
               std::optional<std::size_t> stage) const {
    const Counted counted = stage ? counted_of(stages[*stage]) : Counted::both;
    const std::string key = name.substr(stage ? name.find('/', 5) : 4) + name_of(backend) + (stage ? "profiled" : "");
    const auto body = [=, steps = options_.steps,
                       repetition = std::make_shared<std::size_t>(0)](benchmark::State& state) {
      Windows& windows = windows_of(
          key, [&] { return std::make_unique<Windows>(make(), backend, stage.has_value(), steps); });
      if (stage && windows.stage_names().at(*stage) != stages[*stage])
        throw std::logic_error("the parts of a step have other names");
      measure(state, windows, (*repetition)++, stage, counted);
    };
    benchmark::RegisterBenchmark((name + "/" + name_of(backend)).c_str(), body)
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond)
        ->Iterations(options_.steps)
        ->Repetitions(options_.repetitions);
  }

  const BenchOptions& options_;
};

std::filesystem::path run_of(const std::string& frame) {
  return std::filesystem::path(frame).parent_path().parent_path();
}

}  // namespace

std::string name_of(fast::Backend backend) { return backend == fast::Backend::cpu ? "cpu" : "cuda"; }

BenchScene scene_at_frame(const std::string& frame) {
  compare::Frame state = compare::read_frame(frame);
  BenchScene result{compare::RunReader(run_of(frame)).scene(), compare::Snapshot{}};
  if (state.positions.size() != result.scene.mesh.positions.size())
    throw compare::InputError(frame + ": has another number of vertices than the scene of " + run_of(frame).string() +
                              ": give a frame where its run left it");
  result.start->step = state.step;
  result.start->positions = std::move(state.positions);
  result.start->velocities = std::move(state.velocities);
  return result;
}

std::string frame_label(const std::string& frame) {
  const compare::Manifest manifest = compare::read_manifest(run_of(frame));
  return manifest.scene_name + "@" + std::to_string(compare::read_frame(frame).step);
}

void register_scene_benchmarks(const BenchOptions& options) {
  const Registrar registrar(options);
  for (const std::string& frame : options.states)
    registrar.add(frame_label(frame), [frame] { return scene_at_frame(frame); });
  if (!options.states.empty()) return;
  if (options.worlds > 0)
    registrar.add("small_cloths/" + std::to_string(options.worlds), [worlds = options.worlds] {
      return BenchScene{small_cloths(worlds, 0.3), std::nullopt};
    });
  for (const SceneInfo& info : scenes())
    registrar.add(std::string(info.name) + "/" + options.scale, [name = info.name, scale = parse_scale(options.scale)] {
      return BenchScene{make_scene(name, scale), std::nullopt};
    });
}

}  // namespace ogc::experiments
