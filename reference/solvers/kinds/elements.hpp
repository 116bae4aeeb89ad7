// Holds the elements of one kind in double, for whole runs: a list of terms, and the functions that are the same for
// each kind. kinds.hpp describes the members of a kind.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "compare/problem/scene.hpp"
#include "compare/stages/rest_state.hpp"
#include "reference/energies/stencils/stencil_kernels.hpp"

namespace ogc::reference {

/// Positions of all vertices [m].
using State = std::vector<Triple<double>>;

/// Returns the positions of the first `Count` of these vertices [m].
template <std::size_t Count, class Vertices>
std::array<Triple<double>, Count> gathered(const Vertices& vertex, const State& x) {
  std::array<Triple<double>, Count> corners;
  for (std::size_t k = 0; k < Count; ++k) corners[k] = x[static_cast<std::size_t>(vertex[k])];
  return corners;
}

/// Number of vertices of an element of a kind.
template <class Kind>
constexpr std::size_t corner_count =
    std::tuple_size_v<decltype(Kind::corners(std::declval<typename Kind::Term>(), std::declval<State>()))>;

/// Differentiates a batch of elements with the kernel for this machine (kernels.hpp).
template <class Kind>
void differentiate_batch(const Batch<typename Kind::Term, corner_count<Kind>>& batch, HessianProjection projection);

/// All elements of a kind, in the order of the rest state.
template <class Kind>
class Elements {
 public:
  using Term = typename Kind::Term;  ///< one element

  /// Takes the elements of a rounded scene and its rest state.
  Elements(const compare::Scene& scene, const compare::RestStateOut& rest) {
    for (std::size_t i = 0; i < Kind::elements(scene, rest).size(); ++i) terms_.push_back(Kind::term(scene, rest, i));
  }

  /// Returns the elements in the order of the rest state, each with its vertices.
  std::span<const Term> terms() const { return terms_; }
  std::size_t size() const { return terms_.size(); }  ///< number of elements
  /// Returns the vertices of an element; the last one is −1 if the element has three.
  std::array<compare::Index, 4> vertices(std::size_t stencil) const {
    std::array<compare::Index, 4> all{-1, -1, -1, -1};
    std::ranges::copy(terms_[stencil].vertex, all.begin());
    return all;
  }
  /// Returns the largest number of vertices of an element. The first unknowns of an element are its vertices.
  static std::size_t corners(std::size_t) { return 4; }

  /// Sets xᵗ, the positions at the start of the step, for damping.
  void begin(const State& start) {
    for (Term& term : terms_) Kind::begin(term, start);
  }
  /// Returns the energy of an element, damping included [J].
  double energy(std::size_t stencil, const State& x) const {
    return terms_[stencil].energy(Kind::corners(terms_[stencil], x));
  }
  /// Adds the energies of all elements without damping [J].
  void add_elastic(const State& x, double& sum) const {
    for (const Term& term : terms_) sum += term.elastic(Kind::corners(term, x));
  }

  /// Writes the derivatives of all elements to to[0], to[1], … in batches of consecutive elements, because elements of
  /// one body are alike. Calls `finished` with the number of each element, on the thread that computed it.
  template <class Finished>
  void differentiate(const State& x, HessianProjection projection, StencilDerivatives* to, Finished finished) const {
    tbb::parallel_for(std::size_t{0}, (size() + batch_width - 1) / batch_width, [&](std::size_t number) {
      const std::size_t begin = number * batch_width, end = std::min(size(), begin + batch_width);
      Batch<Term, corner_count<Kind>> batch;
      for (std::size_t i = begin; i < end; ++i) batch.add(terms_[i], Kind::corners(terms_[i], x), to[i]);
      differentiate_batch<Kind>(batch, projection);
      for (std::size_t i = begin; i < end; ++i) finished(i);
    });
  }

 private:
  std::vector<Term> terms_;
};

}  // namespace ogc::reference
