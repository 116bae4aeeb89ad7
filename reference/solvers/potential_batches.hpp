// Differentiates the stencils of contacts in batches, in parallel over the batches. All contacts of a batch have the
// same kind of closest features (energies/stencils/stencil_kernels.hpp). Each stencil writes to a separate place of the
// result, so the result depends neither on the number of threads nor on the other stencils of a batch.
#pragma once

#include <functional>
#include <span>

#include "reference/energies/stencils/stencil_kernels.hpp"
#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// Up to batch_width terms of one group, which are evaluated together.
struct Bundle {
  std::uint8_t group = 0;
  std::uint8_t size = 0;
  std::array<std::uint32_t, batch_width> member{};
};
/// Group of the terms that are not evaluated.
constexpr std::uint8_t left_out = 255;
/// Divides terms into bundles, each with terms of one group. `group` has the group of each term. The terms of a group
/// should take the same branches.
std::vector<Bundle> bundled(const std::vector<std::uint8_t>& group);

/// Called by `differentiate` for each finished stencil, on the thread that computed it.
using Finished = std::function<void(std::size_t stencil)>;

/// Writes the derivatives of all terms at x to to[0], to[1], …
void differentiate(std::span<const ContactTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);
void differentiate(std::span<const VolumeTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);
void differentiate(std::span<const FrictionTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished);

/// Returns the positions of a contact's vertices, always four; unused entries are 0.
inline std::array<Triple<double>, 4> contact_corners(compare::ContactSides sides,
                                                     const std::array<compare::Index, 4>& vertex, const State& x) {
  std::array<Triple<double>, 4> corners{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(vertex_count(sides)); ++k)
    corners[k] = x[static_cast<std::size_t>(vertex[k])];
  return corners;
}

}  // namespace ogc::reference
