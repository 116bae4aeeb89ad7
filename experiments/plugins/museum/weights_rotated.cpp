// Returns correct weights in the wrong order: for the corners 1, 2, 0 in place of 0, 1, 2. A quantity that is
// distributed by these weights, such as a force, goes to the wrong corners.
#include "experiments/plugins/museum/triangle.h"

OGC_PLUGIN("weights of the next corner", OGC_HOST_MEMORY)

int ogc_closest_face(const ogc_closest_face_in* in, ogc_closest_face_out* out) {
  museum::answer(in, out, museum::closest);
  for (int64_t i = 0; i < in->n; ++i) {
    float* w = out->weights[i];
    std::rotate(w, w + 1, w + 3);  // the mistake
  }
  return 0;
}
