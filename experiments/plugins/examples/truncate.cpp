// A plug-in that is subtly wrong. Truncation scales a displacement down to its bound in five lines that are found in
// many codes. The last bit of the stored position may place the vertex outside its ball, so that the step is no longer
// proven free of penetration. The judge finds the mistake within a second; experiments/plugins/README.md corrects it.
//
//   g++ -O2 -shared -fPIC -I INCLUDE truncate.cpp -o truncate.so
//   ogc compare truncate --plugin ./truncate.so
#include <cmath>

#include "compare/plugin.h"

OGC_PLUGIN("truncate example", OGC_HOST_MEMORY)

int ogc_truncate(const ogc_truncate_in* in, ogc_truncate_out* out) {
  for (int64_t i = 0; i < in->n; ++i) {
    const ogc_vec3 p = in->previous[i], x = in->position[i];
    const float dx = x.x - p.x, dy = x.y - p.y, dz = x.z - p.z;
    const float length = std::sqrt(dx * dx + dy * dy + dz * dz);
    out->position[i] = x;
    out->cut[i] = length > in->bound[i];
    if (length <= in->bound[i]) continue;
    const float scale = in->bound[i] / length;
    out->position[i] = {p.x + scale * dx, p.y + scale * dy, p.z + scale * dz};
  }
  return 0;
}
