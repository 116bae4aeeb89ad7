// Meshes, contact sets and finders of contacts as Python sees them.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/problem/error.hpp"
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

/// Throws compare::InputError unless an array has one row for each vertex.
void expect_vertices(const char* argument, std::size_t count, const fast::Mesh& mesh);

/// Calls `work`; messages of compare::InputError about `positions`, `moves` and `time_step` name x, dx and dt instead.
template <class Work>
auto in_terms_of_python(Work work) {
  try {
    return work();
  } catch (const compare::InputError& error) {
    const std::string_view text = error.what();
    for (const auto& [name, ours] :
         {std::pair<std::string_view, const char*>{"positions: ", "x: "}, {"moves: ", "dx: "}, {"time_step ", "dt "}})
      if (text.starts_with(name)) throw compare::InputError(ours + std::string(text.substr(name.size())));
    throw;
  }
}

/// Finds the contacts of one mesh; several threads may call it, one after the other is served.
class ContactFinder {
 public:
  ContactFinder(const fast::Mesh& mesh, fast::Backend backend) : backend_(backend), finder_(mesh, backend) {}
  fast::Backend backend() const { return backend_; }
  /// fast::ContactFinder::find
  ContactSets find(std::span<const compare::Vec3f> positions, const fast::ContactQuery& query);
  /// The same with positions in the memory of a device. Throws compare::InputError if there are not as many as
  /// vertices.
  ContactSets find_on_device(std::span<const compare::Vec3f> positions, const fast::ContactQuery& query);

 private:
  fast::Backend backend_;
  fast::ContactFinder finder_;
  std::mutex busy_;
};

/// A mesh that never changes, and its finders.
class Mesh {
 public:
  /// Throws compare::InputError as fast::Mesh does. Without `vertex_count` the mesh has as many vertices as its
  /// triangles and edges name.
  Mesh(std::span<const compare::Triangle> triangles, std::span<const compare::Edge> loose_edges,
       std::span<const compare::Index> groups, std::optional<compare::Index> vertex_count);
  /// The mesh itself, whose copies are cheap.
  const fast::Mesh& mesh() const { return mesh_; }
  /// Returns the finder of a backend, which is made at its first use and kept.
  ContactFinder& finder(fast::Backend backend);

 private:
  fast::Mesh mesh_;
  std::mutex making_;
  std::array<std::unique_ptr<ContactFinder>, 2> finders_;  // by backend
};

}  // namespace ogc::python
