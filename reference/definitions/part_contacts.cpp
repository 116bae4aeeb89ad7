#include "reference/definitions/part_contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <tuple>

#include "reference/definitions/closed_surface.hpp"
#include "reference/definitions/normal_cone.hpp"
#include "reference/geometry/closest_face.hpp"

namespace ogc::reference {
namespace {

using compare::at;

/// Returns the nearest face of a part; of equally near faces the lowest by dimension, then by index.
Face nearest_face(const Complex& mesh, const std::vector<Index>& part, const Vec3f& x) {
  std::optional<std::pair<Face, Margin>> nearest;
  for (const Index t : part) {
    const Face face = closest_face_of(mesh, t, x);
    const Margin gap = face_gap(mesh, face, x, 0);
    const int order = nearest ? compare_distances(gap, nearest->second) : -1;
    if (order < 0 || (order == 0 && face < nearest->first)) nearest = {face, gap};
  }
  return nearest->first;
}

Index owner_of(const Complex& mesh, Face face) {
  if (face.kind == FaceKind::vertex) return mesh.topology.vertex_triangles[at(face.index)].front();
  return face.kind == FaceKind::edge ? mesh.triangles_of(face.index).front() : face.index;
}

std::array<double, 3> weights_of(const Complex& mesh, Index t, Face face, const Vec3f& x) {
  const compare::Triangle& corners = mesh.triangle(t);
  std::array<double, 3> weights{};
  if (face.kind == FaceKind::triangle) {
    const Vec3f &a = mesh.at(corners[0]), &b = mesh.at(corners[1]), &c = mesh.at(corners[2]);
    const std::array margins{side(b, c, a, x), side(c, a, b, x), side(a, b, c, x)};
    const std::vector<double> values = shares(margins);
    std::ranges::copy(values, weights.begin());
    return weights;
  }
  const auto place = [&](Index v) { return static_cast<std::size_t>(std::ranges::find(corners, v) - corners.begin()); };
  if (face.kind == FaceKind::vertex) {
    weights[place(face.index)] = 1;
    return weights;
  }
  const auto [a, b] = mesh.edge(face.index);
  const std::array margins{along(mesh.at(b), mesh.at(a), x), along(mesh.at(a), mesh.at(b), x)};
  const std::vector<double> values = shares(margins);
  weights[place(a)] = values[0];
  weights[place(b)] = values[1];
  return weights;
}

ExactVector normal(const Complex& mesh, Index t) {
  const auto [a, b, c] = mesh.triangle(t);
  return cross(exact(mesh.at(b)) - exact(mesh.at(a)), exact(mesh.at(c)) - exact(mesh.at(a)));
}

/// Returns x − c times a positive number. c is the vertex, or the point of the edge's line closest to x.
ExactVector offset_of(const Complex& mesh, Face face, const Vec3f& x) {
  if (face.kind == FaceKind::vertex) return exact(x) - exact(mesh.at(face.index));
  const auto [a, b] = mesh.edge(face.index);
  const ExactVector e = exact(mesh.at(b)) - exact(mesh.at(a)), w = exact(x) - exact(mesh.at(a));
  return times(dot(e, e), w) - times(dot(e, w), e);
}

compare::Vec3 unit(const ExactVector& v) {
  const double x = v.x.to_double(), y = v.y.to_double(), z = v.z.to_double(), length = std::hypot(x, y, z);
  return {x / length, y / length, z / length};
}

compare::Vec3 direction_of(const Complex& mesh, Index t, Face face, const Vec3f& x, bool inside) {
  if (face.kind == FaceKind::triangle) return unit(normal(mesh, t));
  const ExactVector offset = offset_of(mesh, face, x);
  if (is_zero(offset)) return unit(normal(mesh, t));
  return unit(inside ? times(Exact(-1), offset) : offset);
}

/// Returns the faces of a part, each once.
std::vector<Face> faces_of(const Complex& mesh, const std::vector<Index>& part) {
  std::vector<Face> faces;
  for (const Index t : part) {
    for (const Index v : mesh.triangle(t)) faces.push_back(vertex_face(v));
    for (const Index e : mesh.topology.triangle_edges[at(t)]) faces.push_back(edge_face(e));
    faces.push_back(triangle_face(t));
  }
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

/// Rounded distances of x from a triangle's box, and from the nearest of the triangle's corners.
struct Reach {
  double box = 0, corner = INFINITY;
};
Reach reach_of(const Complex& mesh, Index t, const Vec3f& x) {
  std::array<double, 3> low, high;
  low.fill(INFINITY), high.fill(-INFINITY);
  Reach reach;
  const std::array own{double{x.x}, double{x.y}, double{x.z}};
  for (const Index v : mesh.triangle(t)) {
    const Vec3f& p = mesh.at(v);
    const std::array corner{double{p.x}, double{p.y}, double{p.z}};
    for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], corner[k]), high[k] = std::max(high[k], corner[k]);
    reach.corner = std::min(reach.corner, std::hypot(corner[0] - own[0], corner[1] - own[1], corner[2] - own[2]));
  }
  const auto gap = [&](std::size_t k) { return std::max({0.0, low[k] - own[k], own[k] - high[k]}); };
  reach.box = std::hypot(gap(0), gap(1), gap(2));
  return reach;
}

/// Relative error limit of the distances of Reach.
constexpr double reach_slack = 0x1p-40;

/// Preselects the triangles of a part. `nearest` has the triangles that may be nearest to x: their boxes are not
/// farther from x than the nearest corner of all triangles. `touching` has the triangles whose boxes are within the
/// contact radius of x.
struct Within {
  std::vector<Index> nearest, touching;

  Within(const Complex& mesh, const std::vector<Index>& part, const Vec3f& x, float contact_radius) {
    std::vector<double> box;
    double least = INFINITY;
    for (const Index t : part) {
      const Reach reach = reach_of(mesh, t, x);
      box.push_back(reach.box * (1 - reach_slack));
      least = std::min(least, reach.corner * (1 + reach_slack));
    }
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (box[i] <= least) nearest.push_back(part[i]);
      if (box[i] <= double{contact_radius}) touching.push_back(part[i]);
    }
  }
};

}  // namespace

Face closest_face_of(const Complex& volume, Index triangle, const Vec3f& x) {
  const auto [a, b, c] = volume.triangle(triangle);
  return face_of(volume, triangle, closest_feature({volume.at(a), volume.at(b), volume.at(c)}, x));
}

bool in_box_of(const Complex& volume, const std::vector<Index>& triangles, const Vec3f& x) {
  std::array<bool, 3> reaches_down{}, reaches_up{};
  for (const Index t : triangles)
    for (const Index v : volume.triangle(t)) {
      const Vec3f& p = volume.at(v);
      const std::array corner{p.x, p.y, p.z}, own{x.x, x.y, x.z};
      for (std::size_t k = 0; k < 3; ++k) {
        reaches_down[k] = reaches_down[k] || corner[k] <= own[k];
        reaches_up[k] = reaches_up[k] || corner[k] >= own[k];
      }
    }
  return std::ranges::all_of(reaches_down, std::identity{}) && std::ranges::all_of(reaches_up, std::identity{});
}

PartContact part_contact(const Complex& volume, Face face, const Vec3f& x, float contact_radius, bool inside) {
  const Index t = owner_of(volume, face);
  const double depth = inside ? distance(face_gap(volume, face, x, 0)) + static_cast<double>(contact_radius)
                              : -signed_length(face_gap(volume, face, x, contact_radius));
  return {inside, t, face, weights_of(volume, t, face, x), direction_of(volume, t, face, x, inside), depth};
}

std::vector<PartContact> part_contacts(const Complex& volume, const Vec3f& x, float contact_radius,
                                       std::span<const Index> part) {
  const std::span<const Index> number = part.empty() ? std::span<const Index>(volume.topology.component) : part;
  std::map<Index, std::vector<Index>> parts;  // by number of the part; no edge joins two parts
  for (std::size_t t = 0; t < volume.topology.triangles.size(); ++t)
    parts[number[at(volume.topology.triangles[t][0])]].push_back(static_cast<Index>(t));
  std::vector<PartContact> contacts;
  for (const auto& [own, triangles] : parts) {
    const Within within(volume, triangles, x, contact_radius);
    const Face nearest = nearest_face(volume, within.nearest, x);
    if (in_box_of(volume, triangles, x) && !begins_outside(volume, nearest, x)) {
      contacts.push_back(part_contact(volume, nearest, x, contact_radius, true));
      continue;
    }
    for (const Face face : faces_of(volume, within.touching)) {
      if (!in_block(volume, face, x, contact_radius) || !begins_outside(volume, face, x) ||
          sign(face_gap(volume, face, x, contact_radius)) >= 0)
        continue;
      contacts.push_back(part_contact(volume, face, x, contact_radius, false));
    }
  }
  std::ranges::sort(contacts, {}, [](const PartContact& c) { return std::tuple(c.inside, c.triangle, c.face); });
  return contacts;
}

}  // namespace ogc::reference
