// The CUDA side as the rest of `fast` sees it: plain C++, no CUDA header, so that g++ compiles the callers.
#pragma once

#include <memory>
#include <span>

#include "compare/contestant.hpp"
#include "fast/contact_sets.hpp"
#include "fast/contestant.hpp"

namespace ogc::fast {

/// Whether a device can run this build; where not, the description says why and what to do.
BackendInfo cuda_info();

/// All stages on the device. Throws compare::ResourceError where cuda_info() says that it can't be used.
compare::Contestant cuda_contestant(const LaunchShape& shape = {});

/// A resident simulation on the device. Throws compare::ResourceError as cuda_contestant, and where the scene does not
/// fit into the device's memory. `list_capacity`: contacts that fit at first; 0 for a guess by mesh size.
std::unique_ptr<compare::Simulation> start_cuda(const compare::Scene& scene, const compare::SimulationOptions& options,
                                                int list_capacity = 0);

/// For ContactFinder; `topology` must outlive the engine. Throws as cuda_contestant. Device positions handed to it are
/// read on a stream that the legacy default stream waits for and is waited for by; work on a non-blocking stream of the
/// caller must be complete.
std::unique_ptr<ContactEngine> cuda_contact_engine(const compare::Topology& topology,
                                                   const compare::ExclusionView& exclusions);

}  // namespace ogc::fast
