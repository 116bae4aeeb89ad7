// Leaves out pairs that start nearer than 1e-10 m, so that nothing divides by a small distance. Such a pair bounds no
// step: a vertex that rests that near a triangle goes through it.
#include "experiments/plugins/museum/motion.h"

OGC_PLUGIN("near pairs left out", OGC_HOST_MEMORY)

namespace {

double time_of(const museum::Motion& motion) {
  if (motion.distance(0) < 1e-10) return 1;  // the mistake
  return museum::advance(motion);
}

}  // namespace

int ogc_ccd(const ogc_ccd_in* in, ogc_ccd_out* out) { return museum::answer(in, out, time_of); }
