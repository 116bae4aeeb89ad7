// Differentiates several barriers at once in the lanes of a register; all must have the same kind of closest features.
// energies/stencils/stencil_kernels.hpp does the same for other stencils.
#pragma once

#include "reference/energies/stencils/stencil_kernels.hpp"
#include "reference/ipc/barrier.hpp"

namespace ogc::reference {

/// A barrier with its shape; κ is part of its weight.
template <class Number>
struct ShapedBarrierOf {
  BarrierTermOf<Number> barrier;
  BarrierShape shape;

  /// Returns the energy at the positions x of the barrier's vertices [J].
  template <class T, std::size_t N>
  T energy(const std::array<Triple<T>, N>& x) const {
    return barrier.energy(shape, x);
  }
  auto numbers() { return barrier.numbers(); }
  auto numbers() const { return barrier.numbers(); }
  auto kinds() { return std::tuple_cat(barrier.kinds(), std::tie(shape.distance, shape.thickness)); }
  auto kinds() const { return std::tuple_cat(barrier.kinds(), std::tie(shape.distance, shape.thickness)); }
};
/// A barrier over doubles.
using ShapedBarrier = ShapedBarrierOf<double>;

/// The kernels of barriers, by their number of vertices.
struct BarrierKernels {
  StencilKernels::Function<ShapedBarrier, 2> of_2;
  StencilKernels::Function<ShapedBarrier, 3> of_3;
  StencilKernels::Function<ShapedBarrier, 4> of_4;
};

/// Kernels for any machine, and for machines with AVX2.
extern const BarrierKernels barrier_kernels_baseline, barrier_kernels_avx2;

}  // namespace ogc::reference
