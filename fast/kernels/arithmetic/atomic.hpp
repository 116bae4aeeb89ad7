// Defines atomics: integer sums and maxima, and minima and maxima of non-negative floats. The final values of their
// targets do not depend on the order of execution. The values that atomic_add, atomic_compare_exchange and arrives_last
// return may depend on it. So kernels use these values only to choose the thread that does a piece of work, or a place
// in a list whose order has no effect.
#pragma once

#include <cstdint>

#include "fast/kernels/arithmetic/qualifiers.hpp"

#if !defined(__CUDA_ARCH__)
#include <atomic>
#endif

namespace ogc::fast {

/// Adds the value to the target, and returns the target's value before the addition.
OGC_HD inline int atomic_add(int* target, int value) {
#if defined(__CUDA_ARCH__)
  return atomicAdd(target, value);
#else
  return std::atomic_ref<int>(*target).fetch_add(value, std::memory_order_relaxed);
#endif
}

/// Sets the target to the maximum of target and value.
OGC_HD inline void atomic_max(int* target, int value) {
#if defined(__CUDA_ARCH__)
  atomicMax(target, value);
#else
  std::atomic_ref<int> shared(*target);
  int seen = shared.load(std::memory_order_relaxed);
  while (seen < value && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {}
#endif
}

/// Does the same as atomic_max, but is faster if all threads of a launch use the same target: the active threads of a
/// warp make one access together.
OGC_HD inline void raise_together(int* target, int value) {
#if defined(__CUDA_ARCH__)
  const unsigned here = __activemask();
  const int most = __reduce_max_sync(here, value);
  if (threadIdx.x % 32 == static_cast<unsigned>(__ffs(static_cast<int>(here))) - 1) atomicMax(target, most);
#else
  atomic_max(target, value);
#endif
}

/// Sets the target to the maximum of target and value.
OGC_HD inline void atomic_max(std::uint64_t* target, std::uint64_t value) {
#if defined(__CUDA_ARCH__)
  atomicMax(reinterpret_cast<unsigned long long*>(target), static_cast<unsigned long long>(value));
#else
  std::atomic_ref<std::uint64_t> shared(*target);
  std::uint64_t seen = shared.load(std::memory_order_relaxed);
  while (seen < value && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {}
#endif
}

/// Sets the bits of `value` in the target.
OGC_HD inline void atomic_or(std::uint64_t* target, std::uint64_t value) {
#if defined(__CUDA_ARCH__)
  atomicOr(reinterpret_cast<unsigned long long*>(target), static_cast<unsigned long long>(value));
#else
  std::atomic_ref<std::uint64_t>(*target).fetch_or(value, std::memory_order_relaxed);
#endif
}

/// Writes `value` if the target is `expected`, and returns the target's previous value.
OGC_HD inline std::uint64_t atomic_compare_exchange(std::uint64_t* target, std::uint64_t expected,
                                                    std::uint64_t value) {
#if defined(__CUDA_ARCH__)
  return atomicCAS(reinterpret_cast<unsigned long long*>(target), static_cast<unsigned long long>(expected),
                   static_cast<unsigned long long>(value));
#else
  std::atomic_ref<std::uint64_t>(*target).compare_exchange_strong(expected, value, std::memory_order_relaxed);
  return expected;
#endif
}

/// Adds 1 to a counter, and returns whether this was the last of `count` additions. The counter is 0 before the first
/// addition and after the last one. The thread that gets `true` sees all that other threads wrote before their
/// additions. Only this thread executes an acquire fence, because such a fence empties the first-level cache.
OGC_HD inline bool arrives_last(int* counter, int count) {
#if defined(__CUDA_ARCH__)
  int before;
  asm volatile("atom.add.release.gpu.s32 %0, [%1], 1;" : "=r"(before) : "l"(counter) : "memory");
  if (before != count - 1) return false;
  asm volatile("fence.acq_rel.gpu;" ::: "memory");
  *counter = 0;
#else
  std::atomic_ref<int> shared(*counter);
  if (shared.fetch_add(1, std::memory_order_acq_rel) != count - 1) return false;
  shared.store(0, std::memory_order_relaxed);
#endif
  return true;
}

/// Reads a value that other threads may be writing.
OGC_HD inline std::uint64_t atomic_load(const std::uint64_t* source) {
#if defined(__CUDA_ARCH__)
  return *const_cast<const volatile std::uint64_t*>(source);
#else
  return std::atomic_ref<std::uint64_t>(*const_cast<std::uint64_t*>(source)).load(std::memory_order_relaxed);
#endif
}

/// Reads a value that other threads may be writing.
OGC_HD inline int atomic_load(const int* source) {
#if defined(__CUDA_ARCH__)
  return *const_cast<const volatile int*>(source);
#else
  return std::atomic_ref<int>(*const_cast<int*>(source)).load(std::memory_order_relaxed);
#endif
}

/// Reads a value that other threads may be changing at the same time.
OGC_HD inline float atomic_load(const float* source) {
#if defined(__CUDA_ARCH__)
  return *const_cast<const volatile float*>(source);
#else
  return std::atomic_ref<float>(*const_cast<float*>(source)).load(std::memory_order_relaxed);
#endif
}

/// Sets the target to the minimum of target and value. Neither may be negative or NaN: then the order of their bits as
/// integers is the order of the floats.
OGC_HD inline void atomic_min(float* target, float value) {
#if defined(__CUDA_ARCH__)
  atomicMin(reinterpret_cast<int*>(target), __float_as_int(value));
#else
  std::atomic_ref<float> shared(*target);
  float seen = shared.load(std::memory_order_relaxed);
  while (value < seen && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {}
#endif
}

/// Does the same as atomic_min, but is faster if all threads of a launch use the same target. No value may be negative
/// or NaN.
OGC_HD inline void lower_together(float* target, float value) {
#if defined(__CUDA_ARCH__)
  const unsigned here = __activemask();
  const int least = __reduce_min_sync(here, __float_as_int(value));
  if (threadIdx.x % 32 == static_cast<unsigned>(__ffs(static_cast<int>(here))) - 1)
    atomicMin(reinterpret_cast<int*>(target), least);
#else
  atomic_min(target, value);
#endif
}

/// Sets the target to the maximum of target and value, which must not be negative or NaN. It reads the target first,
/// because most values do not change it.
OGC_HD inline void raise(float* target, float value) {
  if (!(value > atomic_load(target))) return;
#if defined(__CUDA_ARCH__)
  atomicMax(reinterpret_cast<int*>(target), __float_as_int(value));
#else
  std::atomic_ref<float> shared(*target);
  float seen = shared.load(std::memory_order_relaxed);
  while (seen < value && !shared.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {}
#endif
}

/// Does the same as atomic_min, but reads the target first, because most values do not change it.
OGC_HD inline void lower(float* target, float value) {
  if (value < atomic_load(target)) atomic_min(target, value);
}

}  // namespace ogc::fast
