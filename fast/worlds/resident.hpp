// Runs resident worlds of one place: each world is a simulation that records its calls, and each launch runs the frames
// of all worlds that have steps left.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <tbb/parallel_for.h>

#include "fast/stages/simulation.hpp"
#include "fast/worlds.hpp"
#include "fast/worlds/backend.hpp"

namespace ogc::fast {

/// A simulation of one world. Its own `advance` runs it alone.
template <class Place>
using WorldSimulation = ResidentSimulation<WorldBackend<Place>>;

/// Worlds of one place.
template <class Place>
class ResidentWorlds : public Worlds {
 public:
  /// `list_capacity`: see ResidentSimulation.
  ResidentWorlds(std::span<const compare::Scene> scenes, const compare::SimulationOptions& options, std::string device,
                 int list_capacity = 0)
      : device_(std::move(device)), worlds_(scenes.size()), has_failed_(scenes.size()) {
    const auto start = [&](std::size_t w) {
      worlds_[w] = std::make_unique<WorldSimulation<Place>>(WorldBackend<Place>{}, scenes[w], options, device_,
                                                            list_capacity);
    };
    tbb::parallel_for(std::size_t{0}, scenes.size(), start);
  }

  int count() const override { return static_cast<int>(worlds_.size()); }

  using Worlds::advance;
  std::vector<std::vector<compare::StepMetrics>> advance(std::span<const std::int64_t> steps) override {
    if (steps.size() != worlds_.size()) throw std::invalid_argument("one number of steps for each world");
    std::vector<std::vector<compare::StepMetrics>> rows(worlds_.size());
    const auto left = [&](std::size_t w) {
      return has_failed_[w] != 0 ? 0 : steps[w] - static_cast<std::int64_t>(rows[w].size());
    };
    while (true) {
      std::vector<std::size_t> busy;
      std::vector<WorldBackend<Place>*> backends;
      for (std::size_t w = 0; w < worlds_.size(); ++w) {
        if (left(w) <= 0) continue;
        busy.push_back(w);
        backends.push_back(&worlds_[w]->backend());
      }
      if (busy.empty()) return rows;
      const auto for_each_busy = [&](const auto& f) {
        tbb::parallel_for(std::size_t{0}, busy.size(), [&](std::size_t k) { f(busy[k]); });
      };
      for_each_busy([&](std::size_t w) { worlds_[w]->begin_frame(left(w)); });
      run_worlds<Place>(backends.data(), backends.size());
      for_each_busy([&](std::size_t w) { has_failed_[w] = worlds_[w]->end_frame(rows[w]) ? 0 : 1; });
    }
  }

  bool has_failed(int world) const override { return has_failed_.at(static_cast<std::size_t>(world)) != 0; }
  compare::Snapshot snapshot(int world) override { return worlds_.at(static_cast<std::size_t>(world))->snapshot(); }
  void reset(int world, const compare::Snapshot& state) override {
    worlds_.at(static_cast<std::size_t>(world))->restore(state);
    has_failed_[static_cast<std::size_t>(world)] = 0;
  }
  std::string device() const override { return device_; }

 private:
  std::string device_;
  std::vector<std::unique_ptr<WorldSimulation<Place>>> worlds_;
  std::vector<char> has_failed_;
};

}  // namespace ogc::fast
