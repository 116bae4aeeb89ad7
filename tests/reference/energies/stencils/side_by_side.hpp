// Compares stencils in batches with single stencils, for the tests of energies and barriers.
#pragma once

#include <vector>

#include "reference/solvers/kinds/kernels.hpp"
#include "tests/catch.hpp"

namespace ogc::tests {

template <std::size_t N>
using Corners = std::array<reference::Triple<double>, N>;

/// Kernels of contacts and of elements for one machine.
struct MachineKernels : reference::StencilKernels, reference::KindKernels {};

inline std::vector<MachineKernels> kernels_of_this_machine() {
  std::vector<MachineKernels> all{{reference::stencil_kernels_baseline, reference::kind_kernels_baseline}};
  if (&reference::stencil_kernels() != &reference::stencil_kernels_baseline)
    all.push_back({reference::stencil_kernels(), reference::kind_kernels()});
  return all;
}

/// Differentiates up to batch_width stencils in one batch.
template <std::size_t Count, class Term>
std::vector<reference::StencilDerivatives> differentiated(
    void (*kernel)(const reference::Batch<Term, Count>&, reference::HessianProjection), const std::vector<Term>& terms,
    const std::vector<Corners<Count>>& corners, reference::HessianProjection projection) {
  std::vector<reference::StencilDerivatives> result(terms.size());
  reference::Batch<Term, Count> batch;
  for (std::size_t i = 0; i < terms.size(); ++i) batch.add(terms[i], corners[i], result[i]);
  kernel(batch, projection);
  return result;
}

/// Returns whether energies, gradients and lower triangles of the Hessians have the same bits; zeros of either sign are
/// equal. The upper triangle of a Hessian is a copy of the lower one in batches, but differs by roundings for single
/// stencils.
inline bool same_bits(const reference::StencilDerivatives& a, const reference::StencilDerivatives& b) {
  bool same = a.energy == b.energy && a.gradient == b.gradient;
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = 0; j <= i; ++j) same = same && a.hessian[12 * i + j] == b.hessian[12 * i + j];
  return same;
}

template <std::size_t Count, class Term, class Alone>
void check_against_alone(void (*kernel)(const reference::Batch<Term, Count>&, reference::HessianProjection),
                         const std::vector<Term>& terms, const std::vector<Corners<Count>>& corners, Alone alone) {
  for (const auto projection : {reference::HessianProjection::none, reference::HessianProjection::clamp,
                                reference::HessianProjection::absolute}) {
    const auto together = differentiated<Count>(kernel, terms, corners, projection);
    for (std::size_t i = 0; i < terms.size(); ++i) {
      INFO("stencil " << i << " of " << Count << " vertices");
      CHECK(same_bits(together[i], alone(terms[i], corners[i], projection)));
      for (std::size_t row = 0; row < 12; ++row)
        for (std::size_t column = 0; column < row; ++column)
          REQUIRE(together[i].hessian[12 * row + column] == together[i].hessian[12 * column + row]);
    }
  }
}

}  // namespace ogc::tests
