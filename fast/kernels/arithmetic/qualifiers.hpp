// Defines the qualifiers of kernels, which are mathematics in plain headers: g++ and nvcc compile the same lines.
#pragma once

#if defined(__CUDACC__)
#define OGC_HD __host__ __device__
#else
#define OGC_HD
#endif

/// Marks a function that is called and not inlined.
#define OGC_OUT_OF_LINE __attribute__((noinline))

namespace ogc::fast {

/// Returns f(), called and not inlined: code that seldom runs takes neither registers nor room in the instruction cache
/// from code that always does. `f` is passed by value: a reference would force what it reads into memory.
template <class F>
OGC_HD OGC_OUT_OF_LINE auto called(F f) {
  return f();
}

}  // namespace ogc::fast
