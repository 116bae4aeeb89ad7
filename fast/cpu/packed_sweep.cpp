// This file is compiled twice: for any machine, and for machines with AVX2.
#include "fast/cpu/packed_gather.hpp"
#include "fast/cpu/packed_segments.hpp"

namespace ogc::fast {

const PackKernels OGC_FOR_PACKS(pack_kernels){&packed::gather_all<4>, &packed::gather_all<8>, &packed::gather_all<16>,
                                              &packed::update_segments};

}  // namespace ogc::fast
