// Raises distances below 1e-5 m to 1e-5 m, so that nothing divides by zero. Cloth with a contact radius of a centimetre
// never shows the mistake. A radius of 20 micrometres, or a mesh in other units, does.
#include <algorithm>

#include "experiments/plugins/museum/activation.h"

OGC_PLUGIN("absolute epsilon", OGC_HOST_MEMORY)

int ogc_activation(const ogc_activation_in* in, ogc_activation_out* out) {
  for (int64_t i = 0; i < in->n; ++i) {
    const float r = in->contact_radius[i], k = in->stiffness[i], d = std::max(in->distance[i], 1e-5f);
    museum::answer(in, i, d, k, museum::right_inner(in->activation[i], r, k), out);
  }
  return 0;
}
