// This file is compiled twice: for any machine, and for machines with AVX2.
#include "reference/solvers/kinds/kernels.hpp"

#include "reference/energies/stencils/side_by_side.hpp"

namespace ogc::reference {
inline namespace OGC_LANES {

/// Is true for terms whose energy depends on Σ wᵢ xᵢ alone.
template <class Term>
concept OfWeights = requires(const Term& term, const Triple<double>& apart) {
  term.energy_between(apart);
};

template <class Kind>
constexpr KernelOf<Kind> kernel_of() {
  if constexpr (!requires { typename Kind::Term; })
    return {};
  else if constexpr (OfWeights<typename Kind::Term>)
    return {&SideBySide<ByWeights<Kind::template TermOf>>::differentiate};
  else
    return {&SideBySide<ByDifferences<Kind::template TermOf, corner_count<Kind>>>::differentiate};
}

template <class... Kinds>
constexpr KernelsOf<std::tuple<Kinds...>> kernels_of(const std::tuple<Kinds...>*) {
  return {kernel_of<Kinds>()...};
}

}  // namespace OGC_LANES

constinit const KindKernels OGC_FOR_LANES(kind_kernels) = kernels_of(static_cast<const ElementKinds*>(nullptr));

}  // namespace ogc::reference
