// Holds meshes and their topology, that is, edge numbers and adjacency without geometry.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "compare/problem/vector.hpp"

namespace ogc::compare {

/// Holds rows of different length in one array: row i is items[offsets[i] .. offsets[i+1]), ascending.
struct CompressedRows {
  std::vector<Index> offsets{0};                           ///< start of each row, and the end
  std::vector<Index> items;                                ///< items of all rows, row after row
  std::size_t rows() const { return offsets.size() - 1; }  ///< number of rows
  std::span<const Index> operator[](std::size_t i) const {
    return {items.data() + offsets[i], static_cast<std::size_t>(offsets[i + 1] - offsets[i])};
  }
};

/// Holds what a mesh file gives: positions [m], triangles, edges that belong to no triangle (yarn), and tetrahedra. In
/// a scene the boundary of the tetrahedra is among the triangles (compare/problem/tetrahedra.hpp).
struct Mesh {
  std::vector<Vec3> positions;            ///< by vertex [m]
  std::vector<Triangle> triangles;        ///< vertex numbers
  std::vector<Edge> loose_edges;          ///< edges that belong to no triangle
  std::vector<Tetrahedron> tetrahedra{};  ///< vertex numbers
  friend bool operator==(const Mesh&, const Mesh&) = default;
};

/// One bending stencil: an interior edge with exactly two triangles. `edge` is its number, `opposite[k]` the vertex of
/// `triangles[k]` that is not on the edge; triangles ascending. Non-manifold edges give no hinge.
struct Hinge {
  Index edge = -1;                         ///< the edge that both triangles share
  std::array<Index, 2> triangles{-1, -1};  ///< the lower-numbered first
  std::array<Index, 2> opposite{-1, -1};   ///< their vertices that are not on the edge
};

/// Holds the adjacency of a complex of `vertex_count` vertices. Both contestants share the edge numbers: all edges of
/// triangles and all loose edges, without repetition, sorted by smaller, then larger vertex.
struct Topology {
  Index vertex_count = 0;                            ///< also counts vertices that no face contains
  std::vector<Triangle> triangles;                   ///< as given
  std::vector<Edge> edges;                           ///< the smaller vertex first, ascending
  std::vector<std::array<Index, 3>> triangle_edges;  ///< k-th entry: the edge from corner k to corner k+1 (mod 3)
  CompressedRows vertex_triangles;                   ///< triangles that contain v
  CompressedRows vertex_edges;                       ///< edges that contain v
  CompressedRows vertex_neighbours;                  ///< V_v: vertices that share an edge with v (Eq. 8)
  CompressedRows edge_triangles;                     ///< triangles that contain e
  /// V_e: vertices opposite e in the triangles that contain it (Eq. 9), any number of them
  CompressedRows edge_opposite;
  std::vector<Hinge> hinges;              ///< by edge number
  std::vector<Index> boundary_edges;      ///< edges with exactly one triangle
  std::vector<Index> non_manifold_edges;  ///< edges with three or more triangles
  std::vector<Index> component;           ///< component number of each vertex, numbered by first vertex

  /// By vertex: 1 for a vertex inside a solid (on a tetrahedron, but in no edge of this topology), and for each vertex
  /// of a volume (§3.9). Edges and triangles of volumes are then off the surface, too. Empty if all vertices are on the
  /// surface.
  std::vector<std::uint8_t> off_surface;

  /// Returns whether a vertex is on the surface. All other vertices take no part in detection, contact among surfaces
  /// and audit, and have no bound (method.md §2).
  bool on_surface(Index v) const { return off_surface.empty() || off_surface[static_cast<std::size_t>(v)] == 0; }
  /// Returns whether an edge or a triangle is on the surface; all of its vertices are of one body.
  template <std::size_t N>
  bool on_surface(const std::array<Index, N>& vertices) const {
    return on_surface(vertices[0]);
  }
};

/// Builds the adjacency. Throws std::out_of_range if a triangle or loose edge has an invalid or repeated index (see
/// `validate`).
Topology build_topology(Index vertex_count, std::span<const Triangle> triangles,
                        std::span<const Edge> loose_edges = {});

/// Builds the adjacency of a mesh and marks the vertices inside its solids.
Topology build_topology(const Mesh& mesh);

/// Returns the number of the edge {a, b}, or -1 if there is none.
Index find_edge(const Topology& topology, Index a, Index b);

}  // namespace ogc::compare
