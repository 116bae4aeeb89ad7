// The correct force and block of a spring's end, in double. Exhibits of the museum (plug-ins with one deliberate
// mistake) include this file and change one thing.
#ifndef OGC_MUSEUM_SPRING_H
#define OGC_MUSEUM_SPRING_H

#include <algorithm>
#include <cmath>

#include "compare/plugin.h"

namespace museum {

// Holds the vector that the spring spans, and its length l.
struct Apart {
  double x, y, z, length;

  Apart(const ogc_vec3* p, double s) {
    x = double(p[0].x) - (1 - s) * p[1].x - (s > 0 ? s * p[2].x : 0);
    y = double(p[0].y) - (1 - s) * p[1].y - (s > 0 ? s * p[2].y : 0);
    z = double(p[0].z) - (1 - s) * p[1].z - (s > 0 ? s * p[2].z : 0);
    length = std::sqrt(x * x + y * y + z * z);
  }
};

inline double weight_of(const ogc_spring_case& c) {
  return c.own == 0 ? 1 : c.own == 1 ? double(c.ratio) - 1 : -double(c.ratio);
}

// Writes the answer with this damping of strain; `times` multiplies the block.
inline void answer(const ogc_spring_case& c, double damping, double times, ogc_vec3& force, float* block) {
  const Apart now(c.vertex, c.ratio), start(c.start, c.ratio);
  const double k = c.stiffness, l = now.length, w = weight_of(c);
  const bool by_vertex = c.damping_form == OGC_DAMPING_PER_VERTEX;
  const double n[3] = {l > 0 ? now.x / l : 0, l > 0 ? now.y / l : 0, l > 0 ? now.z / l : 0};
  const double across = l > 0 ? std::max(0.0, 1 - c.rest_length / l) : 1;
  const double along = (l > 0 ? 1 - across : 0) + (by_vertex ? 0 : damping);
  const double pull = -w * k * (l - c.rest_length + (by_vertex ? 0 : damping * (l - start.length)));
  double f[3] = {pull * n[0], pull * n[1], pull * n[2]}, b[6];
  const int row[6] = {0, 0, 0, 1, 1, 2}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int e = 0; e < 6; ++e)
    b[e] = w * w * k * ((row[e] == column[e] ? across : 0) + along * n[row[e]] * n[column[e]]);
  if (by_vertex) {
    const ogc_vec3 &x = c.vertex[c.own], &t = c.start[c.own];
    const double moved[3] = {double(x.x) - t.x, double(x.y) - t.y, double(x.z) - t.z};
    for (int e = 0; e < 6; ++e) {
      f[row[e]] -= c.damping * b[e] * moved[column[e]];
      if (row[e] != column[e]) f[column[e]] -= c.damping * b[e] * moved[row[e]];
    }
    for (double& entry : b) entry *= 1 + double(c.damping);
  }
  force = {float(f[0]), float(f[1]), float(f[2])};
  for (int e = 0; e < 6; ++e) block[e] = float(times * b[e]);
}

}  // namespace museum

#endif
