// Shares few large allocations among the many small arrays of worlds: a world has about a hundred arrays, and an
// allocation of its own would cost each of them microseconds and a device's smallest allocation.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <mutex>
#include <vector>

namespace ogc::fast {

/// Divides slabs of `Memory` into blocks. Memory::allocate(bytes), free(pointer) and fill_zero(pointer, bytes) are the
/// slabs' own. Several threads may use a pool.
template <class Memory>
class Pool {
 public:
  /// Returns memory of at least `bytes`, aligned to 256, all zero.
  void* take(std::size_t bytes) {
    const std::scoped_lock lock(mutex_);
    const std::size_t size = rounded(bytes);
    ++live_;
    taken_ += size;
    if (auto& unused = unused_[size]; !unused.empty()) {
      void* block = unused.back();
      unused.pop_back();
      Memory::fill_zero(block, size);
      return block;
    }
    if (size > left_) {
      const std::size_t slab = std::max(size, slab_size);
      slabs_.push_back(Memory::allocate(slab));
      Memory::fill_zero(slabs_.back(), slab);
      next_ = static_cast<std::byte*>(slabs_.back());
      left_ = slab;
    }
    void* block = next_;
    next_ += size;
    left_ -= size;
    return block;
  }
  /// Gives back a block of `bytes`. The slabs are freed when no block is left.
  void give(void* block, std::size_t bytes) noexcept {
    if (block == nullptr) return;
    const std::scoped_lock lock(mutex_);
    const std::size_t size = rounded(bytes);
    taken_ -= size;
    if (--live_ > 0) {
      unused_[size].push_back(block);
      return;
    }
    for (void* slab : slabs_) Memory::free(slab);
    slabs_.clear();
    unused_.clear();
    left_ = 0;
  }
  /// Returns the bytes of all blocks that are taken.
  std::size_t taken() {
    const std::scoped_lock lock(mutex_);
    return taken_;
  }

 private:
  static constexpr std::size_t slab_size = std::size_t{32} << 20;
  static std::size_t rounded(std::size_t bytes) { return (bytes + 255) / 256 * 256; }

  std::mutex mutex_;
  std::vector<void*> slabs_;
  std::map<std::size_t, std::vector<void*>> unused_;  ///< by size
  std::byte* next_ = nullptr;
  std::size_t left_ = 0, live_ = 0, taken_ = 0;
};

}  // namespace ogc::fast
