// Holds the mesh as kernels read it: the primitives' vertices and the adjacency, in plain arrays without positions.
#pragma once

#include <cstdint>

#include "fast/kernels/arithmetic/vector.hpp"

namespace ogc::fast {

/// A triangle with its edges. Bit k of `descending` is set if edge k starts at its higher-numbered vertex. With this,
/// all triangles at an edge evaluate the edge's predicate with the same operands in the same order.
struct alignas(16) Facet {
  int corner[3];  ///< vertices in the order of the mesh
  int edge[3];    ///< indices of the edges 01, 12 and 20 in SurfaceView::edges
  unsigned descending;
};

/// The vertices of an edge, the lower-numbered one first.
struct alignas(8) EdgeEnds {
  int a, b;
};

/// A tetrahedron and its neighbours across its sides.
struct alignas(16) SolidElement {
  int corner[4];  ///< vertices
  int behind[4];  ///< by corner: the tetrahedron across the opposite side, or −1
};

/// Adjacency in rows: row i is items[offsets[i] … offsets[i + 1]).
struct Rows {
  const int* offsets = nullptr;  ///< rows + 1
  const int* items = nullptr;    ///< row by row
};

/// Seeds of an edge: vertices nearby in the mesh. The edge's smallest distance is at most its distance to a seed, so a
/// query need not search farther (Reach in fast/kernels/bvh.hpp). −1: no seed.
struct EdgeSeeds {
  int vertex[2];  ///< each is an end of an edge that forms a pair with this edge
};
/// Seeds of a facet: vertices nearby in the mesh, as for EdgeSeeds.
struct FacetSeeds {
  int vertex[3];  ///< for edge k: opposite vertex of the triangle across edge k; it forms a pair with the facet
};
/// Seeds of a vertex: edges nearby in the mesh, as for EdgeSeeds.
struct VertexSeeds {
  int edge[2];  ///< each belongs to a facet that forms a pair with the vertex
};

/// Holds the mesh on the backend.
struct SurfaceView {
  int vertex_count = 0, edge_count = 0, triangle_count = 0;
  const Facet* facets = nullptr;        ///< by triangle
  const EdgeEnds* edges = nullptr;      ///< by edge
  Rows neighbours;                      ///< by vertex: V_v of Eq. 8 and 15
  Rows opposites;                       ///< by edge: V_e of Eq. 9
  Rows vertex_edges, vertex_triangles;  ///< by vertex: its edges and its triangles
  /// by vertex: see is_off_surface; null if all vertices are on the surface
  const std::uint8_t* off_surface = nullptr;
  const int* groups = nullptr;            ///< by vertex; pairs whose vertices all have the same group ≥ 0 are omitted
  const EdgeSeeds* edge_seeds = nullptr;  ///< by edge
  const FacetSeeds* facet_seeds = nullptr;    ///< by triangle
  const VertexSeeds* vertex_seeds = nullptr;  ///< by vertex
  /// by vertex: a pair is omitted if a vertex of one side is in the row of a vertex of the other side; null offsets: no
  /// rows
  Rows partners;
  /// Indices of the primitives that take part in searches: vertices, then edges, then facets. Primitives of volumes are
  /// omitted. Null: all primitives, in order.
  const int* searched = nullptr;
  int searched_vertices = 0, searched_edges = 0, searched_facets = 0;  ///< vertices, edges and facets that take part

  /// Returns whether detections omit the vertex: it is an interior vertex of a solid (method.md §8.3), or a vertex of a
  /// volume, which volume_depth.hpp tests.
  OGC_HD bool is_off_surface(int v) const { return off_surface != nullptr && off_surface[v] != 0; }

  /// Return a face as one number, in the order of compare::Face: first vertices, then edges, then triangles.
  OGC_HD int vertex_face(int v) const { return v; }
  OGC_HD int edge_face(int e) const { return vertex_count + e; }
  OGC_HD int triangle_face(int t) const { return vertex_count + edge_count + t; }

  /// Returns whether a pair is omitted by method.md §2.3. The sides of the pair must not share a vertex.
  OGC_HD bool left_out(int v, const Facet& t) const {
    const int g = groups[v];
    if (g >= 0 && groups[t.corner[0]] == g && groups[t.corner[1]] == g && groups[t.corner[2]] == g) return true;
    if (partners.offsets == nullptr) return false;
    return is_partner(v, t.corner[0]) || is_partner(v, t.corner[1]) || is_partner(v, t.corner[2]);
  }
  OGC_HD bool left_out(const EdgeEnds& p, const EdgeEnds& q) const {
    const int g = groups[p.a];
    if (g >= 0 && groups[p.b] == g && groups[q.a] == g && groups[q.b] == g) return true;
    if (partners.offsets == nullptr) return false;
    return is_partner(p.a, q.a) || is_partner(p.a, q.b) || is_partner(p.b, q.a) || is_partner(p.b, q.b);
  }

 private:
  /// Returns whether the vertex `of` is in the row of v in `partners`. Rows are short, and nearly all of them are
  /// empty.
  OGC_HD bool is_partner(int v, int of) const {
    for (int i = partners.offsets[v]; i < partners.offsets[v + 1]; ++i) {
      if (partners.items[i] == of) return true;
    }
    return false;
  }
};

}  // namespace ogc::fast
