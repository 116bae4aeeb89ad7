// The correct contact energies over distance, as in ../examples/activation.cpp; the coefficient of the logarithm is a
// parameter. Exhibits of the museum (plug-ins with one deliberate mistake) include this file and change one thing.
#ifndef OGC_MUSEUM_ACTIVATION_H
#define OGC_MUSEUM_ACTIVATION_H

#include <cmath>

#include "compare/plugin.h"

namespace museum {

// Returns k'_c of the two activations that have two branches; the other activations do not read it.
inline float right_inner(int64_t activation, float r, float k) {
  const float depth = r - r / 2;
  return activation == OGC_ACTIVATION_OGC_AS_PRINTED ? r / 2 * k * depth * depth : r / 2 * k * depth;
}

// Writes g, g' and g'' of case i with this distance, stiffness and k'_c.
inline void answer(const ogc_activation_in* in, int64_t i, float d, float k, float inner, ogc_activation_out* out) {
  const float r = in->contact_radius[i], tau = r / 2, depth = r - d, share = depth / d;
  float energy = k * depth * depth / 2, slope = -k * depth, curvature = k;  // the quadratic branch
  switch (in->activation[i]) {
    case OGC_ACTIVATION_QUADRATIC: break;
    case OGC_ACTIVATION_IPC_LOG: {
      const float log = std::log1p(share);
      energy = k * depth * (depth * log), slope = -k * depth * (2 * log + share),
      curvature = k * (2 * log + share * (4 + share));
      break;
    }
    case OGC_ACTIVATION_CUBIC:
      energy = 2 * k / (3 * r) * depth * depth * depth, slope = -2 * k / r * depth * depth,
      curvature = 4 * k / r * depth;
      break;
    default:
      if (d >= tau) break;
      energy = k * (r - tau) * (r - tau) / 2 + inner * std::log(tau / d), slope = -inner / d, curvature = inner / d / d;
  }
  const bool acts = d < r;
  out->energy[i] = acts ? energy : 0;
  out->slope[i] = acts ? slope : 0;
  out->curvature[i] = acts ? curvature : 0;
}

}  // namespace museum

#endif
