// A three-dimensional set of directions d bounds the cone by planes n·d = 0, and each extreme ray lies on two of these
// planes. If the directions span only a plane or a line, the perpendicular line or plane belongs to the cone. The other
// generators then lie in the span.
#include "reference/definitions/normal_cone.hpp"

#include <algorithm>

namespace ogc::reference {
namespace {

Exact determinant(const ExactVector& a, const ExactVector& b, const ExactVector& c) { return dot(a, cross(b, c)); }

bool allowed(const ExactVector& n, std::span<const ExactVector> directions) {
  return std::all_of(directions.begin(), directions.end(),
                     [&](const ExactVector& d) { return sign_of(dot(n, d)) <= 0; });
}

bool same_ray(const ExactVector& a, const ExactVector& b) { return sign_of(dot(a, b)) > 0 && is_zero(cross(a, b)); }

ExactVector opposite(const ExactVector& a) { return times(Exact(-1), a); }

/// Returns a vector perpendicular to d ≠ 0.
ExactVector perpendicular(const ExactVector& d) {
  const ExactVector x{Exact(1), Exact(0), Exact(0)}, y{Exact(0), Exact(1), Exact(0)};
  const ExactVector n = cross(d, x);
  return is_zero(n) ? cross(d, y) : n;
}

bool on_two(const ExactVector& g, const ExactVector& h, const ExactVector& n) {
  const ExactVector m = cross(g, h);
  return !is_zero(m) && dot(m, n).is_zero() && sign_of(dot(cross(g, n), m)) >= 0 && sign_of(dot(cross(n, h), m)) >= 0;
}

bool on_three(const ExactVector& g, const ExactVector& h, const ExactVector& k, const ExactVector& n) {
  const int d = sign_of(determinant(g, h, k));
  if (d == 0) return false;
  return sign_of(determinant(n, h, k)) * d >= 0 && sign_of(determinant(g, n, k)) * d >= 0 &&
         sign_of(determinant(g, h, n)) * d >= 0;
}

/// Returns a direction that is not parallel to `first`, or nullptr.
const ExactVector* second_direction(const ExactVector& first, std::span<const ExactVector> directions) {
  const auto it = std::find_if(directions.begin(), directions.end(),
                               [&](const ExactVector& d) { return !is_zero(cross(first, d)); });
  return it == directions.end() ? nullptr : &*it;
}

bool spans_space(const ExactVector& normal, std::span<const ExactVector> directions) {
  return std::any_of(directions.begin(), directions.end(),
                     [&](const ExactVector& d) { return !dot(normal, d).is_zero(); });
}

}  // namespace

void NormalCone::add(const ExactVector& n, std::span<const ExactVector> directions) {
  if (is_zero(n) || !allowed(n, directions)) return;
  if (std::none_of(generators_.begin(), generators_.end(), [&](const ExactVector& g) { return same_ray(g, n); }))
    generators_.push_back(n);
}

NormalCone::NormalCone(std::span<const ExactVector> directions) {
  const auto both = [&](const ExactVector& n) {
    add(n, directions);
    add(opposite(n), directions);
  };
  const auto first = std::find_if(directions.begin(), directions.end(),
                                  [](const ExactVector& d) { return !is_zero(d); });
  if (first == directions.end()) {
    for (int axis = 0; axis < 3; ++axis) both({Exact(axis == 0), Exact(axis == 1), Exact(axis == 2)});
    lineality_ = 3;
    return;
  }
  const ExactVector* second = second_direction(*first, directions);
  if (second == nullptr) {
    const ExactVector u = perpendicular(*first);
    both(u);
    both(cross(*first, u));
    add(opposite(*first), directions);
    add(*first, directions);
    lineality_ = 2;
    return;
  }
  const ExactVector normal = cross(*first, *second);
  if (!spans_space(normal, directions)) {
    both(normal);
    for (const ExactVector& d : directions) both(cross(normal, d));
    lineality_ = 1;
    return;
  }
  for (std::size_t i = 0; i < directions.size(); ++i) {
    for (std::size_t j = i + 1; j < directions.size(); ++j) both(cross(directions[i], directions[j]));
  }
}

bool NormalCone::contains(const ExactVector& n) const {
  const auto& g = generators_;
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (same_ray(g[i], n)) return true;
    for (std::size_t j = i + 1; j < g.size(); ++j) {
      if (on_two(g[i], g[j], n)) return true;
    }
  }
  // A pointed cone is the union of the cones over its first generator and two others, so i = 0 suffices. A cone that
  // contains lines has few generators.
  const std::size_t roots = lineality_ == 0 ? std::min<std::size_t>(1, g.size()) : g.size();
  for (std::size_t i = 0; i < roots; ++i) {
    for (std::size_t j = i + 1; j < g.size(); ++j) {
      for (std::size_t k = j + 1; k < g.size(); ++k) {
        if (on_three(g[i], g[j], g[k], n)) return true;
      }
    }
  }
  return false;
}

std::vector<ExactVector> star_directions(const Complex& mesh, Face face, bool edge_only) {
  const auto own = mesh.vertices(face);
  const ExactVector origin = exact(mesh.at(own.items[0]));
  std::vector<ExactVector> directions;
  for (int k = 1; k < own.count; ++k) {
    const ExactVector d = exact(mesh.at(own.items[static_cast<std::size_t>(k)])) - origin;
    directions.push_back(d);
    directions.push_back(opposite(d));
  }
  const auto i = static_cast<std::size_t>(face.index);
  if (face.kind == FaceKind::vertex) {
    for (const Index v : mesh.topology.vertex_neighbours[i]) directions.push_back(exact(mesh.at(v)) - origin);
  } else if (face.kind == FaceKind::edge && !edge_only) {
    for (const Index v : mesh.topology.edge_opposite[i]) directions.push_back(exact(mesh.at(v)) - origin);
  }
  return directions;
}

}  // namespace ogc::reference
