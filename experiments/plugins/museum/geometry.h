// Correct distances in double. Exhibits of the museum (plug-ins with one deliberate mistake) include this file.
#ifndef OGC_MUSEUM_GEOMETRY_H
#define OGC_MUSEUM_GEOMETRY_H

#include <algorithm>
#include <cmath>

#include "compare/plugin.h"

namespace museum {

struct Vec {
  double x, y, z;
};

inline Vec vec(const ogc_vec3& p) { return {p.x, p.y, p.z}; }
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator*(double s, Vec a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec cross(Vec a, Vec b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(Vec a) { return std::sqrt(dot(a, a)); }

// Returns the parameter, from 0 at a to 1 at b, of the point of the segment nearest to p; 0 if the segment has no
// length.
inline double place_on(Vec p, Vec a, Vec b) {
  const double squared = dot(b - a, b - a);
  return squared > 0 ? std::clamp(dot(p - a, b - a) / squared, 0.0, 1.0) : 0;
}

// Returns a number of single precision that is certainly not above d, and never negative. d has an error of 1e-7 of
// `size`.
inline float below(double d, double size) {
  const double low = d - 4e-7 * std::max(d, size);
  return low > 0 ? std::nextafter(float(low), 0.0f) : 0;
}

}  // namespace museum

#endif
