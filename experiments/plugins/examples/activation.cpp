// A correct plug-in on the host: contact energies as functions of distance (Eq. 18 to 20, and variants), in single
// precision throughout.
//
//   g++ -O2 -shared -fPIC -I INCLUDE activation.cpp -o activation.so
//   ogc compare activation --plugin ./activation.so
//
// INCLUDE is the root of the source tree, or include/ogc below the place where the library is installed.
#include <cmath>

#include "compare/plugin.h"

OGC_PLUGIN("activation example", OGC_HOST_MEMORY)

namespace {

// Holds g, g' and g'' of one case; d < r.
struct Activation {
  float energy, slope, curvature;
};

// Returns the activation of Eq. 18 with its two branches; `inner` is k'_c. At d = tau the quadratic branch holds. No
// term squares d, because d squared could underflow.
Activation two_stages(float d, float r, float k, float tau, float inner) {
  if (d >= tau) return {0.5f * k * (r - d) * (r - d), -k * (r - d), k};
  return {0.5f * k * (r - tau) * (r - tau) + inner * std::log(tau / d), -inner / d, inner / d / d};
}

Activation activation_at(int64_t kind, float d, float r, float k) {
  const float tau = 0.5f * r, depth = r - d, share = depth / d, slope = 2 * k / r;
  switch (kind) {
    case OGC_ACTIVATION_OGC_AS_PRINTED: return two_stages(d, r, k, tau, tau * k * (tau - r) * (tau - r));
    case OGC_ACTIVATION_QUADRATIC: return {0.5f * k * depth * depth, -k * depth, k};
    case OGC_ACTIVATION_IPC_LOG: {  // log1p, because r/d approaches 1
      const float log = std::log1p(share);
      return {k * depth * (depth * log), -k * depth * (2 * log + share), k * (2 * log + share * (4 + share))};
    }
    case OGC_ACTIVATION_CUBIC: return {slope / 3 * depth * depth * depth, -slope * depth * depth, 2 * slope * depth};
    default: return two_stages(d, r, k, tau, tau * k * (r - tau));
  }
}

}  // namespace

int ogc_activation(const ogc_activation_in* in, ogc_activation_out* out) {
  for (int64_t i = 0; i < in->n; ++i) {
    const float d = in->distance[i], r = in->contact_radius[i];
    const Activation g = d < r ? activation_at(in->activation[i], d, r, in->stiffness[i]) : Activation{};
    out->energy[i] = g.energy;
    out->slope[i] = g.slope;
    out->curvature[i] = g.curvature;
  }
  return 0;
}
