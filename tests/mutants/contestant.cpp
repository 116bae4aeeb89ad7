// Builds the CPU's probes from the code that tests/mutants.py has rewritten.
#include <memory>

#include "fast/cpu/backend.hpp"
#include "fast/probes/probes.hpp"
#include "tests/mutants/contestant.hpp"

namespace ogc::tests {

compare::Contestant mutant_contestant() {
  return fast::probe_contestant("mutant", std::make_shared<fast::CpuBackend>());
}

}  // namespace ogc::tests
