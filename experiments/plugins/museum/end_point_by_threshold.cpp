// An end point chosen by an absolute threshold: an epsilon meant for parallel edges is held against squared lengths, so
// that every edge shorter than 3.2 mm counts as its first end. Distances come out too large, and contacts of fine
// meshes are missed.
#include "experiments/plugins/museum/geometry.h"

OGC_PLUGIN("end point by an absolute threshold", OGC_HOST_MEMORY)

namespace {

using namespace museum;

constexpr double epsilon = 1e-5;

struct Points {
  double s = 0, t = 0, distance = INFINITY;
};

void keep_nearer(Points& best, Vec a, Vec e, Vec b, Vec f, double s, double t) {
  const double distance = length(a + s * e - b - t * f);
  if (distance < best.distance) best = {s, t, distance};
}

// The closest points of the edges from a along e and from b along f: inside both, or at an end of one of them.
Points closest(Vec a, Vec e, Vec b, Vec f) {
  Points best;
  const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), determinant = dot(cross(e, f), cross(e, f));
  const Vec r = b - a;
  const double s = (dot(r, e) * ff - dot(r, f) * ef) / determinant, t = (dot(r, e) * ef - dot(r, f) * ee) / determinant;
  if (determinant > 0 && s > 0 && s < 1 && t > 0 && t < 1) keep_nearer(best, a, e, b, f, s, t);
  for (const double end : {0.0, 1.0}) {
    keep_nearer(best, a, e, b, f, end, place_on(a + end * e, b, b + f));
    keep_nearer(best, a, e, b, f, place_on(b + end * f, a, a + e), end);
  }
  return best;
}

uint8_t feature(double place) { return place <= 0 ? OGC_END_0 : place >= 1 ? OGC_END_1 : OGC_EDGE_INTERIOR; }

void answer(const ogc_closest_points_in* in, int64_t i, ogc_closest_points_out* out) {
  const Vec a = vec(in->first[i][0]), b = vec(in->second[i][0]);
  Vec e = vec(in->first[i][1]) - a, f = vec(in->second[i][1]) - b;
  const double size = length(e) + length(f) + length(b - a);
  if (dot(e, e) < epsilon) e = {0, 0, 0};  // the mistake
  if (dot(f, f) < epsilon) f = {0, 0, 0};
  Points points = closest(a, e, b, f);
  out->distance_below[i] = below(points.distance, size);
  const double ee = dot(e, e), from = dot(b - a, e) / ee, to = dot(b + f - a, e) / ee;
  const double low = std::max(0.0, std::min(from, to)), high = std::min(1.0, std::max(from, to));
  const bool parallel = dot(cross(e, f), cross(e, f)) < 1e-6 * ee * dot(f, f) && low < high;
  out->nearly_parallel[i] = parallel;
  if (parallel) {
    points.s = (low + high) / 2;
    points.t = place_on(a + points.s * e, b, b + f);
    points.distance = length(a + points.s * e - b - points.t * f);
  }
  out->first_feature[i] = parallel ? uint8_t(OGC_EDGE_INTERIOR) : feature(points.s);
  out->second_feature[i] = parallel ? uint8_t(OGC_EDGE_INTERIOR) : feature(points.t);
  out->parameters[i][0] = float(points.s), out->parameters[i][1] = float(points.t);
  out->contact_distance[i] = float(points.distance);
}

}  // namespace

int ogc_closest_points(const ogc_closest_points_in* in, ogc_closest_points_out* out) {
  for (int64_t i = 0; i < in->n; ++i) answer(in, i, out);
  return 0;
}
