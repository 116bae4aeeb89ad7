// Computes the rest data of one triangle, one hinge and one tetrahedron. They are computed in double and stored in
// single precision, so that the sweep reads correctly rounded values.
#pragma once

#include <cmath>

#include "compare/problem/vector.hpp"

namespace ogc::fast {

/// A vector of the rest shape, in double.
struct RestVector {
  double x, y, z;  ///< [m]
};

inline RestVector rest_difference(const compare::Vec3& a, const compare::Vec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline double rest_dot(const RestVector& a, const RestVector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double rest_length(const RestVector& a) { return std::sqrt(rest_dot(a, a)); }
inline RestVector rest_cross(const RestVector& a, const RestVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Holds the area of a rest triangle, and the gradients ∇N_k of its three linear shape functions in an orthonormal
/// frame of its plane: F = Σ x_k ∇N_kᵀ (3×2).
struct RestTriangle {
  double area = 0;             ///< A [m²]
  double gradient[3][2] = {};  ///< ∇N_k by corner [1/m]
};

/// Returns the rest data of a triangle. Its area must not be 0; validate refuses other triangles.
inline RestTriangle rest_triangle(const compare::Vec3& p0, const compare::Vec3& p1, const compare::Vec3& p2) {
  const RestVector first = rest_difference(p1, p0), second = rest_difference(p2, p0);
  const double length = rest_length(first), twice_area = rest_length(rest_cross(first, second));
  const double along = rest_dot(first, second) / length, height = twice_area / length;
  RestTriangle rest;
  rest.area = twice_area / 2;
  rest.gradient[1][0] = 1 / length;
  rest.gradient[1][1] = -along / (length * height);
  rest.gradient[2][0] = 0;
  rest.gradient[2][1] = 1 / height;
  for (int axis = 0; axis < 2; ++axis) rest.gradient[0][axis] = -(rest.gradient[1][axis] + rest.gradient[2][axis]);
  return rest;
}

/// Holds the volume of a tetrahedron at rest, and the gradients of its four linear shape functions N_k.
struct RestTetrahedron {
  double volume = 0;            ///< V [m³]
  RestVector gradient[4] = {};  ///< ∇N_k by corner [1/m]
  double weight[6] = {};        ///< V ∇N_k·∇N_l of the pairs 01, 02, 03, 12, 13, 23 [m]
};

/// Returns the rest data of a tetrahedron. Its volume must be positive; validate refuses other tetrahedra. ∇N_k =
/// n_k/(6V), where n_k points inward and has twice the area of the face opposite corner k.
inline RestTetrahedron rest_tetrahedron(const compare::Vec3& p0, const compare::Vec3& p1, const compare::Vec3& p2,
                                        const compare::Vec3& p3) {
  const RestVector a = rest_difference(p1, p0), b = rest_difference(p2, p0), c = rest_difference(p3, p0),
                   ab = rest_difference(p2, p1), ac = rest_difference(p3, p1);
  const RestVector inward[4] = {rest_cross(ac, ab), rest_cross(b, c), rest_cross(c, a), rest_cross(a, b)};
  const double six_volumes = rest_dot(a, inward[1]);
  RestTetrahedron rest;
  rest.volume = six_volumes / 6;
  for (int k = 0, i = 0; k < 4; ++k) {
    rest.gradient[k] = {inward[k].x / six_volumes, inward[k].y / six_volumes, inward[k].z / six_volumes};
    for (int l = k + 1; l < 4; ++l, ++i) rest.weight[i] = rest_dot(inward[k], inward[l]) / (6 * six_volumes);
  }
  return rest;
}

/// Holds the rest data of a hinge with the edge e = x1 − x0. θ₀ is the angle between the triangles (x0, x1, o0) and
/// (x1, x0, o1) in [−π, π]; 0 if they are flat. The weights of x1, o0 and o1 in the isometric model are, up to sign,
/// sums of the cotangents of the angles at x0 and x1, divided by ‖e‖.
struct RestHinge {
  double angle = 0, factor = 0;  ///< θ₀ [rad], 3‖e‖²/(A₀ + A₁) [1]
  double weight[3] = {};         ///< of x1, o0, o1 [1/m]
};

/// Returns the rest data of a hinge. θ₀ is negative if (x1 − x0) × (o0 − x0) points to the side on which o1 lies, as in
/// fast/kernels/models/discrete_hinge.hpp.
inline RestHinge rest_hinge(const compare::Vec3& x0, const compare::Vec3& x1, const compare::Vec3& o0,
                            const compare::Vec3& o1) {
  const RestVector edge = rest_difference(x1, x0), a = rest_difference(o0, x0), b = rest_difference(o1, x0);
  const RestVector normal_a = rest_cross(edge, a), normal_b = rest_cross(b, edge);
  RestHinge rest;
  rest.angle = std::atan2(-rest_length(edge) * rest_dot(normal_a, b), rest_dot(normal_a, normal_b));
  const double length = rest_length(edge), area_a = rest_length(normal_a), area_b = rest_length(normal_b);
  rest.factor = 6 * rest_dot(edge, edge) / (area_a + area_b);
  rest.weight[0] = (rest_dot(edge, a) / area_a + rest_dot(edge, b) / area_b) / length;
  rest.weight[1] = -length / area_a;
  rest.weight[2] = -length / area_b;
  return rest;
}

}  // namespace ogc::fast
