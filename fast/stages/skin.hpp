// Memory of the list with a skin (fast/kernels/skin.hpp). Unlike the other lists it may be too small: then a detection
// searches, and the host, when it looks the next time, gives the list more room. It begins with room for few pairs,
// since many callers never need it.
#pragma once

#include <algorithm>
#include <cstddef>

#include "fast/kernels/skin.hpp"

namespace ogc::fast {

/// Largest m as a part of r: a list outlives displacements of up to 7/32 of m, and grows with it (fast/PERFORMANCE.md).
inline constexpr float usual_skin = 1.0F;

template <class Backend>
class Skin {
 public:
  /// `share`: largest m/r; 0 for none, every detection searches.
  Skin(const SurfaceView& surface, float share) : share_(share) {
    const auto size = [](int n) { return static_cast<std::size_t>(n); };
    forget();
    if (!is_used()) return;
    anchor_.resize(size(surface.vertex_count));
    vertex_.resize(size(surface.vertex_count)), edge_.resize(size(surface.edge_count)),
        triangle_.resize(size(surface.triangle_count));
    pairs_.resize(size(capacity_));
  }

  SkinView view(float contact_radius) {
    return {state_.data(),  share_ * contact_radius, contact_radius, pairs_.data(),   capacity_,
            anchor_.data(), vertex_.data(),          edge_.data(),   triangle_.data()};
  }

  /// Whether a detection may ever do anything but search.
  bool is_used() const { return share_ > 0; }

  /// Host only: the next detection searches.
  void forget() {
    const SkinState fresh;
    state_.upload(&fresh, 1);
  }

  /// Host only: room for half as many pairs again as the longest list had, where that found none; true where something
  /// moved.
  bool make_room() {
    const SkinState now = state();
    const int most = std::max(now.most, now.count);
    if (most <= capacity_) return false;
    capacity_ = most + most / 2;
    pairs_.resize(static_cast<std::size_t>(capacity_));
    forget();
    return true;
  }

  /// Host only.
  SkinState state() const {
    SkinState now;
    state_.download(&now, 1);
    return now;
  }

 private:
  template <class T>
  using Buffer = typename Backend::template Buffer<T>;

  float share_;
  int capacity_ = 1 << 14;  // 128 KiB
  Buffer<SkinState> state_;
  Buffer<NotedPair> pairs_;
  Buffer<Vec> anchor_;
  Buffer<float> vertex_, edge_, triangle_;
};

}  // namespace ogc::fast
