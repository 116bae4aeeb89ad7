// Compiled once for any machine and once for those with AVX2.
#include "fast/cpu/packed_gather.hpp"
#include "fast/cpu/packed_segments.hpp"

namespace ogc::fast {

const PackKernels OGC_FOR_PACKS(pack_kernels){
    {&packed::gather<4, false>, &packed::gather<8, false>, &packed::gather<16, false>, &packed::gather<32, false>},
    {&packed::gather<4, true>, &packed::gather<8, true>, &packed::gather<16, true>, &packed::gather<32, true>},
    {&packed::gather_solids<4>, &packed::gather_solids<8>, &packed::gather_solids<16>, &packed::gather_solids<32>},
    &packed::update_segments};

}  // namespace ogc::fast
