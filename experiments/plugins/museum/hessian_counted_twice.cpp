// Counts the Hessian twice: adds the block at the beginning of the solve and again at its end, but the force only once.
// Updates are half as long and convergence is slow; nothing else shows the mistake.
#include "experiments/plugins/museum/spring.h"

OGC_PLUGIN("Hessian counted twice", OGC_HOST_MEMORY)

int ogc_spring(const ogc_spring_in* in, ogc_force_out* out) {
  for (int64_t i = 0; i < in->n; ++i)
    museum::answer(in->cases[i], in->cases[i].damping, 2, out->force[i], out->block[i]);
  return 0;
}
