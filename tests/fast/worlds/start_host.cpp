#include "tests/fast/worlds/start_host.hpp"

#include "fast/stages/update_vertices.hpp"
#include "fast/worlds/host.hpp"
#include "fast/worlds/resident.hpp"

namespace ogc::fast::test {

std::unique_ptr<Worlds> start_host_worlds(std::span<const compare::Scene> scenes,
                                          const compare::SimulationOptions& options, int list_capacity) {
  return std::make_unique<ResidentWorlds<HostPlace>>(scenes, options, "1 thread", list_capacity);
}

}  // namespace ogc::fast::test
