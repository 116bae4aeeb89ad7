// Returns a barrier that is twice too stiff: each side of a contact adds the force of the whole pair, so that the pair
// acts twice. A simulation of a single pair still looks right.
#include "experiments/plugins/museum/activation.h"

OGC_PLUGIN("barrier twice too stiff", OGC_HOST_MEMORY)

int ogc_activation(const ogc_activation_in* in, ogc_activation_out* out) {
  for (int64_t i = 0; i < in->n; ++i) {
    const float r = in->contact_radius[i], k = 2 * in->stiffness[i];
    museum::answer(in, i, in->distance[i], k, museum::right_inner(in->activation[i], r, k), out);
  }
  return 0;
}
