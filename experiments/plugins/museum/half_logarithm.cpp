// Uses half of the logarithm's coefficient: k'_c = tau^2 k_c / 2. Slope and curvature then differ from those of the
// quadratic branch at tau = r/2. When a contact comes closer than tau, force and stiffness halve where they are needed
// most.
#include "experiments/plugins/museum/activation.h"

OGC_PLUGIN("half the coefficient of the logarithm", OGC_HOST_MEMORY)

int ogc_activation(const ogc_activation_in* in, ogc_activation_out* out) {
  for (int64_t i = 0; i < in->n; ++i) {
    const float r = in->contact_radius[i], k = in->stiffness[i], right = museum::right_inner(in->activation[i], r, k);
    museum::answer(in, i, in->distance[i], k, in->activation[i] == OGC_ACTIVATION_OGC ? right / 2 : right, out);
  }
  return 0;
}
