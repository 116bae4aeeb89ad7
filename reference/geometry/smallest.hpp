// Smallest distances that several threads lower at once; the minimum does not depend on their order (Alg. 1 line 6).
#pragma once

#include <atomic>
#include <cstddef>
#include <utility>
#include <vector>

namespace ogc::reference {

/// An array of distances [m], each starting at r_q.
class Smallest {
 public:
  Smallest(std::size_t count, float start) : values_(count, start) {}

  /// Sets entry i to the smaller one of itself and `distance` [m].
  void lower(std::size_t i, float distance) {
    const std::atomic_ref<float> value(values_[i]);
    float seen = value.load(std::memory_order_relaxed);
    while (distance < seen && !value.compare_exchange_weak(seen, distance, std::memory_order_relaxed)) {}
  }

  /// Returns entry i as it is now; it only falls later.
  float so_far(std::size_t i) { return std::atomic_ref<float>(values_[i]).load(std::memory_order_relaxed); }

  /// Returns the distances and empties this.
  std::vector<float> take() { return std::move(values_); }

 private:
  std::vector<float> values_;
};

/// Boxes are searched a little beyond r_q, so that a grey distance just outside r is found even where r_q = r. The grey
/// zone of a distance is wider than this only for faces whose shape leaves fewer than some ten bits of it.
inline constexpr double search_margin = 1 + 1.0 / 64;

}  // namespace ogc::reference
