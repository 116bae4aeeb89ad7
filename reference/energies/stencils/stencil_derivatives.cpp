#include "reference/energies/stencils/stencil_derivatives.hpp"

#include <stdexcept>

#include "reference/energies/stencils/projection.hpp"
#include "reference/energies/stencils/stencil_kernels.hpp"

namespace ogc::reference {
namespace {

/// Projects one matrix, copied into all lanes, by the code that batches use.
template <std::size_t N>
void project_sized(double* matrix, bool absolute) {
  LowerTriangle<N, Lanes<1>> h;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j <= i; ++j) h[lower(i, j)] = Lanes<1>(matrix[i * N + j]);
  project<N, 1>(h, absolute);
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j) matrix[i * N + j] = h[lower(i, j)].part[0][0];
}

}  // namespace

void project(double* matrix, std::size_t size, HessianProjection projection) {
  if (projection == HessianProjection::none) return;
  const bool absolute = projection == HessianProjection::absolute;
  switch (size) {
    case 3: return project_sized<3>(matrix, absolute);
    case 6: return project_sized<6>(matrix, absolute);
    case 9: return project_sized<9>(matrix, absolute);
    default: throw std::invalid_argument("project: a stencil has 2, 3 or 4 vertices");
  }
}

bool has_avx2() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

const StencilKernels& stencil_kernels() {
#ifdef __x86_64__
  if (has_avx2()) return stencil_kernels_avx2;
#endif
  return stencil_kernels_baseline;
}

}  // namespace ogc::reference
