// The 3×3 system of one vertex in double, for whole runs: the sum of the forces and blocks of its stencils (method.md
// §4). The file of each energy derives force and block of its elements (kinds/kinds.hpp). The judged sweep
// (vertex_terms.hpp) sums the answers of the force stages for single-precision positions, with errors. The force stages
// compute blocks with the same functions as this file, over another number type.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/energies/vertex_block.hpp"
#include "reference/solvers/potential.hpp"
#include "reference/solvers/variants/settings.hpp"

namespace ogc::reference {

/// Force and block of a vertex, including inertia, which makes the block positive definite.
using VertexSystem = VertexSystemOf<double>;

/// Returns H⁻¹ a; H is the block.
Triple<double> solved(const VertexSystem& system, const Triple<double>& a);

/// The positions that an update reads (method.md §7.2): the new position of a vertex whose colour is lower than that of
/// the updated vertex, otherwise the old position. Free vertices have colours from 0 on. Prescribed and fixed vertices
/// have −1, because they move first.
struct SweepView {
  const State& old;
  const State& fresh;
  std::span<const compare::Index> colour;
  /// Returns the position of `vertex` that the update of `own` reads [m].
  const Triple<double>& at(compare::Index own, compare::Index vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return colour[v] < colour[static_cast<std::size_t>(own)] ? fresh[v] : old[v];
  }
};

/// Computes the systems of the vertices of one potential.
class VertexSystems {
 public:
  /// The potential must outlive this.
  explicit VertexSystems(const Potential& potential, ContactBlocks blocks = ContactBlocks::majorised);
  /// Lists the potential's contacts by vertex. Must be called after the contacts have changed.
  void read_contacts();
  /// Returns the system of a free vertex. λ, n and w of friction come from the positions that the update reads.
  VertexSystem at(compare::Index vertex, const SweepView& x) const;
  /// Returns ‖f‖ of each vertex [N]; 0 for a vertex that is not free.
  std::vector<double> forces(const State& x) const;
  /// Returns the mean ‖f‖ over free vertices [N], the numerator of the residual in Eq. 29.
  double mean_force(const State& x) const;
  /// Returns the mean of forces(x) over free vertices.
  double mean_over_free(const std::vector<double>& force) const;

 private:
  /// A stencil and the vertex's place in it.
  struct Incidence {
    std::uint32_t stencil = 0;
    std::uint8_t place = 0;
  };
  using Incidences = std::vector<std::vector<Incidence>>;  ///< by vertex; empty if not free
  template <class Terms>
  void list(const Terms& terms, Incidences& incidences) const;

  const Potential& potential_;
  ContactBlocks blocks_;
  std::array<Incidences, kind_count> elements_;  ///< by kind
  Incidences contacts_, volumes_;
};

}  // namespace ogc::reference
