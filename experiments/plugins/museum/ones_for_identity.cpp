// Computes the projection onto the tangent plane from a matrix full of ones, not from the identity. Friction's block
// then has wrong off-diagonal entries, which pull a vertex along the normal and may make the block indefinite.
#include "experiments/plugins/museum/friction.h"

OGC_PLUGIN("ones in place of the identity", OGC_HOST_MEMORY)

int ogc_friction_force(const ogc_friction_force_in* in, ogc_force_out* out) {
  const double off_diagonal = 1;  // the mistake
  for (int64_t i = 0; i < in->n; ++i) museum::answer(in->cases[i], off_diagonal, out->force[i], out->block[i]);
  return 0;
}
