// The stencils of a mesh in batches of one kind (energies/stencils/stencil_kernels.hpp), in parallel over the batches:
// each stencil has its place, so neither threads nor what shares its batch changes a bit.
#pragma once

#include <functional>
#include <span>

#include "reference/energies/stencils/stencil_kernels.hpp"
#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// Up to batch_width members of one group.
struct Bundle {
  std::uint8_t group = 0;
  std::uint8_t size = 0;
  std::array<std::uint32_t, batch_width> member{};
};
/// Members of `left_out` are in none.
constexpr std::uint8_t left_out = 255;
/// By the group of each: members that take the same branches should share one.
std::vector<Bundle> bundled(const std::vector<std::uint8_t>& group);

/// What `differentiate` calls for each stencil that is done, on the thread that did it.
using Finished = std::function<void(std::size_t stencil)>;

/// Derivatives of all terms at x, into the places behind `to`.
void differentiate(std::span<const MembraneTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);
void differentiate(std::span<const HingeTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);
void differentiate(std::span<const SpringTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);
void differentiate(std::span<const TetrahedronTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);
void differentiate(std::span<const ContactTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);
void differentiate(std::span<const VolumeTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);
void differentiate(std::span<const FrictionTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);

template <std::size_t Count, class Vertices>
std::array<Triple<double>, Count> gathered(const Vertices& vertex, const State& x) {
  std::array<Triple<double>, Count> corners;
  for (std::size_t k = 0; k < Count; ++k) corners[k] = x[static_cast<std::size_t>(vertex[k])];
  return corners;
}

/// All four places; those that the contact lacks are at the origin.
inline std::array<Triple<double>, 4> contact_corners(compare::ContactSides sides,
                                                     const std::array<compare::Index, 4>& vertex, const State& x) {
  std::array<Triple<double>, 4> corners{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(sides)); ++k)
    corners[k] = x[static_cast<std::size_t>(vertex[k])];
  return corners;
}

/// Zero where there is no vertex, as its weight is.
inline std::array<Triple<double>, 4> spring_corners(const SpringTerm& term, const State& x) {
  std::array<Triple<double>, 4> corners{};
  for (std::size_t k = 0; k < 4; ++k)
    if (term.vertex[k] >= 0) corners[k] = x[static_cast<std::size_t>(term.vertex[k])];
  return corners;
}

}  // namespace ogc::reference
