// Instantiates updates of vertices on a device with the sum number OGC_SUM of DeviceSums. It is compiled once for each
// sum (CMakeLists.txt).
#include "fast/stages/update_vertices.hpp"

#include "fast/cuda/backend.cuh"

namespace ogc::fast {

static_assert(DeviceSums::count == OGC_SUMS, "CMakeLists.txt has OGC_SUMS: the number of DeviceSums");
template void update_vertices(CudaBackend& backend, int lanes, Teams teams,
                              const UpdateVertex<DeviceSums::At<OGC_SUM>>& kernel, Start start);
#if OGC_SUM + 1 == OGC_SUMS
template void measure_vertices(CudaBackend& backend, int slots, const MeasureVertex<GatherAll>& kernel);
#endif

}  // namespace ogc::fast
