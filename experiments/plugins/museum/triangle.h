// The correct closest point of a triangle, in double. Exhibits of the museum (plug-ins with one deliberate mistake)
// include this file and change one thing.
#ifndef OGC_MUSEUM_TRIANGLE_H
#define OGC_MUSEUM_TRIANGLE_H

#include "experiments/plugins/museum/geometry.h"

namespace museum {

// Barycentric weights.
struct Weights {
  double of[3] = {0, 0, 0};
};

// Returns the weights of the foot of p on the triangle's plane; not-a-number if the triangle has no area.
inline Weights foot(Vec p, const Vec* t) {
  const Vec n = cross(t[1] - t[0], t[2] - t[0]);
  Weights w;
  for (int k = 0; k < 3; ++k) w.of[k] = dot(cross(t[(k + 1) % 3] - p, t[(k + 2) % 3] - p), n) / dot(n, n);
  return w;
}

// Returns the weights of the closest point of the edge from corner k to the next one. Each weight is computed as a
// quotient, because 1 minus the other weight rounds to 0 too soon.
inline Weights on_edge(Vec p, const Vec* t, int k) {
  const int next = (k + 1) % 3;
  const Vec e = t[next] - t[k];
  const double from = dot(p - t[k], e), to = dot(t[next] - p, e);
  Weights w;
  if (from > 0 && to > 0)
    w.of[k] = to / dot(e, e), w.of[next] = from / dot(e, e);
  else
    w.of[from > 0 ? next : k] = 1;
  return w;
}

inline Vec point(const Vec* t, const Weights& w) { return w.of[0] * t[0] + w.of[1] * t[1] + w.of[2] * t[2]; }

// Returns the weights of the closest point on the nearest edge. The foot of p, with the weights `w`, must lie outside
// the triangle. If the foot lies beyond an edge and between its ends, this edge takes precedence, because by rounding
// an end of another edge may seem as near.
inline Weights on_nearest_edge(Vec p, const Vec* t, const Weights& w) {
  Weights best;
  double nearest = INFINITY;
  bool inside = false;
  for (int k = 0; k < 3; ++k) {
    const Weights on = on_edge(p, t, k);
    const bool beyond = !(w.of[(k + 2) % 3] > 0) && on.of[k] > 0 && on.of[(k + 1) % 3] > 0;
    const double distance = length(p - point(t, on));
    if (beyond < inside || (beyond == inside && distance >= nearest)) continue;
    nearest = distance, best = on, inside = beyond;
  }
  return best;
}

inline int positive(const Weights& w) { return (w.of[0] > 0) + (w.of[1] > 0) + (w.of[2] > 0); }

// Returns the right weights.
inline Weights closest(Vec p, const Vec* t) {
  const Weights w = foot(p, t);
  return positive(w) == 3 ? w : on_nearest_edge(p, t, w);
}

// Returns the feature whose corners have weights above 0.
inline uint8_t feature(const Weights& w) {
  switch ((w.of[0] > 0) + 2 * (w.of[1] > 0) + 4 * (w.of[2] > 0)) {
    case 1: return OGC_CORNER_0;
    case 2: return OGC_CORNER_1;
    case 4: return OGC_CORNER_2;
    case 3: return OGC_EDGE_01;
    case 6: return OGC_EDGE_12;
    case 5: return OGC_EDGE_20;
    default: return OGC_INTERIOR;
  }
}

// Answers the stage: weights(p, t) returns the weights of the point of triangle t that is closest to p.
template <class Choose>
int answer(const ogc_closest_face_in* in, ogc_closest_face_out* out, Choose weights) {
  for (int64_t i = 0; i < in->n; ++i) {
    const Vec p = vec(in->point[i]), t[3] = {vec(in->triangle[i][0]), vec(in->triangle[i][1]), vec(in->triangle[i][2])};
    const Weights w = weights(p, t);
    const double distance = length(p - point(t, w));
    out->feature[i] = feature(w);
    for (int k = 0; k < 3; ++k) out->weights[i][k] = float(w.of[k]);
    out->distance[i] = float(distance);
    out->distance_below[i] = below(distance, length(t[0] - p) + length(t[1] - p) + length(t[2] - p));
  }
  return 0;
}

}  // namespace museum

#endif
