// Defines qualifiers that let g++ and nvcc compile the same kernels.
#pragma once

#if defined(__CUDACC__)
#define OGC_HD __host__ __device__
#else
#define OGC_HD
#endif

/// Marks a function that is never inlined.
#define OGC_OUT_OF_LINE __attribute__((noinline))

namespace ogc::fast {

/// Returns f() without inlining it, so that rare code costs no registers and no instruction cache where frequent code
/// runs. `f` is passed by value: a reference would force the variables that f reads into memory.
template <class F>
OGC_HD OGC_OUT_OF_LINE auto called(F f) {
  return f();
}

}  // namespace ogc::fast
