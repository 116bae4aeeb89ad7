// Computes the conservative bound of a vertex (Eq. 21, 23, 25).
#pragma once

#include "fast/kernels/arithmetic/rounding.hpp"
#include "fast/kernels/surface.hpp"

namespace ogc::fast {

/// b_v of a vertex that is not on the surface, and so has no bound.
inline constexpr float largest_float = 0x1.fffffep127f;

/// Sets all smallest distances to r_q before a query, which only lowers them. Runs once for each i that is an index of
/// a vertex, an edge or a triangle.
struct ResetDistances {
  const float* query_radius;  ///< r_q [m], on the backend
  const int* overflow;        ///< on the backend; if it is not 0 a list was too small, and nothing is written
  int vertex_count, edge_count, triangle_count;
  float *d_min_vertex, *d_min_edge, *d_min_triangle;  ///< by vertex, edge and triangle [m]

  OGC_HD void operator()(int i) const {
    if (*overflow != 0) return;
    if (i < vertex_count) d_min_vertex[i] = *query_radius;
    if (i < edge_count) d_min_edge[i] = *query_radius;
    if (i < triangle_count) d_min_triangle[i] = *query_radius;
  }
};

/// Computes b_v: γ_p times the minimum of the smallest distances of v, of its edges and of its triangles. Runs once for
/// each vertex.
struct ConservativeBound {
  SurfaceView surface;
  /// smallest distances by vertex, edge and triangle, at most r_q (Eq. 22, 24, 26) [m]
  const float *d_min_vertex, *d_min_edge, *d_min_triangle;
  float bounds_relaxation;  ///< γ_p of Eq. 21 [1]
  const int* overflow;      ///< as in ResetDistances
  float* bound;             ///< b_v by vertex [m], at most γ_p r_q; largest_float off the surface

  /// Writes the bound. The product of the two floats is exact in double and is then rounded down.
  OGC_HD void operator()(int v) const {
    if (*overflow != 0) return;
    if (surface.is_off_surface(v)) {
      bound[v] = largest_float;
      return;
    }
    const Rows &vertex_edges = surface.vertex_edges, &vertex_triangles = surface.vertex_triangles;
    float d = d_min_vertex[v];
    for (int k = vertex_edges.offsets[v]; k < vertex_edges.offsets[v + 1]; ++k)
      d = smaller(d, d_min_edge[vertex_edges.items[k]]);
    for (int k = vertex_triangles.offsets[v]; k < vertex_triangles.offsets[v + 1]; ++k)
      d = smaller(d, d_min_triangle[vertex_triangles.items[k]]);
    bound[v] = round_down(mul(static_cast<double>(bounds_relaxation), static_cast<double>(d)));
  }
};

}  // namespace ogc::fast
