#include "reference/solvers/detection.hpp"

#include <algorithm>
#include <cmath>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/bound.hpp"
#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"

namespace ogc::reference {
namespace {

Triple<double> wide(const compare::Vec3f& p) { return {p.x, p.y, p.z}; }

double distance_to_segment(const Triple<double>& x, const Triple<double>& a, const Triple<double>& b) {
  const Triple<double> along = b - a, away = x - a;
  const double length = dot(along, along), share = length > 0 ? std::clamp(dot(away, along) / length, 0.0, 1.0) : 0;
  const Triple<double> gap = away - share * along;
  return std::hypot(gap[0], gap[1], gap[2]);
}

}  // namespace

std::vector<compare::Vec3f> rounded(const State& x) {
  std::vector<compare::Vec3f> positions;
  positions.reserve(x.size());
  for (const Triple<double>& p : x)
    positions.push_back({static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
  return positions;
}

float sufficient_query_radius(const compare::Topology& topology, const compare::ExclusionView& exclusions,
                              const std::vector<std::size_t>& movable, const std::vector<compare::Vec3f>& positions,
                              float contact_radius, float most) {
  double query_radius = double{contact_radius};
  const auto at = [&](compare::Index v) { return wide(positions[static_cast<std::size_t>(v)]); };
  for (const std::size_t v : movable) {
    const auto vertex = static_cast<compare::Index>(v);
    double nearest = double{most};
    for (const compare::Index t : topology.vertex_triangles[v])
      for (const compare::Index e : topology.triangle_edges[static_cast<std::size_t>(t)]) {
        const compare::Edge& side = topology.edges[static_cast<std::size_t>(e)];
        if (side[0] == vertex || side[1] == vertex) continue;
        for (const compare::Index other : topology.edge_triangles[static_cast<std::size_t>(e)]) {
          const compare::Triangle& corners = topology.triangles[static_cast<std::size_t>(other)];
          if (std::find(corners.begin(), corners.end(), vertex) != corners.end() ||
              is_excluded(exclusions, {&vertex, 1}, corners))
            continue;
          nearest = std::min(nearest, distance_to_segment(at(vertex), at(side[0]), at(side[1])));
        }
      }
    query_radius = std::max(query_radius, nearest);
  }
  // Rounding moves a distance by some 2⁻⁵⁰ of the coordinates: a part in 2²⁰ of r and more covers that up to
  // coordinates of 2³⁰ r.
  return std::min(most, static_cast<float>(query_radius * (1 + 0x1p-20)));
}

Detected detect(const compare::Scene& scene, const compare::Topology& topology,
                const compare::ExclusionView& exclusions, std::vector<compare::Vec3f> positions, float query_radius) {
  const auto contact_radius = static_cast<float>(scene.settings.contact_radius);
  const compare::DetectIn in{&topology, exclusions, positions, contact_radius, query_radius};
  compare::DetectVertexFacetOut facets = exact_vertex_facet(in);
  compare::DetectEdgeEdgeOut edges = exact_edge_edge(in);
  const auto relaxation = static_cast<float>(scene.settings.bound_relaxation);
  Detected result;
  result.bound =
      bound({&topology, facets.d_min_vertex, edges.d_min_edge, facets.d_min_triangle, relaxation}).exact.bound;
  float smallest = query_radius;
  for (const auto* distances : {&facets.d_min_vertex, &facets.d_min_triangle, &edges.d_min_edge})
    for (const float d : *distances) smallest = std::min(smallest, d);
  result.smallest_distance = double{smallest};
  result.sets = {std::move(facets.contacts), std::move(edges.contacts)};
  result.previous = std::move(positions);
  return result;
}

/// Rounding moves each coordinate, at most ‖X_prev‖_∞ + b_v, by 2⁻²⁴ of itself, so the point by √3 times that, or by as
/// many of the smallest numbers. A projection in double rounds each coordinate and the step to it a few times more:
/// 2⁻⁵⁰ of either.
Balls::Balls(const Detected& detected) : centre_(widened(detected.previous)) {
  for (std::size_t v = 0; v < centre_.size(); ++v) {
    const Triple<double>& p = centre_[v];
    const double bound = double{detected.bound[v]},
                 size = std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])}) + bound;
    const double rounding = std::sqrt(3.0) * ((0x1p-24 + 0x1p-50) * size + 0x1p-149);
    radius_.push_back(std::max(0.0, (bound - rounding) * (1 - 0x1p-50)));
  }
}

Balls::Inside Balls::inside(std::size_t vertex, const Triple<double>& x) const {
  const Triple<double> away = x - centre_[vertex];
  const double length = std::hypot(away[0], away[1], away[2]);
  if (!(length > radius_[vertex])) return {x, false};
  return {centre_[vertex] + (radius_[vertex] / length) * away, true};
}

double Balls::share_inside(std::size_t vertex, const Triple<double>& x, const Triple<double>& step) const {
  if (!inside(vertex, x + step).cut) return 1;
  // ‖a + s b‖ = R with ‖a‖ ≤ R has one root s ≥ 0.
  const Triple<double> away = x - centre_[vertex];
  const double bb = dot(step, step), ab = dot(away, step), room = radius_[vertex] * radius_[vertex] - dot(away, away);
  if (room <= 0) return 0;
  return std::clamp((std::sqrt(ab * ab + bb * room) - ab) / bb * (1 - 0x1p-40), 0.0, 1.0);
}

}  // namespace ogc::reference
