// This file is compiled twice: for any machine, and for machines with AVX2.
#include "reference/energies/stencils/stencil_kernels.hpp"

#include "reference/energies/stencils/side_by_side.hpp"

namespace ogc::reference {

const StencilKernels OGC_FOR_LANES(stencil_kernels){&SideBySide<ByDifferences<PlacedContactOf, 2>>::differentiate,
                                                    &SideBySide<ByDifferences<PlacedContactOf, 3>>::differentiate,
                                                    &SideBySide<ByDifferences<PlacedContactOf, 4>>::differentiate,
                                                    &SideBySide<ByWeights<PlacedContactOf>>::differentiate,
                                                    &SideBySide<ByWeights<FrictionTermOf>>::differentiate};

}  // namespace ogc::reference
