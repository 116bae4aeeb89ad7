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

/// Throws compare::InputError unless an array has one row for each vertex.
void expect_vertices(const char* argument, std::size_t count, const fast::Mesh& mesh);

/// Calls `work`; messages of compare::InputError that begin with a name of C++ begin with Python's name instead.
template <class Work>
auto in_terms_of_python(Work work) {
  try {
    return work();
  } catch (const compare::InputError& error) {
    const std::string_view text = error.what();
    for (const auto& [name, ours] : {std::pair<std::string_view, const char*>{"positions: ", "x: "},
                                     {"moves: ", "dx: "},
                                     {"time_step ", "dt "},
                                     {"contact_radius ", "radius "},
                                     {"bounds_relaxation ", "relaxation "}})
      if (text.starts_with(name)) throw compare::InputError(ours + std::string(text.substr(name.size())));
    throw;
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
