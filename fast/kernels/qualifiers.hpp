// Kernels are mathematics in plain headers: g++ and nvcc compile the same lines.
#pragma once

#if defined(__CUDACC__)
#define OGC_HD __host__ __device__
#else
#define OGC_HD
#endif

/// A function that is called and not inlined.
#define OGC_OUT_OF_LINE __attribute__((noinline))
