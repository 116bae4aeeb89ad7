// Declares scan and sort as two plain functions, so that CUB is compiled once. Both are deterministic, because they use
// integers only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <cuda_runtime.h>

#include "fast/stages/backend.hpp"

namespace ogc::fast {

/// Holds the temporary memory of a backend's collectives. A request larger than all before adds a block. Old blocks
/// stay until the backend ends, because work that is enqueued or recorded uses them. Blocks grow by at least half, so
/// all blocks together are at most three times the last one.
class Scratch {
 public:
  Scratch() = default;
  Scratch(Scratch&& other) noexcept
      : blocks_(std::exchange(other.blocks_, {})), largest_(std::exchange(other.largest_, 0)) {}
  Scratch& operator=(Scratch&&) = delete;
  ~Scratch();
  /// Returns at least `bytes` bytes, aligned to 256, valid until the next request; work of one stream runs in order.
  /// Allowed while a graph is recorded.
  void* request(std::size_t bytes);

 private:
  std::vector<void*> blocks_;
  std::size_t largest_ = 0;
};

/// Runs two scans in one launch if both are short, else in two. Neither scan may read what the other writes. `early`:
/// see launch_kernel.
void exclusive_scans(cudaStream_t stream, Scratch& scratch, bool early, const Scan& first, const Scan& second);

/// Sorts keys and values in place by the given bits of the keys: stable, ascending.
void sort_pairs(cudaStream_t stream, Scratch& scratch, std::uint64_t* keys, int* values, int n, KeyBits bits);

}  // namespace ogc::fast
