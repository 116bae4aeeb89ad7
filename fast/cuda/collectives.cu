#include "fast/cuda/collectives.cuh"

#include <algorithm>
#include <cstdint>

#include <cub/block/block_reduce.cuh>
#include <cub/block/block_scan.cuh>
#include <cub/device/device_radix_sort.cuh>

#include "fast/cuda/buffer.cuh"
#include "fast/cuda/check.cuh"
#include "fast/cuda/follow.cuh"

namespace ogc::fast {
namespace {

constexpr std::size_t alignment = 256;  // the alignment of cudaMalloc, which CUB needs
std::size_t aligned(std::size_t bytes) { return (bytes + alignment - 1) / alignment * alignment; }

constexpr int scan_threads = 512, scan_items = 4, scan_tile = scan_threads * scan_items;
/// Largest number of items of a short scan. The last block reads them all in 2 µs, because a multiprocessor reads 64 B
/// a cycle from the second-level cache.
constexpr int longest_short_scan = 1 << 16;

// Runs scans without communication between blocks. Each block adds all that precedes its tile: the items in a short
// scan, otherwise the tiles' sums in `sums`. CUB's scan would take two launches per scan, and neither could begin
// early. The first blocks run the first scan, the others the second.
__global__ void __launch_bounds__(scan_threads)
    scan_tiles(Scan first_scan, int first_blocks, Scan second_scan, const int* sums) {
  follow_launch();
  const bool is_first = static_cast<int>(blockIdx.x) < first_blocks;
  const Scan scan = is_first ? first_scan : second_scan;
  const int* in = scan.in;
  int* out = scan.out;
  const int n = scan.count, block = static_cast<int>(blockIdx.x) - (is_first ? 0 : first_blocks);
  using Sums = unsigned long long;  // high half: sum of the items before the tile; low half: sum of the tile
  using Scan = cub::BlockScan<Sums, scan_threads, cub::BLOCK_SCAN_WARP_SCANS>;
  __shared__ typename Scan::TempStorage memory;
  const int thread = static_cast<int>(threadIdx.x), tile = block * scan_tile, first = tile + thread * scan_items;
  int item[scan_items], own = 0, before = 0;
  for (int k = 0; k < scan_items; ++k) own += item[k] = first + k < n ? in[first + k] : 0;
  if (sums != nullptr) {
    const int* of_tile = sums + (is_first ? 0 : first_blocks);
    for (int i = thread; i < block; i += scan_threads) before += of_tile[i];
  } else {
    const int4* fours = reinterpret_cast<const int4*>(in);
#pragma unroll 8
    for (int i = thread; i < tile / 4; i += scan_threads) {
      const int4 four = fours[i];
      before += (four.x + four.y) + (four.z + four.w);
    }
  }
  __syncwarp();  // threads of a warp may leave the loops above at different times
  Sums upto = 0, total = 0;
  Scan(memory).ExclusiveSum(static_cast<Sums>(static_cast<unsigned>(before)) << 32 | static_cast<unsigned>(own), upto,
                            total);
  int sum = static_cast<int>(total >> 32) + static_cast<int>(upto & 0xffffffffU);
  for (int k = 0; k < scan_items; sum += item[k], ++k) {
    if (first + k <= n) out[first + k] = sum;
  }
}

// Writes the sum of each tile of both scans, in the order of the blocks of scan_tiles.
__global__ void __launch_bounds__(scan_threads)
    add_tiles(Scan first_scan, int first_blocks, Scan second_scan, int* sums) {
  follow_launch();
  const bool is_first = static_cast<int>(blockIdx.x) < first_blocks;
  const int *in = is_first ? first_scan.in : second_scan.in, n = is_first ? first_scan.count : second_scan.count;
  const int block = static_cast<int>(blockIdx.x) - (is_first ? 0 : first_blocks);
  using Reduce = cub::BlockReduce<int, scan_threads>;
  __shared__ typename Reduce::TempStorage memory;
  const int first = block * scan_tile + static_cast<int>(threadIdx.x);
  int own = 0;
  for (int k = 0; k < scan_items; ++k) {
    const int i = first + k * scan_threads;
    if (i < n) own += in[i];
  }
  const int sum = Reduce(memory).Sum(own);
  if (threadIdx.x == 0) sums[blockIdx.x] = sum;
}

bool is_short(const Scan& scan) {
  return scan.count <= longest_short_scan && scan.in != scan.out &&
         reinterpret_cast<std::uintptr_t>(scan.in) % alignof(int4) == 0;
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
  const auto tiles = [](const Scan& scan) { return scan.count / scan_tile + 1; };
  const int first_blocks = tiles(first), blocks = first_blocks + tiles(second);
  int* sums = nullptr;
  if (!is_short(first) || !is_short(second)) {
    sums = static_cast<int*>(scratch.request(sizeof(int) * static_cast<std::size_t>(blocks)));
    launch_kernel(stream, early, add_tiles, blocks, scan_threads, first, first_blocks, second, sums);
    OGC_CUDA_CHECK(cudaGetLastError());
  }
  launch_kernel(stream, early || sums != nullptr, scan_tiles, blocks, scan_threads, first, first_blocks, second,
                static_cast<const int*>(sums));
  OGC_CUDA_CHECK(cudaGetLastError());
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
