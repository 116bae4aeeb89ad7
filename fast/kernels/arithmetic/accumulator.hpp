// Holds the sum of all forces on one vertex and of their symmetric 3×3 blocks (Alg. 4). Each team lane has its own sum.
#pragma once

#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/rounding.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// A symmetric 3×3 matrix [N/m].
template <class T>
struct Symmetric3Of {
  T xx{}, xy{}, xz{}, yy{}, yz{}, zz{};  ///< the upper triangle, row by row
};
using Symmetric3 = Symmetric3Of<float>;

/// Holds the force and the block of one vertex.
template <class T>
struct ForceAndBlockOf {
  Vector<T> force{};        ///< −∂E/∂x_v [N]
  Symmetric3Of<T> block{};  ///< approximation of ∂²E/∂x_v², positive semidefinite [N/m]

  /// force += scale · direction
  OGC_HD void add_force(const T& scale, const Vector<T>& direction) { force = force + scale * direction; }

  /// block += scale · a aᵀ
  OGC_HD void add_outer(const T& scale, const Vector<T>& a) {
    const Vector<T> b = scale * a;
    block.xx = block.xx + b.x * a.x;
    block.xy = block.xy + b.x * a.y;
    block.xz = block.xz + b.x * a.z;
    block.yy = block.yy + b.y * a.y;
    block.yz = block.yz + b.y * a.z;
    block.zz = block.zz + b.z * a.z;
  }

  /// block += scale · I
  OGC_HD void add_identity(const T& scale) {
    block.xx = block.xx + scale;
    block.yy = block.yy + scale;
    block.zz = block.zz + scale;
  }

  /// Adds another sum. Each addition is rounded separately. Otherwise a compiler might contract an addition with a
  /// product that gave `other`, and the bits would depend on this choice.
  OGC_HD ForceAndBlockOf& operator+=(const ForceAndBlockOf& other) {
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
using ForceAndBlock = ForceAndBlockOf<float>;

/// Calls add(sum) if the condition holds. fast/cpu/packed_items.hpp has the overload for several numbers side by side.
template <class Add>
OGC_HD void add_where(bool condition, ForceAndBlock& sum, Add add) {
  if (condition) add(sum);
}

}  // namespace ogc::fast
