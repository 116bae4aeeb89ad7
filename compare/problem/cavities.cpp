// Computes winding numbers from the crossings of a ray along +x. The ray starts at (x, y + ε, z + ε²) with vanishing ε,
// so that it meets no edge.
#include "compare/problem/cavities.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "compare/problem/tetrahedra.hpp"

namespace ogc::compare {
namespace {

/// Returns the sign of the area of the triangle (a, b, p), seen along the x axis. First p is moved by (ε, ε²) in y and
/// z, with an infinitesimal ε > 0.
int side_seen(const Vec3& a, const Vec3& b, const Vec3& p) {
  const int side = orientation({0, a.y, a.z}, {0, b.y, b.z}, {0, p.y, p.z}, {1, p.y, p.z});
  if (side != 0) return side;
  // the sign of −(b.z − a.z) ε, or of (b.y − a.y) ε² if b.z = a.z
  if (a.z != b.z) return b.z < a.z ? 1 : -1;
  return a.y < b.y ? 1 : a.y > b.y ? -1 : 0;
}

class PlacedShell {
 public:
  PlacedShell(const Mesh& mesh, std::span<const Vec3> positions, std::span<const Index> triangles)
      : positions_(positions) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    low_ = {infinity, infinity, infinity}, high_ = {-infinity, -infinity, -infinity};
    for (const Index t : triangles) {
      const Triangle& corners = mesh.triangles[at(t)];
      double bottom = infinity, top = -infinity;
      for (const Index v : corners) {
        const Vec3& x = positions_[at(v)];
        low_ = {std::min(low_.x, x.x), std::min(low_.y, x.y), std::min(low_.z, x.z)};
        high_ = {std::max(high_.x, x.x), std::max(high_.y, x.y), std::max(high_.z, x.z)};
        bottom = std::min(bottom, x.y), top = std::max(top, x.y);
        vertices_.push_back(v);
      }
      tallest_ = std::max(tallest_, top - bottom);
      from_below_.push_back({bottom, corners});
    }
    std::ranges::sort(vertices_);
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    std::ranges::sort(from_below_, {}, &Reach::bottom);
  }

  /// Returns whether the shell winds around all vertices of the other shell.
  bool holds(const PlacedShell& other) const {
    const bool may_hold = low_.x <= other.low_.x && low_.y <= other.low_.y && low_.z <= other.low_.z &&
                          other.high_.x <= high_.x && other.high_.y <= high_.y && other.high_.z <= high_.z;
    return may_hold && std::ranges::all_of(other.vertices_, [&](Index v) { return winding(positions_[at(v)]) != 0; });
  }

 private:
  /// A triangle and the smallest y of its corners.
  struct Reach {
    double bottom = 0;
    Triangle corners{};
  };

  int winding(const Vec3& p) const {
    int count = 0;
    // tallest_ is the largest height of a triangle along y, as a rounded difference. Twice this is certainly above the
    // true height.
    auto reach = std::ranges::lower_bound(from_below_, p.y - 2 * tallest_, {}, &Reach::bottom);
    for (; reach != from_below_.end() && reach->bottom <= p.y; ++reach) count += crossing(reach->corners, p);
    return count;
  }

  /// Returns how the ray from p crosses a triangle: 1 outward, −1 inward, 0 not at all.
  int crossing(const Triangle& triangle, const Vec3& p) const {
    const Vec3 &a = positions_[at(triangle[0])], &b = positions_[at(triangle[1])], &c = positions_[at(triangle[2])];
    if (std::max({a.x, b.x, c.x}) < p.x || std::max({a.y, b.y, c.y}) < p.y || std::max({a.z, b.z, c.z}) < p.z ||
        std::min({a.z, b.z, c.z}) > p.z)
      return 0;
    const int seen = side_seen(a, b, p);
    if (seen == 0 || side_seen(b, c, p) != seen || side_seen(c, a, p) != seen) return 0;
    return orientation(a, b, c, p) == -seen ? seen : 0;
  }

  std::span<const Vec3> positions_;
  std::vector<Index> vertices_;
  std::vector<Reach> from_below_;
  double tallest_ = 0;
  Vec3 low_, high_;
};

}  // namespace

std::vector<int> enclosing_shells(const Mesh& mesh, std::span<const Shell> shells) {
  std::vector<int> enclosing(shells.size(), -1);
  const auto faces_inward = [](const Shell& shell) { return shell.volume < 0; };
  if (std::ranges::none_of(shells, faces_inward)) return enclosing;
  const std::vector<Vec3> positions = to_double(to_single(mesh.positions));
  std::vector<PlacedShell> placed;
  placed.reserve(shells.size());
  for (const Shell& shell : shells) placed.emplace_back(mesh, positions, shell.triangles);
  for (std::size_t i = 0; i < shells.size(); ++i) {
    for (std::size_t k = 0; faces_inward(shells[i]) && k < shells.size(); ++k) {
      const bool is_inner = enclosing[i] < 0 || shells[k].volume < shells[at(enclosing[i])].volume;
      if (shells[k].volume > 0 && is_inner && placed[k].holds(placed[i])) enclosing[i] = static_cast<int>(k);
    }
  }
  std::vector<int> cavities = enclosing;
  for (std::size_t i = 0; i < shells.size(); ++i)
    for (std::size_t k = 0; enclosing[i] >= 0 && k < shells.size(); ++k)
      if (k != i && enclosing[k] == enclosing[i] && placed[k].holds(placed[i])) cavities[i] = -1;
  return cavities;
}

}  // namespace ogc::compare
