// A correct plug-in on the host: the contact energy over distance (Eq. 18 to 20), in single precision throughout.
//
//   g++ -O2 -shared -fPIC -I INCLUDE activation.cpp -o activation.so
//   ogc compare activation --plugin ./activation.so
//
// INCLUDE is the root of the source tree, or include/ogc below the place where the library is installed.
#include <cmath>

#include "compare/plugin.h"

OGC_PLUGIN("activation example", OGC_HOST_MEMORY)

int ogc_activation(const ogc_activation_in* in, ogc_activation_out* out) {
  for (int64_t i = 0; i < in->n; ++i) {
    const float d = in->distance[i], r = in->contact_radius[i], k = in->stiffness[i], tau = 0.5f * r;
    if (d >= r) {
      out->energy[i] = out->slope[i] = out->curvature[i] = 0;
    } else if (d >= tau) {  // the quadratic part holds at d = tau, too
      out->energy[i] = 0.5f * k * (r - d) * (r - d);
      out->slope[i] = -k * (r - d);
      out->curvature[i] = k;
    } else {
      const float inner = tau * k * (r - tau);
      out->energy[i] = 0.5f * k * (r - tau) * (r - tau) + inner * std::log(tau / d);
      out->slope[i] = -inner / d;
      out->curvature[i] = inner / d / d;  // d squared could underflow
    }
  }
  return 0;
}
