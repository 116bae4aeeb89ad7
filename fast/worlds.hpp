// Runs many worlds side by side: scenes that never see each other, with settings, states and lengths of their own. On a
// device all worlds share each launch, one block a world, so that thousands of small scenes fill it; on the CPU they
// are spread over the threads. A world computes the same bits beside any others, and alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "fast/contestant.hpp"

namespace ogc::fast {

/// Worlds that run side by side, numbered from 0.
class Worlds {
 public:
  virtual ~Worlds() = default;

  /// Returns the number of worlds.
  virtual int count() const = 0;
  /// Runs steps[w] steps in each world w, and returns its rows. A world whose row has step_not_finite or
  /// step_bound_violated stops there; the others go on. It does no further step until `reset`. A world whose lists were
  /// too small repeats its step; the others need not. Throws std::invalid_argument if there are not count() numbers.
  virtual std::vector<std::vector<compare::StepMetrics>> advance(std::span<const std::int64_t> steps) = 0;
  /// Runs `steps` steps in each world.
  std::vector<std::vector<compare::StepMetrics>> advance(std::int64_t steps) {
    return advance(std::vector<std::int64_t>(static_cast<std::size_t>(count()), steps));
  }
  /// Returns whether a step of a world failed since its start or its last reset.
  virtual bool has_failed(int world) const = 0;
  /// Returns the state of a world.
  virtual compare::Snapshot snapshot(int world) = 0;
  /// Continues a world from a snapshot (see compare::Simulation::restore).
  virtual void reset(int world, const compare::Snapshot& state) = 0;
  /// Returns one line about the device.
  virtual std::string device() const = 0;
};

/// Starts one world for each scene. Throws what the start of a single scene throws; compare::InputError if there is no
/// scene, or for `options` with a profile, which worlds do not have; and what expect_room throws for so many worlds of
/// the first scene.
std::unique_ptr<Worlds> start_worlds(Backend backend, std::span<const compare::Scene> scenes,
                                     const compare::SimulationOptions& options = {});

/// Returns the memory that a world of this scene needs at its start [B]. Lists that grow need more.
std::size_t world_bytes(const compare::Scene& scene);
/// Returns the memory that worlds may take [B]: the free memory of the device, or all memory of the machine. Throws
/// compare::ResourceError if the device cannot be used.
std::size_t free_bytes(Backend backend);
/// Throws compare::ResourceError if so many worlds of this scene do not fit into free_bytes; the message says what they
/// need, and how many fit.
void expect_room(Backend backend, const compare::Scene& scene, std::size_t worlds);

}  // namespace ogc::fast
