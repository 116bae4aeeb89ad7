// A Hessian counted twice: the block is added at the top of the solve and once more at the bottom, the force once.
// Steps come out half as long, convergence is slow, and nothing else shows it.
#include "experiments/plugins/museum/spring.h"

OGC_PLUGIN("Hessian counted twice", OGC_HOST_MEMORY)

int ogc_spring(const ogc_spring_in* in, ogc_force_out* out) {
  for (int64_t i = 0; i < in->n; ++i)
    museum::answer(in->cases[i], in->cases[i].damping, 2, out->force[i], out->block[i]);
  return 0;
}
