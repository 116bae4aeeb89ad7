// Differentiates the stencils of contacts in batches of one form (energies/stencils/stencil_kernels.hpp), in parallel
// over the batches. Each stencil has its own place in the result, so neither threads nor other stencils of a batch
// change a bit.
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
/// Group number of members without a bundle.
constexpr std::uint8_t left_out = 255;
/// Sorts members into bundles; `group` is the group of each member. Members with the same branches should have one
/// group.
std::vector<Bundle> bundled(const std::vector<std::uint8_t>& group);

/// Called by `differentiate` for each finished stencil, on the thread that computed it.
using Finished = std::function<void(std::size_t stencil)>;

/// Writes the derivatives of all terms at x into the places from `to` on.
void differentiate(std::span<const ContactTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);
void differentiate(std::span<const VolumeTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);
void differentiate(std::span<const FrictionTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);

/// Returns the positions of a contact's four places; unused places are at the origin.
inline std::array<Triple<double>, 4> contact_corners(compare::ContactSides sides,
                                                     const std::array<compare::Index, 4>& vertex, const State& x) {
  std::array<Triple<double>, 4> corners{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(sides)); ++k)
    corners[k] = x[static_cast<std::size_t>(vertex[k])];
  return corners;
}

}  // namespace ogc::reference
