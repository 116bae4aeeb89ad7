// Computes the winding number of a point (x, y, z) from the crossings of a ray along +x. The ray starts at (x, y + ε, z
// + ε²) with vanishing ε, so that it meets no edge. This start and the point have the same winding number if the point
// is not on the surface. The ray crosses a triangle if the point lies inside the triangle's projection along the x
// axis, and the triangle's plane lies ahead.
#include "compare/oracle/volume_audit.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "compare/oracle/exact_intersection.hpp"
#include "compare/oracle/pairs.hpp"

namespace ogc::compare {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<Vec3, 3>;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Returns the sign of the area of the triangle (a, b, x + (0, ε, ε²)), projected along the x axis; ε is infinitesimal.
int side_seen(const Vec3& a, const Vec3& b, const Vec3& x) {
  const int exact = CGAL::orientation(Kernel::Point_2(a.y, a.z), Kernel::Point_2(b.y, b.z), Kernel::Point_2(x.y, x.z));
  if (exact != 0) return exact;
  if (a.z != b.z) return a.z > b.z ? 1 : -1;
  return a.y < b.y ? 1 : a.y > b.y ? -1 : 0;
}

/// Returns how the ray from x crosses the triangle: 1 outward, −1 inward, 0 not at all.
int crossing(const Corners& t, const Vec3& x) {
  const int seen = side_seen(t[0], t[1], x);
  if (seen == 0 || side_seen(t[1], t[2], x) != seen || side_seen(t[2], t[0], x) != seen) return 0;
  const auto point = [](const Vec3& v) { return Kernel::Point_3(v.x, v.y, v.z); };
  // `seen` is the sign of the normal's x component. The plane lies ahead if its side towards −x contains the point.
  const int above = CGAL::orientation(point(t[0]), point(t[1]), point(t[2]), point(x));
  return above == -seen ? seen : 0;
}

bool lies_on(const Corners& t, const Vec3& x) { return segment_meets_triangle({x, x}, t); }

Vec3 minus(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double to_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const Vec3 e = minus(b, a), w = minus(x, a);
  const double length = dot(e, e), s = length > 0 ? std::clamp(dot(w, e) / length, 0.0, 1.0) : 0;
  return std::hypot(w.x - s * e.x, w.y - s * e.y, w.z - s * e.z);
}

/// Returns the rounded distance to a triangle. If rounding leaves open whether the closest point of the plane is inside
/// the triangle, returns the distance to the triangle's edges, which then differs only by rounding.
double to_triangle(const Vec3& x, const Corners& t) {
  const Vec3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const double square = dot(n, n);
  bool is_inside = square > 0;
  for (std::size_t k = 0; k < 3 && is_inside; ++k)
    is_inside = dot(cross(minus(t[(k + 1) % 3], t[k]), minus(x, t[k])), n) > 0;
  if (is_inside) return std::abs(dot(n, minus(x, t[0]))) / std::sqrt(square);
  return std::min({to_segment(x, t[0], t[1]), to_segment(x, t[1], t[2]), to_segment(x, t[2], t[0])});
}

/// Groups edges that have one triangle into closed rims. Reverses each edge, so that a triangle added at the edge has
/// the orientation of the part.
std::vector<std::vector<Edge>> closed_rims(const std::vector<Edge>& rims) {
  std::map<Index, Index> root;
  const auto find = [&](Index v) {
    while (root.try_emplace(v, v).first->second != v) v = root[v];
    return v;
  };
  for (const auto& [a, b] : rims) root[std::max(find(a), find(b))] = std::min(find(a), find(b));
  std::map<Index, std::vector<Edge>> by_root;
  for (const auto& [a, b] : rims) by_root[find(a)].push_back({b, a});
  std::vector<std::vector<Edge>> closed;
  for (auto& [first, edges] : by_root) closed.push_back(std::move(edges));
  return closed;
}

/// A part at given positions: its triangles, the triangles of the fans that close its rims, and its tetrahedra.
class PlacedPart {
 public:
  PlacedPart(std::span<const Triangle> triangles, std::span<const std::vector<Edge>> rims,
             std::span<const Tetrahedron> tetrahedra, std::span<const Vec3> positions)
      : triangles_(triangles),
        tetrahedra_(tetrahedra),
        positions_(positions),
        all_(placed(triangles, rims, positions)),
        tree_(boxes(all_)),
        tetrahedron_tree_(boxes(tetrahedra, positions)) {}

  bool holds(const Vec3& x) const {
    Box ray = box_of({x});
    ray.high[0] = infinity;
    int winding = 0;
    bool is_on = false;
    tree_.for_each_meeting(ray, [&](Index i) {
      const Corners& t = all_[at(i)];
      winding += crossing(t, x);
      is_on = is_on || (at(i) < triangles_.size() && lies_on(t, x));
    });
    return winding != 0 && !is_on;
  }

  double distance(const Vec3& x) const {
    double least = infinity;
    for (std::size_t i = 0; i < triangles_.size(); ++i) least = std::min(least, to_triangle(x, all_[i]));
    return least;
  }

  /// Returns whether a vertex of the part lies inside the part.
  bool holds_own(Index vertex) const {
    const Vec3& x = positions_[at(vertex)];
    bool is_inside = false;
    tetrahedron_tree_.for_each_meeting(box_of({x}), [&](Index i) {
      const Tetrahedron& t = tetrahedra_[at(i)];
      is_inside = is_inside || (std::ranges::find(t, vertex) == t.end() && holds(t, x));
    });
    return is_inside;
  }

  /// Returns the distance from a vertex of the part to the part's triangles. Skips triangles that share a vertex with a
  /// triangle around `vertex`. Returns 0 if no triangle remains.
  double distance_of_own(Index vertex) const {
    std::vector<Index> around;
    for (const Triangle& t : triangles_)
      if (std::ranges::find(t, vertex) != t.end()) around.insert(around.end(), t.begin(), t.end());
    std::ranges::sort(around);
    double least = infinity;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const auto is_around = [&](Index v) { return std::ranges::binary_search(around, v); };
      if (std::ranges::none_of(triangles_[i], is_around))
        least = std::min(least, to_triangle(positions_[at(vertex)], all_[i]));
    }
    return std::isfinite(least) ? least : 0;
  }

 private:
  static std::vector<Corners> placed(std::span<const Triangle> triangles, std::span<const std::vector<Edge>> rims,
                                     std::span<const Vec3> positions) {
    std::vector<Corners> all;
    for (const auto& [a, b, c] : triangles) all.push_back({positions[at(a)], positions[at(b)], positions[at(c)]});
    for (const std::vector<Edge>& rim : rims) {
      Vec3 sum;
      for (const Edge& edge : rim) {
        const Vec3& x = positions[at(edge[0])];
        sum = {sum.x + x.x, sum.y + x.y, sum.z + x.z};
      }
      const auto count = static_cast<double>(rim.size());
      const Vec3 mean{sum.x / count, sum.y / count, sum.z / count};
      for (const auto& [a, b] : rim) all.push_back({positions[at(a)], positions[at(b)], mean});
    }
    return all;
  }
  static std::vector<Box> boxes(const std::vector<Corners>& all) {
    std::vector<Box> result;
    for (const auto& [a, b, c] : all) result.push_back(box_of({a, b, c}));
    return result;
  }
  static std::vector<Box> boxes(std::span<const Tetrahedron> all, std::span<const Vec3> positions) {
    std::vector<Box> result;
    for (const auto& [a, b, c, d] : all)
      result.push_back(box_of({positions[at(a)], positions[at(b)], positions[at(c)], positions[at(d)]}));
    return result;
  }

  /// Returns whether a closed tetrahedron of positive volume contains the point.
  bool holds(const Tetrahedron& t, const Vec3& x) const {
    const auto sign = [&](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
      const auto point = [](const Vec3& v) { return Kernel::Point_3(v.x, v.y, v.z); };
      return static_cast<int>(CGAL::orientation(point(a), point(b), point(c), point(d)));
    };
    const Vec3 &a = positions_[at(t[0])], &b = positions_[at(t[1])], &c = positions_[at(t[2])],
               &d = positions_[at(t[3])];
    return sign(a, b, c, d) > 0 && sign(x, b, c, d) >= 0 && sign(a, x, c, d) >= 0 && sign(a, b, x, d) >= 0 &&
           sign(a, b, c, x) >= 0;
  }

  std::span<const Triangle> triangles_;
  std::span<const Tetrahedron> tetrahedra_;
  std::span<const Vec3> positions_;
  std::vector<Corners> all_;
  BoxTree tree_, tetrahedron_tree_;
};

/// Returns how many of the edges meet a triangle with which they share no vertex.
std::size_t count_meeting(const Topology& topology, std::span<const Index> edges, std::span<const Index> triangles,
                          std::span<const Vec3> positions) {
  std::vector<Box> boxes;
  const auto corners = [&](Index t) {
    const auto& [a, b, c] = topology.triangles[at(t)];
    return Corners{positions[at(a)], positions[at(b)], positions[at(c)]};
  };
  for (const Index t : triangles) {
    const Corners c = corners(t);
    boxes.push_back(box_of({c[0], c[1], c[2]}));
  }
  const BoxTree tree(boxes);
  std::vector<char> meets(edges.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, edges.size(), 64),
                    [&](const tbb::blocked_range<std::size_t>& r) {
                      for (std::size_t i = r.begin(); i < r.end(); ++i) {
                        const auto& [a, b] = topology.edges[at(edges[i])];
                        const std::array<Vec3, 2> segment{positions[at(a)], positions[at(b)]};
                        tree.for_each_meeting(box_of({segment[0], segment[1]}), [&](Index k) {
                          const Triangle& own = topology.triangles[at(triangles[at(k)])];
                          const bool is_apart = std::ranges::none_of(own, [&](Index v) { return v == a || v == b; });
                          if (!meets[i] && is_apart)
                            meets[i] = segment_meets_triangle(segment, corners(triangles[at(k)]));
                        });
                      }
                    });
  return static_cast<std::size_t>(std::count(meets.begin(), meets.end(), 1));
}

}  // namespace

VolumeAuditor::VolumeAuditor(const Scene& scene) : topology_(build_topology(scene)) {
  std::vector<Index> part_of(scene.bodies.size(), -1);  // part of each body of tetrahedra
  for (const VolumePart& part : volume_parts(scene)) {
    const Body& body = scene.bodies[part.body];
    if (part_of[part.body] < 0) {
      if (body.is_solid()) part_of[part.body] = static_cast<Index>(parts_.size());
      const auto first = scene.mesh.tetrahedra.begin() + body.first_tetrahedron;
      parts_.push_back({{}, closed_rims(part.rims), {first, first + body.tetrahedron_count}});
    }
    std::vector<Triangle>& triangles =
        (part_of[part.body] < 0 ? parts_.back() : parts_[at(part_of[part.body])]).triangles;
    for (const Index t : part.triangles) triangles.push_back(scene.mesh.triangles[at(t)]);
  }
  if (parts_.empty()) return;
  const std::vector<bool> is_free = free_volumes(scene);
  const std::vector<Index> groups = rigid_groups(scene), body_of = body_of_vertex(scene);
  const auto is_fixed = [&](Index v) { return groups[at(v)] == 0; };
  const auto body = [&](Index v) -> const Body& { return scene.bodies[at(body_of[at(v)])]; };
  for (Index v = 0; v < topology_.vertex_count; ++v) {
    const bool is_asking = !body(v).is_volume() || is_free[at(body_of[at(v)])];
    if (is_asking && !is_fixed(v) && !topology_.vertex_edges[at(v)].empty())
      asking_.push_back({v, part_of[at(body_of[at(v)])]});
  }
  enum class Kind { surface, driven, free };
  const auto kind_of = [&](Index v) {
    return !body(v).is_volume() ? Kind::surface : is_free[at(body_of[at(v)])] ? Kind::free : Kind::driven;
  };
  auto& [onto_volumes, onto_surfaces, onto_all_volumes, onto_free] = meetings_;
  for (std::size_t e = 0; e < topology_.edges.size(); ++e) {
    const auto& [a, b] = topology_.edges[e];
    const auto number = static_cast<Index>(e);
    switch (kind_of(a)) {
      case Kind::surface:
        if (!is_fixed(a) || !is_fixed(b)) onto_volumes.edges.push_back(number);
        break;
      case Kind::driven: onto_surfaces.edges.push_back(number), onto_free.edges.push_back(number); break;
      case Kind::free: onto_surfaces.edges.push_back(number), onto_all_volumes.edges.push_back(number); break;
    }
  }
  for (std::size_t t = 0; t < topology_.triangles.size(); ++t) {
    const Triangle& corners = topology_.triangles[t];
    const auto number = static_cast<Index>(t);
    switch (kind_of(corners[0])) {
      case Kind::surface:
        if (!std::ranges::all_of(corners, is_fixed)) onto_surfaces.triangles.push_back(number);
        break;
      case Kind::free: onto_free.triangles.push_back(number); [[fallthrough]];
      case Kind::driven: onto_volumes.triangles.push_back(number), onto_all_volumes.triangles.push_back(number); break;
    }
  }
}

VolumePenetration VolumeAuditor::audit(std::span<const Vec3> positions) const {
  VolumePenetration found;
  if (!has_volumes()) return found;
  check_state("volumes", topology_, positions, {});
  std::vector<PlacedPart> parts;
  for (const Part& part : parts_) parts.emplace_back(part.triangles, part.rims, part.tetrahedra, positions);
  std::vector<double> depth(asking_.size(), -1);
  const auto depth_of = [&](const Asker& asker) {
    double deepest = -1;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Vec3& x = positions[at(asker.vertex)];
      if (asker.part == static_cast<Index>(k)) {
        if (parts[k].holds_own(asker.vertex)) deepest = std::max(deepest, parts[k].distance_of_own(asker.vertex));
      } else if (parts[k].holds(x)) {
        deepest = std::max(deepest, parts[k].distance(x));
      }
    }
    return deepest;
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, depth.size(), 16),
                    [&](const tbb::blocked_range<std::size_t>& r) {
                      for (std::size_t i = r.begin(); i < r.end(); ++i) depth[i] = depth_of(asking_[i]);
                    });
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (depth[i] < 0) continue;
    ++found.vertices_inside;
    if (found.deepest_vertex >= 0 && depth[i] <= found.deepest) continue;
    found.deepest_vertex = asking_[i].vertex;
    found.deepest = depth[i];
  }
  for (const auto& [edges, triangles] : meetings_)
    found.edges_meeting += count_meeting(topology_, edges, triangles, positions);
  return found;
}

}  // namespace ogc::compare
