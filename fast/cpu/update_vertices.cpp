// Instantiates the updates of vertices for the host's threads.
#include "fast/stages/update_vertices.hpp"

#include "fast/cpu/backend.hpp"

namespace ogc::fast {

static_assert(HostSums::count == 1);
template void update_vertices(CpuBackend& backend, int lanes, Teams teams, const UpdateVertex<HostSums::At<0>>& kernel,
                              Start start);
template void measure_vertices(CpuBackend& backend, int slots, const MeasureVertex<GatherAll>& kernel);

}  // namespace ogc::fast
