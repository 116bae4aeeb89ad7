// Adds damping by vertex: k_d/h times an element's block at the vertex, times the vertex's motion since the start of
// the step (method.md §4.9). The other DampingForm, damping of strains, is computed by each model.
#pragma once

#include "fast/kernels/arithmetic/accumulator.hpp"
#include "fast/kernels/arithmetic/qualifiers.hpp"
#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// Adds an element's elastic force and block B, with damping by vertex. With k = `damping` = k_d/h, it adds the force
/// minus k B `moved`, and the block (1 + k) B.
OGC_HD inline void add_damped_by_vertex(const ForceAndBlock& elastic, float damping, const Vec& moved,
                                        ForceAndBlock& sum) {
  const Symmetric3& b = elastic.block;
  const Vec resisted{b.xx * moved.x + b.xy * moved.y + b.xz * moved.z, b.xy * moved.x + b.yy * moved.y + b.yz * moved.z,
                     b.xz * moved.x + b.yz * moved.y + b.zz * moved.z};
  const float grown = 1.0f + damping;
  sum += ForceAndBlock{elastic.force - damping * resisted,
                       {grown * b.xx, grown * b.xy, grown * b.xz, grown * b.yy, grown * b.yz, grown * b.zz}};
}

}  // namespace ogc::fast
