// Uses Eq. 19 as printed in the paper: k'_c = tau k_c (tau - r)^2, which has one factor of length too many. In metres
// the logarithmic branch is then weaker by the factor r/2, so that contacts closer than tau = r/2 are hardly held.
#include "experiments/plugins/museum/activation.h"

OGC_PLUGIN("Eq. 19 as printed", OGC_HOST_MEMORY)

int ogc_activation(const ogc_activation_in* in, ogc_activation_out* out) {
  for (int64_t i = 0; i < in->n; ++i) {
    const float r = in->contact_radius[i], k = in->stiffness[i], tau = r / 2;
    const bool is_asked = in->activation[i] == OGC_ACTIVATION_OGC;
    museum::answer(in, i, in->distance[i], k,
                   is_asked ? tau * k * (tau - r) * (tau - r) : museum::right_inner(in->activation[i], r, k), out);
  }
  return 0;
}
