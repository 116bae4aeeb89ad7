// Runs worlds on the host's threads: each world is a simulation of its own. Worlds are tasks, and so are the loops of a
// large world.
#include <stdexcept>
#include <vector>

#include <unistd.h>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "fast/cpu/cpu.hpp"
#include "fast/cpu/simulation.hpp"
#include "fast/worlds.hpp"

namespace ogc::fast {

namespace {

constexpr auto ends_world = compare::step_not_finite | compare::step_bound_violated;

/// Worlds on the host's threads.
class CpuWorlds : public Worlds {
 public:
  CpuWorlds(std::span<const compare::Scene> scenes, const compare::SimulationOptions& options)
      : worlds_(scenes.size()), has_failed_(scenes.size()) {
    tbb::parallel_for(std::size_t{0}, scenes.size(),
                      [&](std::size_t w) { worlds_[w] = start_cpu(scenes[w], options); });
  }

  int count() const override { return static_cast<int>(worlds_.size()); }

  std::vector<std::vector<compare::StepMetrics>> advance(std::span<const std::int64_t> steps) override {
    if (steps.size() != worlds_.size()) throw std::invalid_argument("one number of steps for each world");
    std::vector<std::vector<compare::StepMetrics>> rows(worlds_.size());
    tbb::parallel_for(std::size_t{0}, worlds_.size(), [&](std::size_t w) {
      if (has_failed_[w] != 0 || steps[w] <= 0) return;
      // Isolated, since a thread that waits for a loop of this world would otherwise begin another world.
      tbb::this_task_arena::isolate([&] { rows[w] = worlds_[w]->advance(steps[w]); });
      has_failed_[w] = !rows[w].empty() && (rows[w].back().status & ends_world) != 0 ? 1 : 0;
    });
    return rows;
  }

  bool has_failed(int world) const override { return has_failed_.at(static_cast<std::size_t>(world)) != 0; }
  compare::Snapshot snapshot(int world) override { return worlds_.at(static_cast<std::size_t>(world))->snapshot(); }
  void reset(int world, const compare::Snapshot& state) override {
    worlds_.at(static_cast<std::size_t>(world))->restore(state);
    has_failed_[static_cast<std::size_t>(world)] = 0;
  }
  std::string device() const override { return worlds_.empty() ? std::string() : worlds_.front()->device(); }

 private:
  std::vector<std::unique_ptr<compare::Simulation>> worlds_;
  std::vector<char> has_failed_;
};

}  // namespace

std::size_t cpu_bytes() {
  return static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

std::unique_ptr<Worlds> start_cpu_worlds(std::span<const compare::Scene> scenes,
                                         const compare::SimulationOptions& options) {
  return std::make_unique<CpuWorlds>(scenes, options);
}

}  // namespace ogc::fast
