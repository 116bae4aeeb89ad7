// Compiled once for any machine and once for those with AVX2.
#include "fast/cpu/packed_gather.hpp"

namespace ogc::fast {

const PackKernels OGC_FOR_PACKS(pack_kernels){
    {&packed::gather<4>, &packed::gather<8>, &packed::gather<16>, &packed::gather<32>},
    {&packed::gather_solids<4>, &packed::gather_solids<8>, &packed::gather_solids<16>, &packed::gather_solids<32>}};

}  // namespace ogc::fast
