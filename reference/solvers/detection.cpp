#include "reference/solvers/detection.hpp"

#include <algorithm>
#include <cmath>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/bound.hpp"
#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"

namespace ogc::reference {
namespace {

double distance_to_segment(const Triple<double>& x, const Triple<double>& a, const Triple<double>& b) {
  const Triple<double> along = b - a, away = x - a;
  const double length = dot(along, along), share = length > 0 ? std::clamp(dot(away, along) / length, 0.0, 1.0) : 0;
  const Triple<double> gap = away - share * along;
  return std::hypot(gap[0], gap[1], gap[2]);
}

ContactSets sets_within(compare::DetectIn in, float contact_radius) {
  in.contact_radius = contact_radius;
  return {exact_vertex_facet(in).contacts, exact_edge_edge(in).contacts};
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
  const auto at = [&](compare::Index v) { return widened(positions[static_cast<std::size_t>(v)]); };
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
  // The result is enlarged by 2⁻²⁰. Rounding changes a distance by about 2⁻⁵⁰ of the coordinates, and the radius is at
  // least r, so this is enough for coordinates up to 2³⁰ r.
  return std::min(most, static_cast<float>(query_radius * (1 + 0x1p-20)));
}

double detection_radius(const compare::Settings& settings) {
  return (1 + settings.contact_margin) * settings.contact_radius;
}

Detected detect(const compare::Scene& scene, const compare::Topology& topology,
                const compare::ExclusionView& exclusions, std::vector<compare::Vec3f> positions, float query_radius,
                std::span<const compare::Vec3f> displacement) {
  const auto contact_radius = static_cast<float>(detection_radius(scene.settings));
  const compare::DetectIn in{&topology, exclusions, positions, contact_radius, query_radius};
  compare::DetectVertexFacetOut facets = exact_vertex_facet(in);
  compare::DetectEdgeEdgeOut edges = exact_edge_edge(in);
  const auto relaxation = static_cast<float>(scene.settings.bounds_relaxation);
  Detected result;
  result.bound =
      bound({&topology, facets.d_min_vertex, edges.d_min_edge, facets.d_min_triangle, relaxation}).exact.bound;
  if (traits_of(scene.settings.bounds).has_planes) {
    const std::vector<std::uint8_t> is_fixed = compare::fixed_flags(exclusions.groups);
    compare::PlaneOut held = pair_planes(
        {&topology, exclusions, positions, is_fixed, query_radius, relaxation, displacement});
    result.bound = std::move(held.bound);
    result.planes = std::move(held.planes);
  }
  float smallest = query_radius;
  for (const auto* distances : {&facets.d_min_vertex, &facets.d_min_triangle, &edges.d_min_edge})
    for (const float d : *distances) smallest = std::min(smallest, d);
  result.smallest_distance = double{smallest};
  result.sets = {std::move(facets.contacts), std::move(edges.contacts)};
  result.active = scene.settings.contact_margin > 0 ? sets_within(in, static_cast<float>(scene.settings.contact_radius))
                                                    : result.sets;
  result.previous = std::move(positions);
  return result;
}

std::vector<NearPair> detect_pairs(const compare::Topology& topology, const compare::ExclusionView& exclusions,
                                   const std::vector<compare::Vec3f>& positions, float query_radius,
                                   double bounds_relaxation) {
  const std::vector<std::uint8_t> is_fixed = compare::fixed_flags(exclusions.groups);
  const auto relaxation = static_cast<float>(bounds_relaxation);
  return near_pairs_with_planes({&topology, exclusions, positions, is_fixed, query_radius, relaxation});
}

}  // namespace ogc::reference
