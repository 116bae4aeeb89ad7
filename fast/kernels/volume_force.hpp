// Adds the force and block of a contact with a volume. The detection froze the weights of the triangle's point c and
// the unit direction n out of the volume (§3.9, method.md §9). With φ = n·(x₀ − c), the energy E = k/2 max(0, r − φ)²
// is quadratic in the depth, and its block k w² n nᵀ is exact. Whether the point is inside is decided only at
// detections.
#pragma once

#include "fast/kernels/friction_force.hpp"

namespace ogc::fast {

/// Holds the data of one contact that do not change until the next detection.
struct VolumeContact {
  float weights[3] = {};              ///< weights of c, by corner [1]
  Vec normal;                         ///< n [1]
  float stiffness = 0, friction = 0;  ///< k [N/m], μ [1]

  /// Returns the weight w of a vertex: 1 for the point (role 0), −wᵢ for the corners (roles 1, 2, 3).
  OGC_HD float weight(int role) const {
    return role == 0 ? 1.0f : role == 1 ? -weights[0] : role == 2 ? -weights[1] : -weights[2];
  }
};

/// Returns x₀ − c = Σ wᵢ (x₀ − xᵢ) [m] of the point x[0] and the corners x[1], x[2], x[3].
OGC_HD inline Vec volume_separation(const VolumeContact& contact, const Vec* x) {
  return contact.weights[0] * (x[0] - x[1]) + contact.weights[1] * (x[0] - x[2]) + contact.weights[2] * (x[0] - x[3]);
}

/// Returns the motion of the point relative to c since the start of the step: x₀ − x₀ᵗ − Σ wᵢ (xᵢ − xᵢᵗ) [m].
OGC_HD inline Vec volume_motion(const VolumeContact& contact, const Vec* x, const Vec* start) {
  return (x[0] - start[0]) - contact.weights[0] * (x[1] - start[1]) - contact.weights[1] * (x[2] - start[2]) -
         contact.weights[2] * (x[3] - start[3]);
}

/// Adds the normal force, friction and block of a contact on its vertex with role `role`; adds nothing if φ ≥ r.
/// `slip_limit` is ε_v h [m]. Bit k of `together` is set if another vertex, of role k, is solved at the same time. The
/// block then has |w| Σ |w_u| in place of w², with the sum over all vertices u that are solved together (method.md
/// §7.4). Returns λ = k (r − φ) [N]; 0 if the contact exerts no force.
OGC_HD inline float add_volume_contact(const VolumeContact& contact, const Vec* x, const Vec* start, int role,
                                       float contact_radius, float slip_limit, ForceAndBlock& sum, int together = 0) {
  const float depth = contact_radius - dot(contact.normal, volume_separation(contact, x));
  if (!(depth > 0)) return 0.0f;
  const float weight = contact.weight(role), normal_force = contact.stiffness * depth;
  float weights = fabsf(weight);
  for (int k = 0; k < 4; ++k) weights += (together >> k & 1) != 0 ? fabsf(contact.weight(k)) : 0.0f;
  const float square = fabsf(weight) * weights;
  sum.add_force(normal_force * weight, contact.normal);
  sum.add_outer(contact.stiffness * square, contact.normal);
  add_friction<float>(contact.normal, volume_motion(contact, x, start), weight, square, contact.friction, normal_force,
                      slip_limit, sum);
  return normal_force;
}

}  // namespace ogc::fast
