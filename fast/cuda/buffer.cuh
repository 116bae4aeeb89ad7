// Holds resident arrays on the device in plain cudaMalloc memory, never managed memory. Copies use the legacy default
// stream. This stream and a backend's (blocking) stream wait for each other, so a copy sees all work enqueued before
// it. The runtime refuses these copies inside a capture, so they are made outside a step.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <cuda_runtime.h>

#include "fast/cuda/check.cuh"

namespace ogc::fast {

/// Allocates bytes on the device without initialising them; allowed while a graph is recorded. Throws
/// compare::ResourceError with the requested size, the free size and a remedy.
void* device_allocate(std::size_t bytes);
/// Frees memory; does nothing for null.
void device_free(void* memory) noexcept;

/// Counts allocations that moved. A recorded graph holds raw pointers, so it is stale after this number has changed.
inline std::atomic<std::uint64_t> buffer_generation{0};

/// A resident array on the device; it can be moved, not copied.
template <class T>
class CudaBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  CudaBuffer() = default;
  CudaBuffer(CudaBuffer&& other) noexcept { swap(other); }
  CudaBuffer& operator=(CudaBuffer&& other) noexcept {
    swap(other);
    return *this;
  }
  ~CudaBuffer() { device_free(items_); }

  /// Returns the items on the device, size() of them; null before the first allocation.
  T* data() { return items_; }
  const T* data() const { return items_; }
  std::size_t size() const { return size_; }

  /// Resizes without keeping content; the allocation never shrinks. A new allocation is zero, as on the host.
  void resize(std::size_t n) {
    if (n > capacity_) {
      device_free(std::exchange(items_, nullptr));
      capacity_ = 0;
      ++buffer_generation;
      items_ = static_cast<T*>(device_allocate(n * sizeof(T)));
      capacity_ = n;
      OGC_CUDA_CHECK(cudaMemset(items_, 0, n * sizeof(T)));
    }
    size_ = n;
  }
  /// Resizes to n and copies.
  void upload(const T* from, std::size_t n) {
    resize(n);
    if (n > 0) OGC_CUDA_CHECK(cudaMemcpy(items_, from, n * sizeof(T), cudaMemcpyHostToDevice));
  }
  void download(T* to, std::size_t n) const {
    if (n > 0) OGC_CUDA_CHECK(cudaMemcpy(to, items_, n * sizeof(T), cudaMemcpyDeviceToHost));
  }
  /// Sets all bytes to zero.
  void fill_zero() {
    if (size_ > 0) OGC_CUDA_CHECK(cudaMemset(items_, 0, size_ * sizeof(T)));
  }

 private:
  void swap(CudaBuffer& other) noexcept {
    std::swap(items_, other.items_);
    std::swap(size_, other.size_);
    std::swap(capacity_, other.capacity_);
  }
  T* items_ = nullptr;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace ogc::fast
