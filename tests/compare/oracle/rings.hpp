// Makes closed curves and counts how they are linked.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "compare/problem/mesh.hpp"

namespace ogc::tests {

using compare::Edge;
using compare::Index;
using compare::Vec3;

inline std::size_t ring_place(Index i) { return static_cast<std::size_t>(i); }

/// Adds a closed polygon of n loose edges about `centre` in the plane of u and v.
inline void add_ring(std::vector<Vec3>& positions, std::vector<Edge>& loose, Index n, Vec3 centre, Vec3 u, Vec3 v) {
  const auto first = static_cast<Index>(positions.size());
  for (Index k = 0; k < n; ++k) {
    const double angle = 2 * 3.141592653589793 * (double(k) + 0.3) / double(n), c = std::cos(angle),
                 s = std::sin(angle);
    positions.push_back({centre.x + c * u.x + s * v.x, centre.y + c * u.y + s * v.y, centre.z + c * u.z + s * v.z});
    loose.push_back({first + k, first + (k + 1) % n});
  }
}

/// Returns the linking number of two rings of n edges each: the sum of the signs of the crossings, seen along z, at
/// which the first ring passes above the second. The projections along z must be in general position.
inline int linking_number(const std::vector<Vec3>& x, Index n) {
  const auto side = [&](Index a, Index b, Index c) {
    const Vec3 &p = x[ring_place(a)], &q = x[ring_place(b)], &r = x[ring_place(c)];
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x) > 0 ? 1 : -1;
  };
  int sum = 0;
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const Index a = i, b = (i + 1) % n, c = n + j, d = n + (j + 1) % n;
      if (side(a, b, c) == side(a, b, d) || side(c, d, a) == side(c, d, b)) continue;
      const auto height = [&](Index p, Index q, Index r, Index s) {  // height of edge pq where it crosses rs
        const Vec3 &o = x[ring_place(p)], &e = x[ring_place(q)], &g = x[ring_place(r)], &h = x[ring_place(s)];
        const double dx = h.x - g.x, dy = h.y - g.y;
        const double before = (o.x - g.x) * dy - (o.y - g.y) * dx, after = (e.x - g.x) * dy - (e.y - g.y) * dx;
        return o.z + before / (before - after) * (e.z - o.z);
      };
      if (height(a, b, c, d) < height(c, d, a, b)) continue;
      sum += side(a, b, d) > 0 ? 1 : -1;
    }
  return sum;
}

/// Returns on which side of ab the edge cd lies, 1 or −1: the sign of the determinant of ab, cd and the vector from a
/// to c.
inline int sense(const std::vector<Vec3>& x, const Edge& ab, const Edge& cd) {
  const auto minus = [&](Index i, Index j) {
    return Vec3{x[ring_place(i)].x - x[ring_place(j)].x, x[ring_place(i)].y - x[ring_place(j)].y,
                x[ring_place(i)].z - x[ring_place(j)].z};
  };
  const Vec3 u = minus(ab[1], ab[0]), v = minus(cd[1], cd[0]), w = minus(cd[0], ab[0]);
  const double volume = w.x * (u.y * v.z - u.z * v.y) + w.y * (u.z * v.x - u.x * v.z) + w.z * (u.x * v.y - u.y * v.x);
  return volume > 0 ? 1 : -1;
}

}  // namespace ogc::tests
