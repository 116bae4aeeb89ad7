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

/// Returns what this package knows of the backend that a user names. Throws compare::InputError that lists them.
fast::BackendInfo backend_info(std::string_view name);
/// Returns the backend that a user names. Throws compare::InputError that lists them, and compare::ResourceError if it
/// is not built in.
fast::Backend usable_backend(std::string_view name);

/// Throws compare::InputError unless an array has one row for each vertex.
void expect_vertices(const char* argument, std::size_t count, const fast::Mesh& mesh);

/// Returns a message in which Python's names of arguments stand for those of C++.
std::string in_terms_of_python(std::string message);

/// Calls `work`; messages of compare::InputError have Python's names of arguments.
template <class Work>
auto with_names_of_python(Work work) {
  try {
    return work();
  } catch (const compare::InputError& error) {
    throw compare::InputError(in_terms_of_python(error.what()));
  }
}

/// Finds the contacts of one mesh; several threads may call it, one after the other is served.
class ContactFinder {
 public:
  ContactFinder(const fast::Mesh& mesh, fast::Backend backend) : backend_(backend), finder_(mesh, backend) {}
  fast::Backend backend() const { return backend_; }
  /// fast::ContactFinder::find_columns, with results on the host
  fast::ContactColumns find(std::span<const compare::Vec3f> positions, const fast::ContactQuery& query);
  /// The same with positions and results in the memory of a device. Throws compare::InputError if there are not as many
  /// positions as vertices.
  fast::ContactColumns find_on_device(std::span<const compare::Vec3f> positions, const fast::ContactQuery& query);

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
