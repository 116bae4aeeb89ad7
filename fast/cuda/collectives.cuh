// Offers scan and sort as two plain functions, so that CUB is compiled once. Both are deterministic: integers only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <cuda_runtime.h>

#include "fast/stages/backend.hpp"

namespace ogc::fast {

/// Holds the temporary memory of a backend's collectives. A request that is larger than any before adds a block and
/// keeps the old ones until the backend ends: work already enqueued or recorded goes on using them. Blocks grow by half
/// at least, so all of them together are at most three times the last.
class Scratch {
 public:
  Scratch() = default;
  Scratch(Scratch&& other) noexcept
      : blocks_(std::exchange(other.blocks_, {})), largest_(std::exchange(other.largest_, 0)) {}
  Scratch& operator=(Scratch&&) = delete;
  ~Scratch();
  /// Returns at least `bytes` bytes, aligned to 256, valid until the next call: the calls of one stream take turns.
  /// Legal while a graph is being recorded.
  void* request(std::size_t bytes);

 private:
  std::vector<void*> blocks_;
  std::size_t largest_ = 0;
};

/// Runs two scans, neither of which reads what the other writes: one launch if both are short, else two. `early`: see
/// launch_kernel.
void exclusive_scans(cudaStream_t stream, Scratch& scratch, bool early, const Scan& first, const Scan& second);

/// Sorts in place, stable, ascending by these bits of the keys.
void sort_pairs(cudaStream_t stream, Scratch& scratch, std::uint64_t* keys, int* values, int n, KeyBits bits);

}  // namespace ogc::fast
