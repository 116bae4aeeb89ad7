// The elements of one kind in double, for whole runs. A kind is a struct that says all that solvers ask (kinds.hpp);
// this is the list of its terms, with what is the same for each kind.
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

/// Where the first `Count` of these vertices are [m].
template <std::size_t Count, class Vertices>
std::array<Triple<double>, Count> gathered(const Vertices& vertex, const State& x) {
  std::array<Triple<double>, Count> corners;
  for (std::size_t k = 0; k < Count; ++k) corners[k] = x[static_cast<std::size_t>(vertex[k])];
  return corners;
}

/// How many vertices an element of a kind has.
template <class Kind>
constexpr std::size_t corner_count =
    std::tuple_size_v<decltype(Kind::corners(std::declval<typename Kind::Term>(), std::declval<State>()))>;

/// Differentiates a batch of elements on this machine (kernels.hpp).
template <class Kind>
void differentiate_batch(const Batch<typename Kind::Term, corner_count<Kind>>& batch, HessianProjection projection);

/// All elements of a kind, in the order of the rest state.
template <class Kind>
class Elements {
 public:
  using Term = typename Kind::Term;  ///< one of them

  /// Takes the elements of a rounded scene and its rest state.
  Elements(const compare::Scene& scene, const compare::RestStateOut& rest) {
    for (std::size_t i = 0; i < Kind::elements(scene, rest).size(); ++i) terms_.push_back(Kind::term(scene, rest, i));
  }

  /// The elements in the order of the rest state, each with its vertices.
  std::span<const Term> terms() const { return terms_; }
  std::size_t size() const { return terms_.size(); }  ///< the number of its stencils
  /// The vertices of a stencil; −1 in the last place where it has three.
  std::array<compare::Index, 4> vertices(std::size_t stencil) const {
    std::array<compare::Index, 4> all{-1, -1, -1, -1};
    std::ranges::copy(terms_[stencil].vertex, all.begin());
    return all;
  }
  /// How many of its unknowns, the first ones, are vertices at most.
  static std::size_t corners(std::size_t) { return 4; }

  /// xᵗ: what damping counts from.
  void begin(const State& start) {
    for (Term& term : terms_) Kind::begin(term, start);
  }
  /// Damping included [J].
  double energy(std::size_t stencil, const State& x) const {
    return terms_[stencil].energy(Kind::corners(terms_[stencil], x));
  }
  /// Adds the energy of each without damping [J].
  void add_elastic(const State& x, double& sum) const {
    for (const Term& term : terms_) sum += term.elastic(Kind::corners(term, x));
  }

  /// Into the places behind `to`, in batches of terms in their order: those of one body are alike. Calls `finished`
  /// with the number of each stencil, on the thread that did it.
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
