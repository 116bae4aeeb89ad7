// The projection onto the tangent plane starts from a matrix full of ones, not from the identity: friction's block gets
// entries off its diagonal that pull a vertex along the normal, and need not be positive definite.
#include "experiments/plugins/museum/friction.h"

OGC_PLUGIN("ones in place of the identity", OGC_HOST_MEMORY)

int ogc_friction_force(const ogc_friction_force_in* in, ogc_force_out* out) {
  const double off_diagonal = 1;  // the mistake
  for (int64_t i = 0; i < in->n; ++i) museum::answer(in->cases[i], off_diagonal, out->force[i], out->block[i]);
  return 0;
}
