// Kernels are mathematics in plain headers: g++ and nvcc compile the same lines.
#pragma once

#if defined(__CUDACC__)
#define OGC_HD __host__ __device__
#else
#define OGC_HD
#endif

/// A function that is called and not inlined.
#define OGC_OUT_OF_LINE __attribute__((noinline))

namespace ogc::fast {

/// f(), called and not inlined: what is seldom run takes neither registers nor room in the instruction cache from what
/// always is. By value: a reference would force what `f` reads into memory.
template <class F>
OGC_HD OGC_OUT_OF_LINE auto called(F f) {
  return f();
}

}  // namespace ogc::fast
