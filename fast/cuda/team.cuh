// A team of W neighbouring lanes of a warp, with the bits of SerialTeam<W>. Item k goes to lane k mod W in the order of k, as there. The tree is a
// butterfly: at distance s every lane adds its partner l xor s. By induction all lanes l with the same l mod s hold the same bits after that round: the
// two partners add the same two numbers, in opposite order, and IEEE addition is commutative. Lane l < s adds lanes[l] + lanes[l + s], which is
// SerialTeam's tree, so every lane ends with SerialTeam's total. No product feeds these additions (a shuffle stands between), so contraction cannot
// change them either.
//
// The mask of a shuffle names the team's own lanes and no others: teams of one warp may take different branches or leave early.
#pragma once

#include <cstring>
#include <type_traits>

#include "fast/kernels/qualifiers.hpp"

namespace ogc::fast {

template <int W>
struct LaneTeam {
  static_assert(W >= 1 && W <= 32 && (W & (W - 1)) == 0, "W is a power of two, at most 32");
  static constexpr int width = W;

  /// As SerialTeam::sum; every lane of the team must call it, and gets the total.
  template <class Accumulator, class Item>
  __device__ Accumulator sum(int count, Item item) const {
    Accumulator total{};
    for (int k = lane(); k < count; k += W) item(k, total);
#pragma unroll
    for (int s = W / 2; s > 0; s /= 2) total += from_partner(total, s);
    return total;
  }

  __device__ bool leader() const { return lane() == 0; }

 private:
  __device__ static int lane() { return static_cast<int>(threadIdx.x) & (W - 1); }
  __device__ static unsigned mask() {
    if constexpr (W == 32) return 0xffffffffu;
    return ((1u << (W & 31)) - 1u) << (threadIdx.x & 31u & ~static_cast<unsigned>(W - 1));
  }

  template <class Accumulator>
  __device__ static Accumulator from_partner(const Accumulator& mine, int distance) {
    static_assert(std::is_trivially_copyable_v<Accumulator> && sizeof(Accumulator) % sizeof(unsigned) == 0, "an accumulator is made of 4-byte words");
    constexpr int words = sizeof(Accumulator) / sizeof(unsigned);
    unsigned word[words];
    std::memcpy(word, &mine, sizeof(mine));
#pragma unroll
    for (int k = 0; k < words; ++k) word[k] = __shfl_xor_sync(mask(), word[k], distance);
    Accumulator partner;
    std::memcpy(&partner, word, sizeof(partner));
    return partner;
  }
};

}  // namespace ogc::fast
