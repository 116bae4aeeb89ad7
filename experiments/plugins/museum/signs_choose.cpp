// The number of positive weights chooses between corner and edge: a single positive weight selects its corner. At an
// obtuse corner an edge may be nearer. Distances then come out too large, and contacts get the wrong face.
#include "experiments/plugins/museum/triangle.h"

OGC_PLUGIN("signs of weights choose corner or edge", OGC_HOST_MEMORY)

namespace {

using namespace museum;

Weights weights(Vec p, const Vec* t) {
  const Weights w = foot(p, t);
  if (positive(w) == 1)  // the mistake
    return {{double(w.of[0] > 0), double(w.of[1] > 0), double(w.of[2] > 0)}};
  return positive(w) == 3 ? w : on_nearest_edge(p, t, w);
}

}  // namespace

int ogc_closest_face(const ogc_closest_face_in* in, ogc_closest_face_out* out) { return answer(in, out, weights); }
