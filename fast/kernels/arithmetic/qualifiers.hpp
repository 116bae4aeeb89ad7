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

/// Returns f() without inlining it, so that rare code takes neither registers nor instruction cache from code that
/// always runs. `f` is passed by value: a reference would force what it reads into memory.
template <class F>
OGC_HD OGC_OUT_OF_LINE auto called(F f) {
  return f();
}

}  // namespace ogc::fast
