// What a step sums up for its row: one functor for each launch of fast/stages/reduce.hpp, kind after kind.
#pragma once

#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/metrics.hpp"
#include "fast/kernels/sweep_view.hpp"

namespace ogc::fast {

/// Adds the chunk's items of one kind: term(i, sums) for every `chunks`-th i below `count`.
template <class Term>
OGC_HD void add_terms(const Term& term, int count, int chunk, int chunks, double* sums) {
  for (int i = chunk; i < count; i += chunks) term(i, sums);
}

/// Momenta, kinetic and gravity energy.
struct VertexSums {
  VertexTerm term;
  int count;  ///< vertices

  /// Those of one chunk.
  OGC_HD void add(int chunk, int chunks, double* sums) const { add_terms(term, count, chunk, chunks, sums); }
};

/// What is left of forces, over free vertices.
struct LeftSums {
  const LeftForce* left;  ///< by slot
  int count;              ///< slots

  /// Those of one chunk, by LeftColumn.
  OGC_HD void add(int chunk, int chunks, double* sums) const {
    for (int i = chunk; i < count; i += chunks) {
      const LeftForce own = left[i];
      sums[left_reference] += own.reference;
      sums[left_held] += own.is_held;
      if (own.is_held != 0) continue;
      sums[left_force] += own.left;
      sums[left_rounding] += own.rounding;
    }
  }
};

/// Energy of the tetrahedra and how many are inverted.
struct TetrahedronSums {
  TetrahedronTerm term;
  int count;  ///< tetrahedra

  /// Those of one chunk.
  OGC_HD void add(int chunk, int chunks, double* sums) const { add_terms(term, count, chunk, chunks, sums); }
};

/// What each step reports.
struct StateSums {
  VertexSums vertices;
  TetrahedronSums tetrahedra;

  /// Those of one chunk.
  OGC_HD void add(int chunk, int chunks, double* sums) const {
    vertices.add(chunk, chunks, sums);
    tetrahedra.add(chunk, chunks, sums);
  }
};

/// The same and the energies of elements and contacts.
struct EnergySums {
  /// Terms, each with the number of its items; how many contacts there are only the device knows.
  StateSums state;
  TriangleTerm triangle;
  int triangles;
  HingeTerm hinge;
  int hinges;
  SpringTerm spring;
  int springs;
  VertexFacetTerm vertex_facet;  ///< as many as its view says, which only the device knows
  EdgeEdgeTerm edge_edge;        ///< likewise

  /// Those of one chunk.
  OGC_HD void add(int chunk, int chunks, double* sums) const {
    state.add(chunk, chunks, sums);
    add_terms(triangle, triangles, chunk, chunks, sums);
    add_terms(hinge, hinges, chunk, chunks, sums);
    add_terms(spring, springs, chunk, chunks, sums);
    add_terms(vertex_facet, *vertex_facet.view.vertex_facet_count, chunk, chunks, sums);
    add_terms(edge_edge, *edge_edge.view.edge_edge_count, chunk, chunks, sums);
  }
};

}  // namespace ogc::fast
