// What every energy adds to for one vertex: its force and its symmetric 3×3 block (Alg. 4). Nine numbers, so that a team adds it lane by lane.
#pragma once

#include "fast/kernels/qualifiers.hpp"
#include "fast/kernels/rounding.hpp"
#include "fast/kernels/vector.hpp"

namespace ogc::fast {

/// Symmetric 3×3 [N/m].
struct Symmetric3 {
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
};

struct ForceAndBlock {
  Vec force{};       ///< −∂E/∂x_v [N]
  Symmetric3 block{};  ///< approximation of ∂²E/∂x_v², positive semidefinite [N/m]

  OGC_HD void add_force(float scale, const Vec& direction) { force = force + scale * direction; }

  /// block += scale · a aᵀ
  OGC_HD void add_outer(float scale, const Vec& a) {
    const Vec b = scale * a;
    block.xx += b.x * a.x;
    block.xy += b.x * a.y;
    block.xz += b.x * a.z;
    block.yy += b.y * a.y;
    block.yz += b.y * a.z;
    block.zz += b.z * a.z;
  }

  /// block += scale · I
  OGC_HD void add_identity(float scale) {
    block.xx += scale;
    block.yy += scale;
    block.zz += scale;
  }

  /// Rounded by itself: with a product of the other's computation contracted into it, the bits would depend on where that is computed.
  OGC_HD ForceAndBlock& operator+=(const ForceAndBlock& other) {
    force = {add(force.x, other.force.x), add(force.y, other.force.y), add(force.z, other.force.z)};
    block.xx = add(block.xx, other.block.xx);
    block.xy = add(block.xy, other.block.xy);
    block.xz = add(block.xz, other.block.xz);
    block.yy = add(block.yy, other.block.yy);
    block.yz = add(block.yz, other.block.yz);
    block.zz = add(block.zz, other.block.zz);
    return *this;
  }
};

}  // namespace ogc::fast
