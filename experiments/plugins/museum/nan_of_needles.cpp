// Divides weights by an area that may be 0. The weights are then NaN, and the test for weights below 0 accepts NaN.
// Triangles whose corners lie on one line, or nearly so, pass NaN on to all their contacts.
#include "experiments/plugins/museum/triangle.h"

OGC_PLUGIN("weights over an area of 0", OGC_HOST_MEMORY)

namespace {

using namespace museum;

Weights weights(Vec p, const Vec* t) {
  const Weights w = foot(p, t);
  const bool outside = w.of[0] <= 0 || w.of[1] <= 0 || w.of[2] <= 0;  // the mistake
  return outside ? on_nearest_edge(p, t, w) : w;
}

}  // namespace

int ogc_closest_face(const ogc_closest_face_in* in, ogc_closest_face_out* out) { return answer(in, out, weights); }
