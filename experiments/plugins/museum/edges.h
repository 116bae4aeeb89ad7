// The correct closest points of two edges, in double. Exhibits of the museum (plug-ins with one deliberate mistake)
// include this file and change one thing.
#ifndef OGC_MUSEUM_EDGES_H
#define OGC_MUSEUM_EDGES_H

#include "experiments/plugins/museum/geometry.h"

namespace museum {

// Two edges: from a along e and from b along f.
struct Edges {
  Vec a, e, b, f;
};

// Parameters of a point on each edge, from 0 to 1, and the distance of the two points.
struct Places {
  double s = 0, t = 0, distance = INFINITY;
};

inline void keep_nearer(Places& best, const Edges& x, double s, double t) {
  const double distance = length(x.a + s * x.e - x.b - t * x.f);
  if (distance < best.distance) best = {s, t, distance};
}

// Returns the closest points: inside both edges, or at an end of one of them.
inline Places closest(const Edges& x) {
  Places best;
  const double ee = dot(x.e, x.e), ef = dot(x.e, x.f), ff = dot(x.f, x.f),
               determinant = dot(cross(x.e, x.f), cross(x.e, x.f));
  const Vec r = x.b - x.a;
  const double s = (dot(r, x.e) * ff - dot(r, x.f) * ef) / determinant,
               t = (dot(r, x.e) * ef - dot(r, x.f) * ee) / determinant;
  if (determinant > 0 && s > 0 && s < 1 && t > 0 && t < 1) keep_nearer(best, x, s, t);
  for (const double end : {0.0, 1.0}) {
    keep_nearer(best, x, end, place_on(x.a + end * x.e, x.b, x.b + x.f));
    keep_nearer(best, x, place_on(x.b + end * x.f, x.a, x.a + x.e), end);
  }
  return best;
}

// The interval of the first edge's parameter, from 0 to 1, that the projection of the second edge covers.
struct Overlap {
  double low = 0, high = 0;
};
inline Overlap overlap(const Edges& x) {
  const double ee = dot(x.e, x.e), from = dot(x.b - x.a, x.e) / ee, to = dot(x.b + x.f - x.a, x.e) / ee;
  return {std::max(0.0, std::min(from, to)), std::min(1.0, std::max(from, to))};
}

inline bool nearly_parallel(const Edges& x) {
  const Overlap shared = overlap(x);
  return dot(cross(x.e, x.f), cross(x.e, x.f)) < 1e-6 * dot(x.e, x.e) * dot(x.f, x.f) && shared.low < shared.high;
}

// Returns the contact points of nearly parallel edges: the middle of the overlap, and its projection onto the second
// edge.
inline Places middle(const Edges& x) {
  const Overlap shared = overlap(x);
  const double s = (shared.low + shared.high) / 2, t = place_on(x.a + s * x.e, x.b, x.b + x.f);
  return {s, t, length(x.a + s * x.e - x.b - t * x.f)};
}

}  // namespace museum

#endif
