// Where a vertex may be until the next detection (Eq. 21, 27): the one type that every kernel which truncates or
// certifies a position takes, so that another policy of truncation changes this file, truncate.hpp and certificate.hpp.
#pragma once

#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// A closed ball.
struct FeasibleRegion {
  Vec centre;        ///< X_prev [m]
  float radius = 0;  ///< b_v [m]
};

/// The regions of all vertices, as the last detection left them.
struct FeasibleRegions {
  const Vec* centre = nullptr;    ///< X_prev by vertex [m]
  const float* radius = nullptr;  ///< b_v by vertex [m]

  OGC_HD FeasibleRegion operator[](int v) const { return {centre[v], radius[v]}; }
};

}  // namespace ogc::fast
