// A correct plug-in in double precision for the stage volume_force: contact of a point with a triangle of a volume,
// with friction.
#include <cmath>

#include "compare/plugin.h"

OGC_PLUGIN("volume force in double", OGC_HOST_MEMORY)

int ogc_volume_force(const ogc_volume_force_in* in, ogc_force_out* out) {
  for (int64_t i = 0; i < in->n; ++i) {
    const ogc_volume_force_case& c = in->cases[i];
    const double n[3] = {c.direction[0], c.direction[1], c.direction[2]};
    // vector from the closest point of the triangle to the point, and relative motion of the two since the start of the
    // step
    double apart[3] = {}, moved[3] = {};
    const auto add = [](double(&sum)[3], double w, const ogc_vec3& a, const ogc_vec3& b) {
      sum[0] += w * (double(a.x) - b.x), sum[1] += w * (double(a.y) - b.y), sum[2] += w * (double(a.z) - b.z);
    };
    add(moved, 1, c.vertex[0], c.start[0]);
    for (int k = 1; k < 4; ++k) {
      add(apart, c.weights[k - 1], c.vertex[0], c.vertex[k]);
      add(moved, c.weights[k - 1], c.start[k], c.vertex[k]);
    }
    double phi = 0, along = 0, slip[3], squared = 0;
    for (int k = 0; k < 3; ++k) phi += n[k] * apart[k], along += n[k] * moved[k];
    for (int k = 0; k < 3; ++k) slip[k] = moved[k] - along * n[k], squared += slip[k] * slip[k];
    const double depth = c.contact_radius - phi, pressure = depth > 0 ? c.stiffness * depth : 0;
    const double length = std::sqrt(squared), limit = c.slip_limit;
    // f1(y)/y with y = length, e = limit; f1 = 2 y/e - y^2/e^2 if y < e, else 1
    const double ratio = length < limit ? (2 - length / limit) / limit : 1 / length;
    const double strength = c.friction * pressure * ratio, w = c.own == 0 ? 1 : -c.weights[c.own - 1];
    const double normal = pressure > 0 ? c.stiffness * w * w : 0, across = strength * w * w;
    double force[3];
    for (int k = 0; k < 3; ++k) force[k] = w * (pressure * n[k] - strength * slip[k]);
    out->force[i] = {float(force[0]), float(force[1]), float(force[2])};
    for (int a = 0, at = 0; a < 3; ++a)
      for (int b = a; b < 3; ++b, ++at)
        out->block[i][at] = float((normal - across) * n[a] * n[b] + (a == b ? across : 0));
  }
  return 0;
}
