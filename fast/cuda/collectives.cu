#include "fast/cuda/collectives.cuh"

#include <algorithm>
#include <cstdint>

#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/transform_iterator.h>
#include <cub/block/block_scan.cuh>
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>

#include "fast/cuda/buffer.cuh"
#include "fast/cuda/check.cuh"
#include "fast/cuda/follow.cuh"

namespace ogc::fast {
namespace {

constexpr std::size_t alignment = 256;  // of cudaMalloc, and what CUB asks for
std::size_t aligned(std::size_t bytes) { return (bytes + alignment - 1) / alignment * alignment; }

// The caller's items and one zero after them: its exclusive prefix is the total.
struct PaddedItems {
  const int* items;
  int count;
  __device__ int operator()(int i) const { return i < count ? items[i] : 0; }
};

constexpr int scan_threads = 512, scan_items = 4, scan_tile = scan_threads * scan_items;
/// The last block of a short scan reads them all: 2 µs of what a multiprocessor gets from the second-level cache (64 B
/// a cycle).
constexpr int longest_short_scan = 1 << 16;

// A scan in one launch without a memory of its own: each block adds up all that stands before its tile. CUB's takes two
// launches, and a detection has two scans. The first blocks scan the one, the others the other.
__global__ void __launch_bounds__(scan_threads) scan_short(Scan first_scan, int first_blocks, Scan second_scan) {
  follow_launch();
  const bool is_first = static_cast<int>(blockIdx.x) < first_blocks;
  const Scan scan = is_first ? first_scan : second_scan;
  const int* in = scan.in;
  int* out = scan.out;
  const int n = scan.count, block = static_cast<int>(blockIdx.x) - (is_first ? 0 : first_blocks);
  using Sums = unsigned long long;  // of what stands before the tile, above; of the tile, in the low half
  using Scan = cub::BlockScan<Sums, scan_threads, cub::BLOCK_SCAN_WARP_SCANS>;
  __shared__ typename Scan::TempStorage memory;
  const int thread = static_cast<int>(threadIdx.x), tile = block * scan_tile, first = tile + thread * scan_items;
  int item[scan_items], own = 0, before = 0;
  for (int k = 0; k < scan_items; ++k) own += item[k] = first + k < n ? in[first + k] : 0;
  const int4* fours = reinterpret_cast<const int4*>(in);
#pragma unroll 8
  for (int i = thread; i < tile / 4; i += scan_threads) {
    const int4 four = fours[i];
    before += (four.x + four.y) + (four.z + four.w);
  }
  Sums upto = 0, total = 0;
  Scan(memory).ExclusiveSum(static_cast<Sums>(static_cast<unsigned>(before)) << 32 | static_cast<unsigned>(own), upto,
                            total);
  int sum = static_cast<int>(total >> 32) + static_cast<int>(upto & 0xffffffffU);
  for (int k = 0; k < scan_items; sum += item[k], ++k) {
    if (first + k <= n) out[first + k] = sum;
  }
}

bool is_short(const Scan& scan) {
  return scan.count <= longest_short_scan && scan.in != scan.out &&
         reinterpret_cast<std::uintptr_t>(scan.in) % alignof(int4) == 0;
}

// A count of −1: none.
void launch_short(cudaStream_t stream, bool early, const Scan& first, const Scan& second) {
  const auto blocks = [](const Scan& scan) { return scan.count < 0 ? 0 : scan.count / scan_tile + 1; };
  launch_kernel(stream, early, scan_short, blocks(first) + blocks(second), scan_threads, first, blocks(first), second);
  OGC_CUDA_CHECK(cudaGetLastError());
}

void exclusive_scan(cudaStream_t stream, Scratch& scratch, bool early, const Scan& scan) {
  if (is_short(scan)) return launch_short(stream, early, scan, {nullptr, nullptr, -1});
  const auto padded = thrust::make_transform_iterator(thrust::counting_iterator<int>(0),
                                                      PaddedItems{scan.in, scan.count});
  std::size_t bytes = 0;
  OGC_CUDA_CHECK(cub::DeviceScan::ExclusiveSum(nullptr, bytes, padded, scan.out, scan.count + 1, stream));
  void* temporary = scratch.request(std::max<std::size_t>(bytes, 1));
  OGC_CUDA_CHECK(cub::DeviceScan::ExclusiveSum(temporary, bytes, padded, scan.out, scan.count + 1, stream));
}

}  // namespace

Scratch::~Scratch() {
  for (void* block : blocks_) device_free(block);
}

void* Scratch::request(std::size_t bytes) {
  if (bytes > largest_) {
    const std::size_t size = aligned(std::max(bytes, largest_ + largest_ / 2));
    blocks_.push_back(device_allocate(size));
    largest_ = size;
  }
  return blocks_.empty() ? nullptr : blocks_.back();
}

void exclusive_scans(cudaStream_t stream, Scratch& scratch, bool early, const Scan& first, const Scan& second) {
  if (is_short(first) && is_short(second)) return launch_short(stream, early, first, second);
  exclusive_scan(stream, scratch, early, first);
  exclusive_scan(stream, scratch, true, second);
}

void sort_pairs(cudaStream_t stream, Scratch& scratch, std::uint64_t* keys, int* values, int n, KeyBits bits) {
  if (n < 2) return;
  const auto count = static_cast<std::size_t>(n);
  const std::size_t key_bytes = aligned(count * sizeof(std::uint64_t)), value_bytes = aligned(count * sizeof(int));
  cub::DoubleBuffer<std::uint64_t> both_keys(keys, nullptr);
  cub::DoubleBuffer<int> both_values(values, nullptr);
  std::size_t bytes = 0;
  OGC_CUDA_CHECK(
      cub::DeviceRadixSort::SortPairs(nullptr, bytes, both_keys, both_values, n, bits.begin, bits.end, stream));
  char* temporary = static_cast<char*>(scratch.request(key_bytes + value_bytes + std::max<std::size_t>(bytes, 1)));
  both_keys.d_buffers[1] = reinterpret_cast<std::uint64_t*>(temporary);
  both_values.d_buffers[1] = reinterpret_cast<int*>(temporary + key_bytes);
  OGC_CUDA_CHECK(cub::DeviceRadixSort::SortPairs(temporary + key_bytes + value_bytes, bytes, both_keys, both_values, n,
                                                 bits.begin, bits.end, stream));
  if (both_keys.Current() != keys) {
    OGC_CUDA_CHECK(
        cudaMemcpyAsync(keys, both_keys.Current(), count * sizeof(std::uint64_t), cudaMemcpyDeviceToDevice, stream));
  }
  if (both_values.Current() != values) {
    OGC_CUDA_CHECK(
        cudaMemcpyAsync(values, both_values.Current(), count * sizeof(int), cudaMemcpyDeviceToDevice, stream));
  }
}

}  // namespace ogc::fast
