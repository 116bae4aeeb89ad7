// Contact sets as columns of numbers, for consumers that read arrays where they lie, on the host or on a device.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "compare/problem/vector.hpp"

namespace ogc::fast {

/// Memory of a backend that columns share.
class ColumnMemory {
 public:
  virtual ~ColumnMemory() = default;
  virtual const std::byte* data() const = 0;  ///< first byte, in the backend's memory
  /// Copies the first `count` bytes to the host.
  virtual void download(std::byte* to, std::size_t count) const = 0;
};

/// Numbers of rows.
struct ColumnLengths {
  std::size_t vertices = 0, edges = 0, triangles = 0;  ///< of the mesh
  std::size_t vertex_facet = 0, edge_edge = 0;         ///< contacts
  /// Returns the size of the columns [bytes].
  std::size_t bytes() const;
};

/// What ContactSets holds, in the same order, in the memory of the backend that found it. No later call writes to this
/// memory, and it lives as long as a copy of the columns. Lengths and smallest_distance are on the host.
struct ContactColumns {
  std::span<const float> d_min_vertex, d_min_edge, d_min_triangle, bound;  ///< as in ContactSets [m]
  std::span<const std::array<compare::Index, 3>> vertex_facet;             ///< vertex, index of the face, owner
  std::span<const std::array<compare::Index, 4>> edge_edge;                ///< indices of both faces, then both edges
  std::span<const std::uint8_t> vertex_facet_kind;                         ///< compare::FaceKind of the face
  std::span<const std::array<std::uint8_t, 2>> edge_edge_kind;             ///< compare::FaceKind of both faces
  float smallest_distance = 0;                                             ///< of all pairs [m]; r_q if none is nearer
  int device = on_host;                        ///< number of the CUDA device that has the columns
  std::shared_ptr<const ColumnMemory> memory;  ///< of the columns

  static constexpr int on_host = -1;

  ContactColumns() = default;
  /// Lays columns out in memory of at least lengths.bytes().
  ContactColumns(std::shared_ptr<const ColumnMemory> memory, const ColumnLengths& lengths);
  /// Returns the columns on the host: a copy, or the same if they are there.
  ContactColumns copied_to_host() const;
};

}  // namespace ogc::fast
