// Meshes, contact sets and finders of contacts as Python sees them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "fast/contact_sets.hpp"

namespace ogc::python {

/// Returns the backend that a user names. Throws compare::InputError that lists them.
fast::Backend parse_backend(std::string_view name);

/// Contact sets whose columns NumPy reads where they lie.
struct ContactSets {
  std::vector<std::array<compare::Index, 3>> vertex_facet;             ///< vertex, face, owner
  std::vector<std::uint8_t> vertex_facet_kind;                         ///< compare::FaceKind of the face
  std::vector<std::array<compare::Index, 4>> edge_edge;                ///< first and second face, first and second edge
  std::vector<std::array<std::uint8_t, 2>> edge_edge_kind;             ///< compare::FaceKind of the faces
  std::vector<float> d_min_vertex, d_min_edge, d_min_triangle, bound;  ///< as in fast::ContactSets
  /// Smallest distance of all pairs [m]; r_q if no pair is near, or if there is no pair.
  float smallest_distance = 0;
};

class Mesh;

/// Finds the contacts of one mesh; several threads may call it, one after the other is served.
class ContactFinder {
 public:
  ContactFinder(const Mesh& mesh, fast::Backend backend);
  /// fast::ContactFinder::find
  ContactSets find(std::span<const compare::Vec3f> positions, const fast::ContactQuery& query);
  const compare::Topology& topology() const { return finder_.topology(); }

 private:
  fast::ContactFinder finder_;
  std::mutex busy_;
};

/// A mesh that never changes: its triangles, loose edges, and the groups of its vertices.
class Mesh {
 public:
  /// Throws compare::InputError as fast::ContactFinder does. Without `vertex_count` the mesh has as many vertices as
  /// its triangles and edges name.
  Mesh(std::span<const compare::Triangle> triangles, std::span<const compare::Edge> loose_edges,
       std::span<const compare::Index> groups, std::optional<compare::Index> vertex_count);
  /// V, also counts vertices that no face contains.
  compare::Index vertex_count() const { return vertex_count_; }
  /// As given.
  const std::vector<compare::Triangle>& triangles() const { return triangles_; }
  /// Edges of no triangle, as given.
  const std::vector<compare::Edge>& loose_edges() const { return loose_edges_; }
  /// Group of each vertex; empty without groups.
  const std::vector<compare::Index>& groups() const { return groups_; }
  /// All edges, whose numbers contact sets have.
  const std::vector<compare::Edge>& edges() const { return topology().edges; }
  /// Adjacency of the mesh.
  const compare::Topology& topology() const { return finders_[0]->topology(); }
  /// Returns the finder of a backend, which is made at its first use and kept.
  ContactFinder& finder(fast::Backend backend);

 private:
  compare::Index vertex_count_ = 0;
  std::vector<compare::Triangle> triangles_;
  std::vector<compare::Edge> loose_edges_;
  std::vector<compare::Index> groups_;
  std::mutex making_;
  std::array<std::unique_ptr<ContactFinder>, 2> finders_;  // by backend; that of the CPU also has the topology
};

}  // namespace ogc::python
