// The CPU side as the rest of `fast` sees it.
#pragma once

#include <memory>
#include <span>

#include "compare/contestant.hpp"
#include "fast/contact_sets.hpp"
#include "fast/contestant.hpp"

namespace ogc::fast {

/// The number of threads.
BackendInfo cpu_info();

/// All stages on the host's threads.
compare::Contestant cpu_contestant();

/// For ContactFinder; `topology` must outlive the engine.
std::unique_ptr<ContactEngine> cpu_contact_engine(const compare::Topology& topology,
                                                  const compare::ExclusionView& exclusions);

}  // namespace ogc::fast
