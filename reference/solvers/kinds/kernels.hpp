// Declares the kernels with which Newton's method differentiates elements. A kernel differentiates several elements of
// one kind side by side (energies/stencils/stencil_kernels.hpp).
#pragma once

#include "reference/energies/stencils/stencil_kernels.hpp"
#include "reference/solvers/kinds/kinds.hpp"

namespace ogc::reference {

/// Holds the kernel of a kind, compiled for one machine. It is empty for a kind whose list computes its own
/// derivatives.
template <class Kind>
struct KernelOf {};
template <class Kind>
requires requires { typename Kind::Term; }
struct KernelOf<Kind> {
  StencilKernels::Function<typename Kind::Term, corner_count<Kind>> kernel;  ///< differentiates a batch
};

/// The kernels of some kinds.
template <class Kinds>
struct KernelsOf;
template <class... Kinds>
struct KernelsOf<std::tuple<Kinds...>> : KernelOf<Kinds>... {
  /// Returns the kernel of a kind.
  template <class Kind>
  auto of() const {
    return static_cast<const KernelOf<Kind>&>(*this).kernel;
  }
};
/// The kernels of all kinds in ElementKinds.
using KindKernels = KernelsOf<ElementKinds>;

/// The kernels for any machine, and for a machine with AVX2.
extern const KindKernels kind_kernels_baseline, kind_kernels_avx2;

/// Returns the kernels for this machine.
inline const KindKernels& kind_kernels() {
#ifdef __x86_64__
  if (has_avx2()) return kind_kernels_avx2;
#endif
  return kind_kernels_baseline;
}

template <class Kind>
void differentiate_batch(const Batch<typename Kind::Term, corner_count<Kind>>& batch, HessianProjection projection) {
  kind_kernels().of<Kind>()(batch, projection);
}

}  // namespace ogc::reference
