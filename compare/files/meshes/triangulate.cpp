// Cuts off ears: triangles of three successive corners. Rounding decides nothing important: an ear that only rounding
// makes convex has almost no area, so it is cut off last.
#include "compare/files/meshes/triangulate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace ogc::compare {
namespace {

Vec3 difference(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Holds the corners of a face that are not cut off yet, and the normal along which the face is seen.
class Cutter {
 public:
  Cutter(std::span<const Index> corners, std::span<const Vec3> positions)
      : left_(corners.begin(), corners.end()), positions_(positions) {
    Vec3 sum;
    for (std::size_t k = 0; k + 2 < corners.size(); ++k) {
      const Vec3 part = cross(difference(at(corners[k + 1]), at(corners[0])),
                              difference(at(corners[k + 2]), at(corners[0])));
      sum = {sum.x + part.x, sum.y + part.y, sum.z + part.z};
    }
    const double length = std::hypot(sum.x, sum.y, sum.z);
    if (length > 0) normal_ = {sum.x / length, sum.y / length, sum.z / length};
  }

  std::vector<Triangle> cut_quad() const {
    const Triangle first{left_[0], left_[1], left_[2]}, rest{left_[0], left_[2], left_[3]};
    const Triangle other{left_[0], left_[1], left_[3]}, other_rest{left_[1], left_[2], left_[3]};
    const double usual = std::min(shape(first), shape(rest)), turned = std::min(shape(other), shape(other_rest));
    if (std::max(usual, turned) <= 0) return {};
    if (turned > 2 * usual) return {other, other_rest};
    return {first, rest};
  }

  std::vector<Triangle> cut() {
    std::vector<Triangle> triangles;
    shapes_.resize(left_.size());
    for (std::size_t k = 0; k < left_.size(); ++k) shapes_[k] = shape(ear(k));
    while (left_.size() > 3) {
      const std::size_t k = best_ear();
      if (k == left_.size()) return {};
      triangles.push_back(ear(k));
      const auto at = static_cast<std::ptrdiff_t>(k);
      left_.erase(left_.begin() + at);
      shapes_.erase(shapes_.begin() + at);
      const std::size_t count = left_.size();
      for (const std::size_t neighbour : {(k + count - 1) % count, k % count})
        shapes_[neighbour] = shape(ear(neighbour));
    }
    if (shape(ear(1)) <= 0) return {};
    triangles.push_back(ear(1));
    return triangles;
  }

 private:
  const Vec3& at(Index v) const { return positions_[static_cast<std::size_t>(v)]; }

  Triangle ear(std::size_t k) const {
    return {left_[(k + left_.size() - 1) % left_.size()], left_[k], left_[(k + 1) % left_.size()]};
  }

  /// Returns twice the signed area over the squared longest side: 0.87 for an equilateral triangle, at most 0 for a
  /// triangle of the wrong orientation.
  double shape(const Triangle& t) const {
    const Vec3 u = difference(at(t[1]), at(t[0])), v = difference(at(t[2]), at(t[0])),
               w = difference(at(t[2]), at(t[1]));
    const double longest = std::max({dot(u, u), dot(v, v), dot(w, w)});
    return longest > 0 ? dot(cross(u, v), normal_) / longest : 0;
  }

  /// Returns the best ear, or the number of corners if there is none. An ear that contains another corner waits until
  /// that corner is cut off.
  std::size_t best_ear() const {
    std::vector<bool> blocked(left_.size());
    while (true) {
      std::size_t best = left_.size();
      for (std::size_t k = 0; k < left_.size(); ++k) {
        if (!blocked[k] && shapes_[k] > 0 && (best == left_.size() || shapes_[k] > shapes_[best])) best = k;
      }
      if (best == left_.size() || is_empty(ear(best))) return best;
      blocked[best] = true;
    }
  }

  /// Returns whether no other corner lies in the closed triangle, as seen along the normal. Corners that coincide with
  /// a corner of the triangle do not count. They occur where a pair of coinciding edges joins a face to its hole.
  bool is_empty(const Triangle& t) const {
    const auto inside = [&](const Vec3& p) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 &a = at(t[k]), &b = at(t[(k + 1) % 3]);
        if (p == a || dot(cross(difference(b, a), difference(p, a)), normal_) < 0) return false;
      }
      return true;
    };
    return std::ranges::none_of(left_, [&](Index v) { return v != t[0] && v != t[1] && v != t[2] && inside(at(v)); });
  }

  std::vector<Index> left_;     ///< corners that are not cut off yet
  std::vector<double> shapes_;  ///< shape of the ear at each of them
  std::span<const Vec3> positions_;
  Vec3 normal_;
};

}  // namespace

std::vector<Triangle> triangulate(std::span<const Index> corners, std::span<const Vec3> positions) {
  Cutter cutter(corners, positions);
  return corners.size() == 4 ? cutter.cut_quad() : cutter.cut();
}

}  // namespace ogc::compare
