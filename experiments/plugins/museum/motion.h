// The correct time of impact by conservative advancement (Li et al. 2021, Algorithm 1), in double: each step is 0.9 of
// the longest time for which speeds, or heights along the shortest vector, keep the faces apart. Exhibits of the museum
// (plug-ins with one deliberate mistake) include this file and change one thing.
#ifndef OGC_MUSEUM_MOTION_H
#define OGC_MUSEUM_MOTION_H

#include "experiments/plugins/museum/edges.h"
#include "experiments/plugins/museum/triangle.h"

namespace museum {

// A vertex and a triangle, or two edges, that move straight. Positions are relative to vertex 0 at the start, ways
// relative to the mean way: what all points have in common changes no distance.
struct Motion {
  bool edges = false;
  Vec from[4], way[4];
  double size = 0;  // largest coordinate of `from` plus that of `way` [m]

  explicit Motion(const ogc_ccd_case& c) : edges(c.kind == OGC_CCD_EDGE_EDGE) {
    Vec mean{0, 0, 0};
    for (int k = 0; k < 4; ++k) from[k] = vec(c.from[k]) - vec(c.from[0]), way[k] = vec(c.to[k]) - vec(c.from[k]);
    for (const Vec& w : way) mean = mean + 0.25 * w;
    for (Vec& w : way) w = w - mean;
    size = largest(from) + largest(way);
  }

  int first_count() const { return edges ? 2 : 1; }

  // Returns the shortest vector from the second face to the first at a time.
  Vec shortest(double t) const {
    Vec x[4];
    for (int k = 0; k < 4; ++k) x[k] = from[k] + t * way[k];
    if (edges) {
      const Edges both{x[0], x[1] - x[0], x[2], x[3] - x[2]};
      const Places at = closest(both);
      return both.a + at.s * both.e - both.b - at.t * both.f;
    }
    const Weights w = foot(x[0], x + 1);
    const bool inside = w.of[0] > 0 && w.of[1] > 0 && w.of[2] > 0;
    return x[0] - point(x + 1, inside ? w : on_nearest_edge(x[0], x + 1, w));
  }
  double distance(double t) const { return length(shortest(t)); }

  // Returns how long after t the heights along d keep the faces apart, at most 1. Each height errs by `rounding`.
  double apart(Vec d, double t, double rounding) const {
    double longest = 1;
    for (int i = 0; i < first_count(); ++i)
      for (int j = first_count(); j < 4; ++j) {
        const double height = dot(d, from[i] - from[j] + t * (way[i] - way[j])) - rounding,
                     rate = dot(d, way[i] - way[j]);
        if (height <= 0) return 0;
        if (height + longest * rate < 0) longest = -height / rate;
      }
    return longest;
  }

  // Returns the rate above which the distance can't change: the largest speeds of both faces.
  double rate() const {
    double speed[2] = {0, 0};
    for (int k = 0; k < 4; ++k) {
      double& own = speed[k >= first_count()];
      own = std::max(own, length(way[k]));
    }
    return speed[0] + speed[1];
  }

 private:
  static double largest(const Vec* all) {
    double most = 0;
    for (int k = 0; k < 4; ++k) most = std::max({most, std::abs(all[k].x), std::abs(all[k].y), std::abs(all[k].z)});
    return most;
  }
};

// Distances below this are not told from 0: 16 roundings of single precision.
inline double resolution(const Motion& motion) { return 16 * 0x1p-24 * motion.size; }

// Returns a time before which the faces share no point, 1 if they share none; 0 if they can't be told apart.
inline double advance(const Motion& motion) {
  const double rounding = 1e-12 * motion.size, first = motion.distance(0) - rounding, rate = motion.rate();
  double t = 0;
  for (int step = 0; step < 1000; ++step) {
    const double gap = motion.distance(t) - rounding;
    if (gap <= 0.1 * std::max(first, 0.0)) break;
    const Vec d = 1 / motion.distance(t) * motion.shortest(t);
    t += 0.9 * std::max({gap / rate, motion.apart(d, t, rounding), motion.apart(-1 * d, t, rounding)});
    if (!(t < 1)) return 1;
  }
  return t;
}

// Answers all cases by `time`, rounded down.
template <class Time>
int answer(const ogc_ccd_in* in, ogc_ccd_out* out, Time time) {
  for (int64_t i = 0; i < in->n; ++i) {
    const double t = time(Motion(in->cases[i]));
    out->time[i] = float(t) > t ? std::nextafter(float(t), 0.0f) : float(t);
  }
  return 0;
}

}  // namespace museum

#endif
