// Worlds as Python sees them: many scenes that run side by side.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/problem/scene.hpp"
#include "fast/worlds.hpp"

namespace ogc::python {

/// Scenes that run side by side and never see each other (fast/worlds.hpp). Several threads may call it, one after the
/// other is served.
class Worlds {
 public:
  /// `scenes`: results of `checked`. Throws compare::InputError if there is none, and compare::ResourceError if the
  /// backend is not there or has too little memory.
  Worlds(const std::vector<compare::Scene>& scenes, std::string_view backend,
         const compare::SimulationOptions& options);

  std::size_t count() const { return vertices_.size(); }
  /// Runs steps[w] steps in each world w, and returns the rows of each. Throws compare::InputError if there are not
  /// count() numbers of at least 0.
  std::vector<std::vector<compare::StepMetrics>> advance(std::span<const std::int64_t> steps);
  /// Returns for each world why it stands still; empty for one that goes on.
  std::vector<std::string> failures() const;
  /// Returns the state of a world. Throws compare::InputError if there is no such world.
  compare::Snapshot snapshot(std::int64_t world) const;
  /// Continues a world from a snapshot. Throws as `snapshot` does, and if it has another number of vertices.
  void reset(std::int64_t world, const compare::Snapshot& state);
  std::string device() const { return worlds_->device(); }

 private:
  int number_of(std::int64_t world) const;

  std::vector<std::size_t> vertices_;  // of each world
  std::vector<std::string> failures_;
  std::unique_ptr<fast::Worlds> worlds_;
  mutable std::mutex busy_;
};

}  // namespace ogc::python
