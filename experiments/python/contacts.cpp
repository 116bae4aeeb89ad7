#include "experiments/python/contacts.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "compare/problem/error.hpp"

namespace ogc::python {
namespace {

template <class Primitive>
compare::Index after_last(compare::Index count, std::span<const Primitive> primitives) {
  for (const Primitive& primitive : primitives) {
    const compare::Index last = std::ranges::max(primitive);
    if (last == std::numeric_limits<compare::Index>::max())
      throw compare::InputError("vertex number " + std::to_string(last) + " came; a mesh has at most as many vertices");
    count = std::max(count, last + 1);
  }
  return count;
}

std::uint8_t kind_of(const compare::Face& face) { return static_cast<std::uint8_t>(face.kind); }

ContactSets in_columns(fast::ContactSets&& sets, float query_radius) {
  ContactSets columns;
  columns.vertex_facet.reserve(sets.vertex_facet.size());
  columns.vertex_facet_kind.reserve(sets.vertex_facet.size());
  for (const compare::VertexFacetContact& contact : sets.vertex_facet) {
    columns.vertex_facet.push_back({contact.vertex, contact.face.index, contact.owner});
    columns.vertex_facet_kind.push_back(kind_of(contact.face));
  }
  columns.edge_edge.reserve(sets.edge_edge.size());
  columns.edge_edge_kind.reserve(sets.edge_edge.size());
  for (const compare::EdgeEdgeContact& contact : sets.edge_edge) {
    columns.edge_edge.push_back({contact.first.index, contact.second.index, contact.first_edge, contact.second_edge});
    columns.edge_edge_kind.push_back({kind_of(contact.first), kind_of(contact.second)});
  }
  columns.smallest_distance = query_radius;
  for (const std::vector<float>* distances : {&sets.d_min_vertex, &sets.d_min_edge})
    for (const float distance : *distances) columns.smallest_distance = std::min(columns.smallest_distance, distance);
  columns.d_min_vertex = std::move(sets.d_min_vertex);
  columns.d_min_edge = std::move(sets.d_min_edge);
  columns.d_min_triangle = std::move(sets.d_min_triangle);
  columns.bound = std::move(sets.bound);
  return columns;
}

}  // namespace

fast::Backend parse_backend(std::string_view name) {
  if (name == "cpu") return fast::Backend::cpu;
  if (name == "cuda") return fast::Backend::cuda;
  throw compare::InputError("backend: there is no '" + std::string(name) + "'; give \"cpu\" or \"cuda\"");
}

ContactSets ContactFinder::find(std::span<const compare::Vec3f> positions, const fast::ContactQuery& query) {
  const std::lock_guard lock(busy_);
  return in_columns(finder_.find(positions, query), query.query_radius);
}

ContactSets ContactFinder::find_on_device(std::span<const compare::Vec3f> positions, const fast::ContactQuery& query) {
  const std::lock_guard lock(busy_);
  expect_vertices("x", positions.size(), finder_.mesh());
  return in_columns(finder_.find_at_resident(positions.data(), query), query.query_radius);
}

void expect_vertices(const char* argument, std::size_t count, const fast::Mesh& mesh) {
  if (count != compare::at(mesh.vertex_count()))
    throw compare::InputError(std::string(argument) + ": " + std::to_string(count) + " rows came for " +
                              std::to_string(mesh.vertex_count()) + " vertices");
}

Mesh::Mesh(std::span<const compare::Triangle> triangles, std::span<const compare::Edge> loose_edges,
           std::span<const compare::Index> groups, std::optional<compare::Index> vertex_count)
    : mesh_(vertex_count ? *vertex_count : after_last(after_last(0, triangles), loose_edges), triangles, loose_edges,
            groups) {}

ContactFinder& Mesh::finder(fast::Backend backend) {
  const std::lock_guard lock(making_);
  std::unique_ptr<ContactFinder>& finder = finders_[static_cast<std::size_t>(backend)];
  if (!finder) finder = std::make_unique<ContactFinder>(mesh_, backend);
  return *finder;
}

}  // namespace ogc::python
