// Computes the derivatives of several stencils of one kind at once, for Newton's method. The functions are compiled for
// several machines. On every machine the result has the same bits as stencil_derivatives.hpp gives for each stencil
// alone.
#pragma once

#include "reference/energies/stencil_terms.hpp"
#include "reference/energies/stencils/stencil_derivatives.hpp"

namespace ogc::reference {

/// Number of stencils that are projected at once.
constexpr std::size_t batch_width = 8;

/// Some stencils of one kind, with their corners and the destinations of their derivatives.
template <class Term, std::size_t Count>
struct Batch {
  std::size_t size = 0;  ///< at most batch_width, at least 1
  std::array<const Term*, batch_width> term{};
  std::array<std::array<Triple<double>, Count>, batch_width> corner{};
  /// By corner: its index among the vertices of the result's gradient and Hessian.
  std::array<std::array<std::uint8_t, Count>, batch_width> place{};
  std::array<StencilDerivatives*, batch_width> result{};

  /// Adds a stencil whose corner k is vertex k of the result.
  void add(const Term& with, const std::array<Triple<double>, Count>& at, StencilDerivatives& to) {
    std::array<std::uint8_t, Count> places;
    for (std::size_t k = 0; k < Count; ++k) places[k] = static_cast<std::uint8_t>(k);
    add(with, at, places, to);
  }
  /// Adds a stencil whose corner k is vertex places[k] of the result.
  void add(const Term& with, const std::array<Triple<double>, Count>& at, const std::array<std::uint8_t, Count>& places,
           StencilDerivatives& to) {
    term[size] = &with;
    corner[size] = at;
    place[size] = places;
    result[size++] = &to;
  }
};

/// A contact as a function of the two to four vertices that its closest form uses. If the closest form has fixed
/// weights, these are always four.
template <class Number>
struct PlacedContactOf {
  ContactTermOf<Number> contact;
  std::array<Number, 4> weight{};
  FormKind form = FormKind::points;

  /// Returns the energy at the vertices of the closest form [J].
  template <class T, std::size_t N>
  T energy(const std::array<Triple<T>, N>& x) const {
    return contact.energy(ClosestForm{form, {0, 1, 2, 3}, {}}, x);
  }
  /// Returns the energy for a closest form with fixed weights [J]; `apart` is Σ wᵢ xᵢ.
  template <class T>
  T energy_between(const Triple<T>& apart) const {
    using std::sqrt;
    return contact.energy_at(T(sqrt(dot(apart, apart))));
  }
  auto numbers() { return std::tuple_cat(contact.numbers(), std::tie(weight)); }
  auto numbers() const { return std::tuple_cat(contact.numbers(), std::tie(weight)); }
  auto kinds() { return std::tuple_cat(contact.kinds(), std::tie(form)); }
  auto kinds() const { return std::tuple_cat(contact.kinds(), std::tie(form)); }
};
/// A contact over doubles.
using PlacedContact = PlacedContactOf<double>;

/// Kernels for contacts and friction, compiled for one machine; solvers/kinds/kernels.hpp has the kernels for elements.
struct StencilKernels {
  template <class Term, std::size_t Count>
  using Function = void (*)(const Batch<Term, Count>& batch, HessianProjection projection);
  Function<PlacedContact, 2> contacts_of_2;  ///< for closest forms of two vertices
  Function<PlacedContact, 3> contacts_of_3;
  Function<PlacedContact, 4> contacts_of_4;
  /// differentiates contacts whose energy depends on Σ wᵢ xᵢ alone; missing vertices have the weight 0
  Function<PlacedContact, 4> weighted_contacts;
  Function<FrictionTerm, 4> frictions;
};

/// Kernels for any machine, and for one with AVX2.
extern const StencilKernels stencil_kernels_baseline, stencil_kernels_avx2;

/// Returns whether both this program and this machine have AVX2.
bool has_avx2();
/// Returns the kernels for this machine.
const StencilKernels& stencil_kernels();

}  // namespace ogc::reference
