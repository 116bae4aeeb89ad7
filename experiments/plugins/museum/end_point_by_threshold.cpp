// Compares squared lengths with an absolute epsilon that is meant for parallel edges. Every edge shorter than 3.2 mm is
// therefore reduced to its first end. Distances come out too large, and contacts of fine meshes are missed.
#include "experiments/plugins/museum/edges.h"

OGC_PLUGIN("end point by an absolute threshold", OGC_HOST_MEMORY)

namespace {

using namespace museum;

constexpr double epsilon = 1e-5;

uint8_t feature(double place) { return place <= 0 ? OGC_END_0 : place >= 1 ? OGC_END_1 : OGC_EDGE_INTERIOR; }

void answer(const ogc_closest_points_in* in, int64_t i, ogc_closest_points_out* out) {
  const Vec a = vec(in->first[i][0]), b = vec(in->second[i][0]);
  Edges edges{a, vec(in->first[i][1]) - a, b, vec(in->second[i][1]) - b};
  const double size = length(edges.e) + length(edges.f) + length(b - a);
  if (dot(edges.e, edges.e) < epsilon) edges.e = {0, 0, 0};  // the mistake
  if (dot(edges.f, edges.f) < epsilon) edges.f = {0, 0, 0};
  Places places = closest(edges);
  out->distance_below[i] = below(places.distance, size);
  const bool parallel = nearly_parallel(edges);
  out->nearly_parallel[i] = parallel;
  if (parallel) places = middle(edges);
  out->first_feature[i] = parallel ? uint8_t(OGC_EDGE_INTERIOR) : feature(places.s);
  out->second_feature[i] = parallel ? uint8_t(OGC_EDGE_INTERIOR) : feature(places.t);
  out->parameters[i][0] = float(places.s), out->parameters[i][1] = float(places.t);
  out->contact_distance[i] = float(places.distance);
}

}  // namespace

int ogc_closest_points(const ogc_closest_points_in* in, ogc_closest_points_out* out) {
  for (int64_t i = 0; i < in->n; ++i) answer(in, i, out);
  return 0;
}
