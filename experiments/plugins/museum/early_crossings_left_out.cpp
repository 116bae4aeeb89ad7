// Takes a crossing before 1e-10 of the step for one that lies behind, as of a vertex that lies on a plane and goes away
// from it. A vertex that goes through the plane has the same time.
#include "experiments/plugins/museum/motion.h"

OGC_PLUGIN("early crossings left out", OGC_HOST_MEMORY)

namespace {

double time_of(const museum::Motion& motion) {
  const double t = museum::advance(motion);
  return t < 1e-10 ? 1 : t;  // the mistake
}

}  // namespace

int ogc_ccd(const ogc_ccd_in* in, ogc_ccd_out* out) { return museum::answer(in, out, time_of); }
