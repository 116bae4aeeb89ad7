// This file is compiled twice: for any machine and for machines with AVX2.
#include "reference/ipc/barrier_kernels.hpp"

#include "reference/energies/stencils/side_by_side.hpp"

namespace ogc::reference {

const BarrierKernels OGC_FOR_LANES(barrier_kernels){&SideBySide<ByDifferences<ShapedBarrierOf, 2>>::differentiate,
                                                    &SideBySide<ByDifferences<ShapedBarrierOf, 3>>::differentiate,
                                                    &SideBySide<ByDifferences<ShapedBarrierOf, 4>>::differentiate};

}  // namespace ogc::reference
