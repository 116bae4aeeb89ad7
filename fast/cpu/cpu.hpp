// Declares what other parts of `fast` use of the CPU backend.
#pragma once

#include <memory>
#include <span>

#include "compare/contestant.hpp"
#include "fast/contact_forces.hpp"
#include "fast/contact_sets.hpp"
#include "fast/contestant.hpp"
#include "fast/guard.hpp"
#include "fast/worlds.hpp"

namespace ogc::fast {

/// Returns the number of threads of the CPU backend.
BackendInfo cpu_info();

/// Returns the memory of the machine [B].
std::size_t cpu_bytes();

/// Returns a contestant that runs all stages on the host's threads. `parts`: parts that divide a simulation.
compare::Contestant cpu_contestant(int parts = 1);

/// Starts worlds on the host's threads (fast/worlds.hpp).
std::unique_ptr<Worlds> start_cpu_worlds(std::span<const compare::Scene> scenes,
                                         const compare::SimulationOptions& options);

/// Returns the engine of a ContactFinder; `topology` must outlive it.
std::unique_ptr<ContactEngine> cpu_contact_engine(const compare::Topology& topology,
                                                  const compare::ExclusionView& exclusions);

/// Returns the engine of a Guard.
std::unique_ptr<GuardEngine> cpu_guard_engine(const Mesh& mesh, const GuardOptions& options);

/// Returns the engine of a ContactForces.
std::unique_ptr<ContactForceEngine> cpu_contact_force_engine(const Mesh& mesh, std::span<const compare::Vec3f> rest,
                                                             const ContactForceOptions& options,
                                                             std::span<const compare::Index> colours);

}  // namespace ogc::fast
