// Declares the CUDA side as the rest of `fast` sees it: plain C++, no CUDA header, so that g++ compiles the callers.
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

/// Returns whether a device can run this build; if not, the description says why and what to do.
BackendInfo cuda_info();

/// Returns the free memory of the device [B]. Throws compare::ResourceError as cuda_contestant does.
std::size_t cuda_free_bytes();

/// Returns a contestant with all stages on the device. Throws compare::ResourceError if cuda_info() reports no usable
/// device.
compare::Contestant cuda_contestant(const LaunchShape& shape = {});

/// Starts a resident simulation on the device. Throws compare::ResourceError as cuda_contestant does, and if the scene
/// does not fit into the device's memory. `list_capacity`: number of contacts for which the lists have room at first;
/// 0: for those that a detection before the first step finds.
std::unique_ptr<compare::Simulation> start_cuda(const compare::Scene& scene, const compare::SimulationOptions& options,
                                                int list_capacity = 0);

/// Starts a simulation that several devices divide: the current one and those after it. Throws as start_cuda does, and
/// compare::ResourceError if there are fewer devices or one cannot write into the memory of another;
/// compare::InputError for a scene that cannot be divided.
std::unique_ptr<compare::Simulation> start_cuda_parts(const compare::Scene& scene,
                                                      const compare::SimulationOptions& options, int parts,
                                                      int list_capacity = 0);

/// Starts worlds on the device (fast/worlds.hpp). Throws as start_cuda does. `list_capacity`: see start_cuda.
std::unique_ptr<Worlds> start_cuda_worlds(std::span<const compare::Scene> scenes,
                                          const compare::SimulationOptions& options, int list_capacity = 0);

/// Makes the engine of a ContactFinder; `topology` must outlive it. Throws as cuda_contestant does. The engine reads
/// device positions on a stream that synchronises with the legacy default stream. The caller's work on a non-blocking
/// stream must be complete before.
std::unique_ptr<ContactEngine> cuda_contact_engine(const compare::Topology& topology,
                                                   const compare::ExclusionView& exclusions);

/// Makes the engine of a Guard. Throws as cuda_contestant does. Its streams are those of a contact engine.
std::unique_ptr<GuardEngine> cuda_guard_engine(const Mesh& mesh, const GuardOptions& options);

/// Makes the engine of a ContactForces. Throws as cuda_contestant does. Its streams are those of a contact engine.
std::unique_ptr<ContactForceEngine> cuda_contact_force_engine(const Mesh& mesh, std::span<const compare::Vec3f> rest,
                                                              const ContactForceOptions& options,
                                                              std::span<const compare::Index> colours);

}  // namespace ogc::fast
