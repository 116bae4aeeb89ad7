// The correct lagged friction of a contact, in double. An exhibit of the museum (a plug-in with one deliberate mistake)
// includes this file and changes one thing.
#ifndef OGC_MUSEUM_FRICTION_H
#define OGC_MUSEUM_FRICTION_H

#include "experiments/plugins/museum/edges.h"
#include "experiments/plugins/museum/triangle.h"

namespace museum {

inline Edges edges_of(const ogc_vec3* x) {
  return {vec(x[0]), vec(x[1]) - vec(x[0]), vec(x[2]), vec(x[3]) - vec(x[2])};
}

// Weights by vertex, positive on the first side of the contact and negative on the second.
struct Sides {
  double of[4] = {1, 0, 0, 0};
};
inline Sides sides(const ogc_contact_force_case& c) {
  const Vec x[4] = {vec(c.vertex[0]), vec(c.vertex[1]), vec(c.vertex[2]), vec(c.vertex[3])};
  if (c.sides == OGC_POINT_POINT) return {{1, -1, 0, 0}};
  if (c.sides == OGC_POINT_EDGE) {
    const double t = place_on(x[0], x[1], x[2]);
    return {{1, t - 1, -t, 0}};
  }
  if (c.sides == OGC_POINT_TRIANGLE) {
    const Weights w = closest(x[0], x + 1);
    return {{1, -w.of[0], -w.of[1], -w.of[2]}};
  }
  const Edges edges = edges_of(c.vertex);
  const Places at = nearly_parallel(edges) ? middle(edges) : closest(edges);
  return {{1 - at.s, at.s, at.t - 1, -at.t}};
}

// Returns the mollifier e_k, computed from the edges at the last detection; 1 if the contact is not edge-edge.
inline double energy_share(const ogc_contact_force_case& c) {
  if (c.sides != OGC_EDGE_EDGE) return 1;
  const Edges edges = edges_of(c.previous);
  if (c.rest_squared[0] > 0 && c.rest_squared[1] > 0) {
    const double q = dot(cross(edges.e, edges.f), cross(edges.e, edges.f)) /
                     (1e-3 * double(c.rest_squared[0]) * c.rest_squared[1]);
    return q < 1 ? q * (2 - q) : 1;
  }
  if (c.rest_squared[0] != 0 || c.rest_squared[1] != 0 || !nearly_parallel(edges)) return 1;
  const Overlap shared = overlap(edges);
  const double e = length(edges.e);
  return (shared.high - shared.low) * e / std::min(e, length(edges.f));
}

// Returns -g'(d) of any activation.
inline double push(const ogc_contact_force_case& c, double d) {
  const double r = c.contact_radius, k = c.stiffness, tau = r / 2, depth = r - d;
  if (!(d < r)) return 0;
  switch (c.activation) {
    case OGC_ACTIVATION_QUADRATIC: return k * depth;
    case OGC_ACTIVATION_IPC_LOG: return k * depth * (2 * std::log1p(depth / d) + depth / d);
    case OGC_ACTIVATION_CUBIC: return 2 * k / r * depth * depth;
    case OGC_ACTIVATION_OGC_AS_PRINTED: return d < tau ? tau * k * (tau - r) * (tau - r) / d : k * depth;
    default: return d < tau ? tau * k * (r - tau) / d : k * depth;
  }
}

// Writes the answer. `off_diagonal` replaces the zeros of the identity in the projection I - n nT.
inline void answer(const ogc_friction_force_case& c, double off_diagonal, ogc_vec3& force, float* block) {
  const ogc_contact_force_case& contact = c.contact;
  const int count = contact.sides == OGC_POINT_POINT ? 2 : contact.sides == OGC_POINT_EDGE ? 3 : 4;
  const Sides w = sides(contact);
  Vec gap{0, 0, 0}, slip{0, 0, 0};
  double together = 0;
  for (int m = 0; m < count; ++m) {
    gap = gap + w.of[m] * vec(contact.vertex[m]);
    slip = slip + w.of[m] * (vec(contact.vertex[m]) - vec(c.start[m]));
    if (m == contact.own || (contact.together >> m & 1)) together += std::abs(w.of[m]);
  }
  const double d = length(gap);
  const Vec n = d > 0 ? 1 / d * gap : Vec{0, 0, 0};
  slip = slip - dot(slip, n) * n;
  const double y = length(slip), limit = c.slip_limit,
               over_slip = y < limit ? (2 - y / limit) / limit : 1 / y;  // f1(y) / y
  const double acting = std::max(d, 0x1p-23 * contact.contact_radius);
  const double pressed = d > 0 ? energy_share(contact) * push(contact, acting) : 0;
  const double strength = c.friction * pressed * over_slip, own = w.of[contact.own];
  const Vec pull = -strength * own * slip;
  force = {float(pull.x), float(pull.y), float(pull.z)};
  const double q = strength * std::abs(own) * together, o = off_diagonal;
  const double all[6] = {1 - n.x * n.x, o - n.x * n.y, o - n.x * n.z, 1 - n.y * n.y, o - n.y * n.z, 1 - n.z * n.z};
  for (int m = 0; m < 6; ++m) block[m] = float(q * all[m]);
}

}  // namespace museum

#endif
