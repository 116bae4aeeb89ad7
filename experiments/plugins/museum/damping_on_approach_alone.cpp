// Damps only while the two ends approach each other, not while they move apart. So only half of each oscillation is
// damped.
#include "experiments/plugins/museum/spring.h"

OGC_PLUGIN("damping on approach alone", OGC_HOST_MEMORY)

int ogc_spring(const ogc_spring_in* in, ogc_force_out* out) {
  for (int64_t i = 0; i < in->n; ++i) {
    const ogc_spring_case& c = in->cases[i];
    const museum::Apart now(c.vertex, c.ratio), start(c.start, c.ratio);
    museum::answer(c, now.length < start.length ? c.damping : 0, 1, out->force[i], out->block[i]);
  }
  return 0;
}
