// Searches trees with whole warps. One thread per search would leave a device idle: a mesh of 5,000 vertices has too
// few searches to hide the latency of the chain node → child → primitive → arithmetic, and the longest of 32 searches
// delays the others. So a warp takes a few searches and keeps their pending items in three lists in shared memory. In
// each round every lane takes one item, of any of these searches:
//
//   nodes       nodes to open: four lanes open one node, one child each
//   candidates  primitives offered by leaves: a lane calls is_pair
//   pairs       candidates that passed: a lane computes the distance (meet), which may lower the search's limit
//
// The warp takes the last list that can fill it, so lanes idle only when little is left. `nodes` is a stack. A round
// takes up to 8 nodes from the top, where the lowest level is, and pushes at most 32 children. The stack then has no
// other nodes of the children's level, so room for 32 nodes per level suffices.
#pragma once

#include <algorithm>

#include <cuda_runtime.h>

#include "fast/cuda/follow.cuh"
#include "fast/kernels/search.hpp"

namespace ogc::fast {

inline constexpr int search_warps = 4;   ///< largest number of warps of a block
inline constexpr int largest_group = 8;  ///< largest number of searches of a warp

/// Largest number of primitives of a tree, because numbers of leaf nodes have 25 bits.
inline constexpr int largest_searched_count = 4 << 25;

/// A node of the stack, with its search.
struct SearchNode {
  /// bits from high to low: 4 for the level, 3 for the search's index in its group, 25 for the node's index in its
  /// level
  unsigned bits;

  /// Packs the level (below max_levels), the search's index in its group (`slot`), and the node's index in its level
  /// (`j` < 2²⁵). The functions below unpack them.
  __device__ static SearchNode of(int level, int slot, int j) {
    return {static_cast<unsigned>(level) << 28 | static_cast<unsigned>(slot) << 25 | static_cast<unsigned>(j)};
  }
  __device__ int level() const { return static_cast<int>(bits >> 28); }
  __device__ int slot() const { return static_cast<int>(bits >> 25 & 7U); }
  __device__ int place() const { return static_cast<int>(bits & 0x1ffffffU); }
};

/// A primitive that a leaf offered to a search of the group.
struct alignas(16) SearchItem {
  int slot;  ///< index of the search in its group
  Offer offer;
};

/// Holds the pending items of one warp.
struct SearchMemory {
  /// `candidates` and `pairs`: a round adds at most 32 items to a list, and only if the list has at most 31. `nodes`:
  /// one node for each search, and at most 32 of each level.
  static constexpr int most_items = 31 + 32, most_nodes = largest_group + 32 * (max_levels - 1);
  Search searches[largest_group];  ///< by number in the group
  /// two stacks; is_pair moves items from `candidates` to `pairs`
  SearchItem candidates[most_items], pairs[most_items];
  SearchNode nodes[most_nodes];
};

/// Runs the searches of one warp. Its 32 threads call `run` together.
template <class Query>
class WarpSearch {
 public:
  __device__ WarpSearch(const Searches<Query>& searches, SearchMemory& memory)
      : searches_(searches),
        tree_(searches.tree),
        query_(searches.query),
        memory_(at_hand(memory)),
        lane_(at_hand(threadIdx.x % 32)) {}

  /// Runs the searches first, first + stride, …, `count` of them.
  __device__ void run(int first, int stride, int count) {
    const int lane = static_cast<int>(lane_);
    if (lane < count) {
      memory_.searches[lane] = searches_.begin(first + lane * stride);
      memory_.nodes[lane] = SearchNode::of(tree_.levels - 1, lane, 0);
    }
    node_count_ = static_cast<unsigned>(count);
    __syncwarp();
    while (node_count_ + candidate_count_ + pair_count_ > 0) {
      if (pair_count_ >= 32 || node_count_ + candidate_count_ == 0) {
        meet();
      } else if (candidate_count_ >= 32 || node_count_ == 0) {
        sift();
      } else {
        open();
      }
      __syncwarp();
    }
  }

 private:
  static constexpr unsigned everyone_ = 0xffffffffU;

  /// Returns the number and keeps it in a register. Otherwise the compiler would recompute addresses in shared memory
  /// and reread thread numbers at each use.
  __device__ static unsigned at_hand(unsigned number) {
    asm volatile("" : "+r"(number));
    return number;
  }
  __device__ static SearchMemory& at_hand(SearchMemory& memory) {
    return *static_cast<SearchMemory*>(
        __cvta_shared_to_generic(at_hand(static_cast<unsigned>(__cvta_generic_to_shared(&memory)))));
  }

  __device__ unsigned before() const { return (1U << lane_) - 1; }

  __device__ void meet() {
    const unsigned take = min(32U, pair_count_);
    pair_count_ -= take;
    if (lane_ >= take) return;
    const SearchItem pair = memory_.pairs[pair_count_ + lane_];
    Search& search = memory_.searches[pair.slot];
    const float limit = query_.meet(search, pair.offer.primitive, pair.offer.gap);
    if (limit < search.limit) atomicMin(reinterpret_cast<int*>(&search.limit), __float_as_int(limit));
  }

  __device__ void sift() {
    const unsigned take = min(32U, candidate_count_);
    candidate_count_ -= take;
    SearchItem item{};
    bool keep = false;
    if (lane_ < take) {
      item = memory_.candidates[candidate_count_ + lane_];
      keep = query_.is_pair(memory_.searches[item.slot], item.offer);
    }
    const unsigned kept = __ballot_sync(everyone_, keep);
    if (keep) memory_.pairs[pair_count_ + __popc(kept & before())] = item;
    pair_count_ += __popc(kept);
  }

  /// Opens nodes. This is the innermost loop of a detection. It has no branches, and no signed numbers, which would
  /// cost divisions by 4 and longer addresses.
  __device__ void open() {
    const unsigned take = min(8U, node_count_), own = lane_ / 4, number = lane_ % 4;
    node_count_ -= take;
    // lanes beyond the last node read the last node and drop the result
    const SearchNode node = memory_.nodes[node_count_ + min(own, take - 1)];
    const int level = node.level(), slot = node.slot(), j = 4 * node.place() + static_cast<int>(number);
    const Search& search = memory_.searches[slot];
    const Child child = tree_.nodes[static_cast<unsigned>(tree_.start[level] + node.place())].child[number];
    const float gap = squared_gap(child.box(), search.box);
    const bool is_leaf = level == 0,
               is_near = (own < take) & (gap <= larger(search.limit, child.reach)) & (j >= search.from >> (2 * level));
    const unsigned near = __ballot_sync(everyone_, is_near), leaves = __ballot_sync(everyone_, is_leaf);
    const unsigned rank = __popc(near & (is_leaf ? leaves : ~leaves) & before());
    __syncwarp();
    if (is_near & is_leaf) memory_.candidates[candidate_count_ + rank] = {slot, {child.primitive, gap, child.reach}};
    if (is_near & !is_leaf) memory_.nodes[node_count_ + rank] = SearchNode::of(level - 1, slot, j);
    candidate_count_ += __popc(near & leaves);
    node_count_ += __popc(near & ~leaves);
  }

  const Searches<Query>& searches_;
  const TreeView& tree_;
  const Query& query_;
  SearchMemory& memory_;
  const unsigned lane_;
  unsigned node_count_ = 0, candidate_count_ = 0, pair_count_ = 0;
};

/// Divides the searches of one kind among warps, up to `group` per warp. A warp takes every `warps`-th search, because
/// long searches are neighbours: a warp with all of them would delay the launch.
struct SearchGroups {
  int group, warps;  ///< largest number of searches of a warp; number of warps that have any

  SearchGroups(int count, int searches) : group(searches), warps((count + searches - 1) / searches) {}
  /// Returns the number of blocks of `block_warps` warps each.
  int blocks(int block_warps) const { return (warps + block_warps - 1) / block_warps; }
};

/// Runs the searches of one kind that belong to warp number `warp`. Runs none if `warp` ≥ groups.warps, or if the query
/// is off.
template <class Query>
__device__ void run_group(const Searches<Query>& searches, const SearchGroups& groups, int warp, SearchMemory& memory) {
  if (warp >= groups.warps || searches.query.is_off()) return;
  WarpSearch<Query>(searches, memory)
      .run(warp, groups.warps, min(groups.group, (searches.count - warp + groups.warps - 1) / groups.warps));
}

/// Runs both kinds of searches, the first kind in the first blocks. A block has at most search_warps warps.
template <class First, class Second>
__global__ void __launch_bounds__(32 * search_warps, 8)
    run_searches(Searches<First> first, SearchGroups first_groups, int first_blocks, Searches<Second> second,
                 SearchGroups second_groups) {
  follow_launch();
  __shared__ SearchMemory memory[search_warps];
  const int warps = static_cast<int>(blockDim.x) / 32, warp = static_cast<int>(threadIdx.x) / 32,
            block = static_cast<int>(blockIdx.x);
  if (block < first_blocks) {
    run_group(first, first_groups, block * warps + warp, memory[warp]);
  } else {
    run_group(second, second_groups, (block - first_blocks) * warps + warp, memory[warp]);
  }
}

}  // namespace ogc::fast
