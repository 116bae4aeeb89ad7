#include "reference/definitions/volume_faces.hpp"

#include <algorithm>
#include <cmath>

#include "reference/definitions/closed_surface.hpp"
#include "reference/definitions/part_contacts.hpp"
#include "reference/geometry/closest_face.hpp"

namespace ogc::reference {

using compare::VolumeAnswer;
using compare::VolumePartTruth;

namespace {

using compare::at;

constexpr double doubt_factor = compare::grey_factor;

double norm_1(const Vec3f& a, const Vec3f& b) {
  return std::abs(double{a.x} - b.x) + std::abs(double{a.y} - b.y) + std::abs(double{a.z} - b.z);
}
double length(const Vec3f& a, const Vec3f& b) {
  return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
}

}  // namespace

VolumeFaces::VolumeFaces(const Complex& mesh, const Vec3f& x, float radius, Index own)
    : mesh_(mesh), x_(x), radius_(radius), own_(own) {
  compare::ClosestFaceIn in;
  for (const auto& [a, b, c] : mesh.topology.triangles) {
    in.point.push_back(x);
    in.triangle.push_back({mesh.at(a), mesh.at(b), mesh.at(c)});
  }
  faces_ = closest_face(in);
}

bool VolumeFaces::contains(Face face, Index vertex) const {
  const auto vertices = mesh_.vertices(face);
  return std::ranges::find(vertices.span(), vertex) != vertices.span().end();
}

double VolumeFaces::doubt(Index t) const { return doubt_factor * std::max(faces_.distance[at(t)], spread(t)); }

/// Returns Σ|δ| of triangle t and x, with δ relative to the triangle's first corner.
double VolumeFaces::spread(Index t) const {
  const auto [a, b, c] = mesh_.triangle(t);
  const Vec3f& origin = mesh_.at(a);
  return norm_1(x_, origin) + norm_1(mesh_.at(b), origin) + norm_1(mesh_.at(c), origin);
}

VolumeFaces::Candidates VolumeFaces::nearest_of(const std::vector<Index>& triangles) const {
  Candidates nearest{INFINITY, {}};
  double below = INFINITY;  // upper bound of the smallest distance
  for (const Index t : triangles) {
    nearest.least = std::min(nearest.least, faces_.distance[at(t)]);
    below = std::min(below, faces_.distance[at(t)] + doubt(t));
  }
  for (const Index t : triangles)
    if (faces_.distance[at(t)] - doubt(t) <= below) nearest.triangles.push_back(t);
  return nearest;
}

bool VolumeFaces::is_on_surface(const std::vector<Index>& candidates) const {
  return std::ranges::any_of(candidates, [&](Index t) { return faces_.distance[at(t)] <= doubt(t); });
}

Face VolumeFaces::exactly_nearest(const std::vector<Index>& triangles) const {
  Face nearest;
  Margin least;
  bool any = false;
  for (const Index t : triangles) {
    const Face face = closest_face_of(mesh_, t, x_);
    const Margin gap = face_gap(mesh_, face, x_, 0);
    const int order = any ? compare_distances(gap, least) : -1;
    if (order < 0 || (order == 0 && face < nearest)) nearest = face, least = gap;
    any = true;
  }
  return nearest;
}

Face VolumeFaces::face_of(Index t, int feature) const {
  if (feature < 3) return vertex_face(mesh_.triangle(t)[at(feature)]);
  if (feature < 6) return edge_face(mesh_.topology.triangle_edges[at(t)][at(feature - 3)]);
  return triangle_face(t);
}

std::vector<Face> VolumeFaces::possible_faces(const std::vector<Index>& candidates, Face nearest, double least) const {
  std::vector<Face> faces{nearest};
  for (const Index t : candidates) {
    const double further = faces_.distance[at(t)] - least;
    const bool is_as_near = further <= 4 * doubt_factor * doubt(t);
    for (int f = 0; f < 7; ++f) {
      const Face face = face_of(t, f);
      if (accepts(t, face) && std::ranges::find(faces, face) == faces.end() &&
          (is_as_near || std::ranges::all_of(around(face), [&](Index other) { return accepts(other, face); })))
        faces.push_back(face);
    }
  }
  return faces;
}

/// Returns whether the closest point of t to x may lie on the face, which belongs to t.
bool VolumeFaces::accepts(Index t, Face face) const {
  for (int f = 0; f < 7; ++f)
    if (face_of(t, f) == face) return (faces_.accepted[at(t)] >> f & 1) != 0;
  return false;
}

std::vector<Index> VolumeFaces::around(Face face) const {
  if (face.kind == FaceKind::triangle) return {face.index};
  const auto all = face.kind == FaceKind::edge ? mesh_.triangles_of(face.index)
                                               : mesh_.topology.vertex_triangles[at(face.index)];
  return {all.begin(), all.end()};
}

bool VolumeFaces::is_rim(Face face) const {
  if (face.kind == FaceKind::edge) return mesh_.triangles_of(face.index).size() == 1;
  return face.kind == FaceKind::vertex &&
         std::ranges::any_of(mesh_.edges_of(face.index), [&](Index e) { return mesh_.triangles_of(e).size() == 1; });
}

bool VolumeFaces::share_vertex(Face a, Face b) const {
  const auto first = mesh_.vertices(a), second = mesh_.vertices(b);
  return std::ranges::any_of(first.span(),
                             [&](Index v) { return std::ranges::find(second.span(), v) != second.span().end(); });
}

bool VolumeFaces::is_inside(Face face, Face nearest, bool nearest_inside, const std::vector<Index>& candidates) const {
  if (is_rim(face)) return false;
  if (!is_rim(nearest) && share_vertex(face, nearest)) return nearest_inside;
  std::vector<Index> star;
  for (const Index t : around(face))
    if (std::ranges::find(candidates, t) != candidates.end()) star.push_back(t);
  return !begins_outside(mesh_, exactly_nearest(star), x_);
}

void VolumeFaces::touch(const std::vector<Index>& triangles, Face nearest, bool faces_in, VolumePartTruth& truth) {
  std::vector<Face> faces;
  for (const Index t : triangles) {
    if (faces_.distance[at(t)] - doubt(t) > radius_) continue;
    for (int f = 0; f < 7; ++f)
      if (!contains(face_of(t, f), own_)) faces.push_back(face_of(t, f));
  }
  std::ranges::sort(faces);
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  for (const Face face : faces) {
    Membership block;
    Nearness nearness;
    visit_block(mesh_, face, x_, [&](const Boundary& boundary) {
      require(block, boundary.condition);
      nearness.add(boundary.condition);
      return nearness.within_reach();
    });
    const MarginAnswer gap = examine(face_gap(mesh_, face, x_, radius_));
    require(block, gap.sign < 0, gap.grey);
    nearness.add(gap.sign < 0, gap.near);
    near = near || nearness.is_near();
    if (!block.possible) continue;
    const std::vector<Index> star = around(face);
    const bool outward = block.exact ? begins_outside(mesh_, face, x_) : !is_inside(face, nearest, faces_in, star);
    const bool touches = std::ranges::any_of(star, [&](Index t) { return faces_.distance[at(t)] <= doubt(t); });
    const bool vague = is_vague(face);
    if (!outward && !touches && !is_rim(face) && !vague) continue;
    truth.touching.push_back(answer(face, false));
    truth.is_certain.push_back(block.certain && outward && !touches && !vague);
    truth.is_exact.push_back(block.exact && outward && !truth.inside);
    grey = grey || !block.certain || vague;
  }
}

void VolumeFaces::add_touching(Face face, VolumePartTruth& truth) const {
  const auto is_there = [&](const VolumeAnswer& a) { return a.contact.face == face; };
  const MarginAnswer gap = examine(face_gap(mesh_, face, x_, radius_));
  if ((gap.sign >= 0 && !gap.grey) || std::ranges::any_of(truth.touching, is_there)) return;
  truth.touching.push_back(answer(face, false));
  truth.is_certain.push_back(0);
  truth.is_exact.push_back(0);
}

VolumeAnswer VolumeFaces::answer(Face face, bool inside) const {
  const PartContact exact = part_contact(mesh_, face, x_, radius_, inside);
  VolumeAnswer result;
  result.contact.inside = inside;
  result.contact.triangle = exact.triangle;
  result.contact.face = face;
  // Kernels clamp the closest point to the face, so their weights are in [0, 1].
  for (std::size_t k = 0; k < 3; ++k) result.weights[k] = std::clamp(exact.weights[k], 0.0, 1.0);
  result.direction = exact.direction;
  result.depth = exact.depth;
  const double d = std::abs(exact.depth - radius_), size = spread(exact.triangle);
  result.depth_scale = std::max(d, size) + radius_;
  result.weight_scale = 1;
  for (const Index t : around(face))
    result.weight_scale = std::max(result.weight_scale, faces_.weight_condition[at(t)]);
  result.direction_scale = face.kind == FaceKind::triangle ? normal_scale(face.index) : std::max(1.0, size / d);
  return result;
}

double VolumeFaces::normal_scale(Index t) const {
  const auto [a, b, c] = mesh_.triangle(t);
  const double first = length(mesh_.at(a), mesh_.at(b)), second = length(mesh_.at(a), mesh_.at(c)),
               third = length(mesh_.at(b), mesh_.at(c)), half = (first + second + third) / 2;
  // Heron's formula
  const double area = std::sqrt(std::max(0.0, half * (half - first) * (half - second) * (half - third)));
  const double longest = std::max({first, second, third});
  return std::max(1.0, longest * longest / area);
}

}  // namespace ogc::reference
