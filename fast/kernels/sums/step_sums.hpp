// Adds up the sums that a step reports. Each functor here is one launch of fast/stages/reduce.hpp.
#pragma once

#include "fast/kernels/contact_stream.hpp"
#include "fast/kernels/kinds/kinds.hpp"
#include "fast/kernels/metrics.hpp"

namespace ogc::fast {

/// Adds term(i, sums) for i = chunk, chunk + chunks, … < count.
template <class Term>
OGC_HD void add_terms(const Term& term, int count, int chunk, int chunks, double* sums) {
  for (int i = chunk; i < count; i += chunks) term(i, sums);
}

/// Sums momenta, kinetic energy and gravity's energy over the vertices.
struct VertexSums {
  VertexTerm term;
  int count;  ///< vertices

  /// Adds every `chunks`-th term, beginning with term `chunk`.
  OGC_HD void add(int chunk, int chunks, double* sums) const { add_terms(term, count, chunk, chunks, sums); }
};

/// Sums the forces that a step leaves on free vertices (LeftForce).
struct LeftSums {
  const LeftForce* left;  ///< by slot
  int count;              ///< slots

  /// Adds every `chunks`-th term, beginning with term `chunk`, to `sums`, which LeftColumn indexes.
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

/// Holds the elements of all kinds in a KindList.
template <class List>
struct AllElements;
template <class... All>
struct AllElements<KindList<All...>> : ElementsView<All>... {
  /// Adds the energies of the elements chunk, chunk + chunks, … of each kind. If `all` is false, only the kinds with
  /// `reports_state` are added.
  template <bool all>
  OGC_HD void add(int chunk, int chunks, double* sums) const {
    (add_kind<all, All>(chunk, chunks, sums), ...);
  }

 private:
  template <bool all, class Kind>
  OGC_HD void add_kind(int chunk, int chunks, double* sums) const {
    const ElementsView<Kind>& own = *this;
    if constexpr ((all || Kind::reports_state) && requires { Kind::add_energy(own, 0, sums); })
      for (int i = chunk; i < own.count; i += chunks) Kind::add_energy(own, i, sums);
  }
};

/// Sums what every step reports: the sums over vertices, and the kinds of elements with `reports_state`.
struct StateSums {
  VertexSums vertices;
  AllElements<Kinds> elements;

  /// Adds every `chunks`-th term, beginning with term `chunk`.
  OGC_HD void add(int chunk, int chunks, double* sums) const {
    vertices.add(chunk, chunks, sums);
    elements.add<false>(chunk, chunks, sums);
  }
};

/// Sums what StateSums sums, and the energies of all elements and contacts.
struct EnergySums {
  StateSums state;
  VertexFacetTerm vertex_facet;  ///< energies by record; only the device knows the number of records
  EdgeEdgeTerm edge_edge;        ///< energies by record

  /// Adds every `chunks`-th term, beginning with term `chunk`.
  OGC_HD void add(int chunk, int chunks, double* sums) const {
    state.vertices.add(chunk, chunks, sums);
    state.elements.add<true>(chunk, chunks, sums);
    add_terms(vertex_facet, *vertex_facet.view.vertex_facet_count, chunk, chunks, sums);
    add_terms(edge_edge, *edge_edge.view.edge_edge_count, chunk, chunks, sums);
  }
};

}  // namespace ogc::fast
