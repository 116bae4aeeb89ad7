// Starts worlds whose recorded programs one host thread runs (fast/worlds/host.hpp).
#pragma once

#include <memory>
#include <span>

#include "fast/worlds.hpp"

namespace ogc::fast::test {

/// Starts the worlds. `list_capacity`: see start_cpu.
std::unique_ptr<Worlds> start_host_worlds(std::span<const compare::Scene> scenes,
                                          const compare::SimulationOptions& options = {}, int list_capacity = 0);

}  // namespace ogc::fast::test
