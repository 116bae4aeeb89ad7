// A correct plug-in in double precision for the stage ccd, by conservative advancement (Li et al. 2021, Algorithm 1).
// Each advance is 0.9 of the longest of three safe times. One follows from the speeds of the faces, the others from two
// slabs between the faces.
//
//     g++ -O2 -shared -fPIC -I INCLUDE ccd.cpp -o ccd.so
//     ogc compare ccd --plugin ./ccd.so
#include <algorithm>
#include <array>
#include <cmath>

#include "compare/plugin.h"

OGC_PLUGIN("conservative advancement", OGC_HOST_MEMORY)

namespace {
using Vector = std::array<double, 3>;
using Points = std::array<Vector, 4>;
Vector mix(const Vector& a, double s, const Vector& b) { return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]}; }
Vector minus(const Vector& a, const Vector& b) { return mix(a, -1, b); }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector from_edge(const Vector& p, const Vector& a, const Vector& b) {  // vector from the edge to p
  const Vector e = minus(b, a);
  const double s = dot(e, e) > 0 ? std::clamp(dot(minus(p, a), e) / dot(e, e), 0.0, 1.0) : 0;
  return minus(p, mix(a, s, e));
}
Vector shortest(bool edges, const Points& x) {  // shortest vector between the faces
  const Vector p = edges ? minus(x[1], x[0]) : minus(x[2], x[1]), q = minus(x[3], edges ? x[2] : x[1]),
               w = minus(x[edges ? 2 : 0], x[edges ? 0 : 1]), n = cross(p, q);
  const double square = dot(n, n), s = dot(cross(w, q), n), t = (edges ? 1 : -1) * dot(cross(w, p), n);
  const bool is_over = square > 0 && s >= 0 && t >= 0 && (edges ? s <= square && t <= square : s + t <= square);
  std::array<Vector, 5> ways{from_edge(x[0], x[2], x[3]), from_edge(x[edges ? 1 : 0], edges ? x[2] : x[1], x[3]),
                             edges ? from_edge(x[2], x[0], x[1]) : from_edge(x[0], x[1], x[2])};
  ways[3] = edges ? from_edge(x[3], x[0], x[1]) : ways[0];
  ways[4] = is_over ? mix({}, dot(w, n) / square, n) : ways[0];
  return *std::min_element(ways.begin(), ways.end(), [](auto& a, auto& b) { return dot(a, a) < dot(b, b); });
}

double time_of(const ogc_ccd_case& c) {
  const bool edges = c.kind == OGC_CCD_EDGE_EDGE;
  const int split = edges ? 2 : 1;  // number of vertices of the first face
  const auto apart = [](const ogc_vec3& a, const ogc_vec3& b) { return minus({a.x, a.y, a.z}, {b.x, b.y, b.z}); };
  Points from, way, x;
  Vector mean{};
  double size = 0, t = 0, speed[2] = {}, first = 0;
  for (int k = 0; k < 4; ++k) mean = mix(mean, 0.25, way[k] = apart(c.to[k], c.from[k]));
  for (int k = 0; k < 4; ++k) {
    way[k] = minus(way[k], mean), from[k] = apart(c.from[k], c.from[0]);
    speed[k >= split] = std::max(speed[k >= split], length(way[k])), size += length(from[k]) + length(way[k]);
  }
  for (int step = 0; step < 1000; ++step) {
    for (int k = 0; k < 4; ++k) x[k] = mix(from[k], t, way[k]);
    const Vector d = shortest(edges, x);
    const double gap = length(d) - 1e-13 * size;  // minus the largest rounding error
    if (gap <= 0 || gap < 0.1 * (first = step == 0 ? gap : first)) break;
    double slab[2] = {2, 2};  // times for which the slab stays empty, by heights along d and -d
    for (int i = 0; i < split; ++i)
      for (int j = split; j < 4; ++j)
        for (int k = 0; k < 2; ++k) {
          const double sign = (k == 0 ? 1 : -1) / length(d), height = sign * dot(d, minus(x[i], x[j])) - 1e-13 * size,
                       rate = sign * dot(d, minus(way[i], way[j]));
          if (height <= 0 || height + slab[k] * rate < 0) slab[k] = height <= 0 ? 0 : -height / rate;
        }
    t += 0.9 * std::max({gap / (speed[0] + speed[1]), slab[0], slab[1]});
    if (!(t < 1)) return 1;
  }
  return t;
}
}  // namespace

int ogc_ccd(const ogc_ccd_in* in, ogc_ccd_out* out) {
  for (int64_t i = 0; i < in->n; ++i) {
    const double t = time_of(in->cases[i]);
    out->time[i] = float(t) > t ? std::nextafter(float(t), 0.0f) : float(t);
  }
  return 0;
}
