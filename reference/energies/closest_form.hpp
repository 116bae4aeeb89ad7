// Computes the contact points of two closed faces in double precision; their distance may have any number type.
// Newton's positions are doubles between two detections, so the exact predicates of reference/geometry do not apply.
// They are not needed either: the distance and its slope are continuous across the features.
#pragma once

#include <array>
#include <cstdint>

#include "compare/stages/contact_force.hpp"
#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// Selects the features that hold the contact points. Each comment lists the indices in ClosestForm::at of the first
/// side's vertices, then of the second side's vertices.
enum class FormKind : std::uint8_t {
  points,        ///< 0, 1
  point_line,    ///< 0; 1 2
  point_plane,   ///< 0; 1 2 3
  lines,         ///< 0 1; 2 3
  fixed_weights  ///< nearly parallel edges: the points of method.md §1.4, with constant weights
};

/// The contact points of two faces. The first point is Σ w x over the positive weights, the second is −Σ w x over the
/// negative weights.
struct ClosestForm {
  FormKind kind = FormKind::points;  ///< features that hold the contact points
  std::array<std::uint8_t, 4> at{};  ///< vertices of the contact that the form uses, in the order of FormKind
  /// weights by vertex of the contact; the sum of a side's weights is 1 on the first side, −1 on the second
  std::array<double, 4> weight{};
};

/// Returns the closest points of a contact's two sides. A collapsed edge or triangle is replaced by the
/// lower-dimensional face that holds the closest point.
ClosestForm closest_form(compare::ContactSides sides, const std::array<Triple<double>, 4>& x);
/// Returns the closest points of two edges without the rule for nearly parallel edges; the kind is never
/// `fixed_weights`.
ClosestForm closest_edges(const std::array<Triple<double>, 4>& x);

/// Returns Σ w_i x_i, the vector from the second contact point to the first.
template <class Number, class T, std::size_t N>
Triple<T> separation(const std::array<Number, 4>& weight, const std::array<Triple<T>, N>& x) {
  Triple<T> sum = weight[0] * x[0];
  for (std::size_t k = 1; k < N; ++k) sum = sum + weight[k] * x[k];
  return sum;
}

/// Returns |h| for a height h along the normal n; `scaled` is h ‖n‖.
template <class T>
T height(const T& scaled, const Triple<T>& normal) {
  using std::sqrt;
  return sign_of(plain(scaled)) * scaled / sqrt(dot(normal, normal));
}

/// Returns the distance of the points, lines or planes that `form` selects [m].
template <class T, std::size_t N>
T form_distance(const ClosestForm& form, const std::array<Triple<T>, N>& x) {
  using std::sqrt;
  const auto at = [&](std::size_t place) -> const Triple<T>& { return x[form.at[place]]; };
  if (form.kind == FormKind::points) {
    const Triple<T> apart = at(0) - at(1);
    return sqrt(dot(apart, apart));
  }
  if (form.kind == FormKind::point_line) {
    const Triple<T> edge = at(2) - at(1), normal = cross(edge, at(0) - at(1));
    return sqrt(dot(normal, normal) / dot(edge, edge));
  }
  if (form.kind == FormKind::point_plane) {
    const Triple<T> normal = cross(at(2) - at(1), at(3) - at(1));
    return height(dot(normal, at(0) - at(1)), normal);
  }
  if (form.kind == FormKind::lines) {
    const Triple<T> normal = cross(at(1) - at(0), at(3) - at(2));
    return height(dot(normal, at(2) - at(0)), normal);
  }
  const Triple<T> apart = separation(form.weight, x);
  return sqrt(dot(apart, apart));
}

}  // namespace ogc::reference
