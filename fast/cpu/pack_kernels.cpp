#include "fast/cpu/pack_kernels.hpp"

#include "fast/cpu/packed_contact.hpp"

namespace ogc::fast {

bool has_avx2() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx2");
#else
  return false;
#endif
}

const PackKernels& pack_kernels() {
#ifdef __x86_64__
  static const PackKernels& best = has_avx2() ? pack_kernels_avx2 : pack_kernels_baseline;
  return best;
#else
  return pack_kernels_baseline;
#endif
}

ContactWeights weights_of_one(ContactKind kind, const Vec* x) { return contact_weights(kind, x); }

}  // namespace ogc::fast
