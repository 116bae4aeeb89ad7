// Declares the contestant and the fault of the plug-in that offers the fast path's kernels. The environment variable
// OGC_BROKEN names the fault.
#pragma once

#include <cstdlib>
#include <string_view>

#include "compare/plugin.h"
#include "fast/contestant.hpp"

namespace ogc::tests {

inline const compare::Contestant& ours() {
  static const compare::Contestant contestant = fast::contestant(fast::Backend::cpu);
  return contestant;
}

inline bool breaks(std::string_view how) {
  const char* const wanted = std::getenv("OGC_BROKEN");
  return wanted && how == wanted;
}

inline compare::Vec3f point(const ogc_vec3& p) { return {p.x, p.y, p.z}; }

}  // namespace ogc::tests
