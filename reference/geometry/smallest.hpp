// Holds smallest distances that several threads lower at once; the result does not depend on their order (Alg. 1 line
// 6).
#pragma once

#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

namespace ogc::reference {

/// An array of distances [m], all initially r_q.
class Smallest {
 public:
  Smallest(std::size_t count, float start) : values_(count, start) {}

  /// Sets entry i to `distance` [m] if that is smaller.
  void lower(std::size_t i, float distance) {
    const std::atomic_ref<float> value(values_[i]);
    float seen = value.load(std::memory_order_relaxed);
    while (distance < seen && !value.compare_exchange_weak(seen, distance, std::memory_order_relaxed)) {}
  }

  /// Returns the present value of entry i, which later calls can only lower.
  float so_far(std::size_t i) { return std::atomic_ref<float>(values_[i]).load(std::memory_order_relaxed); }

  /// Returns the distances and empties the array.
  std::vector<float> take() { return std::move(values_); }

 private:
  std::vector<float> values_;
};

/// Multiple of r_q up to which pairs are searched. So detections find pairs beyond r that rounding may put within r,
/// even if r_q = r. Rounding may reach farther only for slender faces, whose distance has fewer than about ten correct
/// bits.
inline constexpr double search_margin = 1 + 1.0 / 64;

}  // namespace ogc::reference
