// Counts the memory of a world on the host: a device needs the same arrays.
#include "fast/stages/update_vertices.hpp"
#include "fast/worlds.hpp"
#include "fast/worlds/host.hpp"
#include "fast/worlds/resident.hpp"

namespace ogc::fast {

std::size_t world_bytes(const compare::Scene& scene) {
  auto& pool = pool_of<HostMemory>();
  const std::size_t before = pool.taken();
  WorldSimulation<HostPlace> world(WorldBackend<HostPlace>{}, scene, {}, "1 thread");
  world.begin_frame(1);  // records a program
  return pool.taken() - before;
}

}  // namespace ogc::fast
