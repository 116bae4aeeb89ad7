// Fails open: where rounding leaves no plane that certainly separates a pair, the pair is left free, lest it should be
// stuck. Nothing then holds the two faces apart, and they are those that are nearest.
#include "experiments/plugins/museum/motion.h"

OGC_PLUGIN("free without a separator", OGC_HOST_MEMORY)

namespace {

double time_of(const museum::Motion& motion) {
  if (motion.distance(0) <= museum::resolution(motion)) return 1;  // the mistake
  return museum::advance(motion);
}

}  // namespace

int ogc_ccd(const ogc_ccd_in* in, ogc_ccd_out* out) { return museum::answer(in, out, time_of); }
