#include "reference/solvers/potential_batches.hpp"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace ogc::reference {
namespace {

std::size_t vertex_count(FormKind form) { return form == FormKind::points ? 2 : form == FormKind::point_line ? 3 : 4; }

/// A contact prepared for its kernel, with the features that hold the contact points.
struct Prepared {
  PlacedContact term;
  std::array<Triple<double>, 4> corner;           ///< positions of the vertices, in the order of ClosestForm::at
  std::array<std::uint8_t, 4> place{0, 1, 2, 3};  ///< places of these vertices among the contact's vertices
};

/// Prepares a contact term at x and returns its group. A group has the same closest features and the same branch of the
/// activation, so its members are evaluated together. Returns `left_out` if the contact does not act.
std::uint8_t prepare(const ContactTerm& term, const State& x, Prepared& to) {
  const std::array<Triple<double>, 4> corners = contact_corners(term.sides, term.vertex, x);
  const ClosestForm form = closest_form(term.sides, corners);
  const double distance = form_distance(form, corners);
  if (distance >= term.contact_radius) return left_out;
  to = {{term, form.weight, form.kind}, corners};
  if (form.kind != FormKind::fixed_weights)
    for (std::size_t k = 0; k < vertex_count(form.kind); ++k) to.corner[k] = corners[to.place[k] = form.at[k]];
  return static_cast<std::uint8_t>(2 * static_cast<int>(form.kind) + (2 * distance < term.contact_radius ? 1 : 0));
}

template <std::size_t Count>
void differentiate(const Bundle& bundle, const std::vector<Prepared>& contacts,
                   StencilKernels::Function<PlacedContact, Count> kernel, HessianProjection projection,
                   StencilDerivatives* to) {
  Batch<PlacedContact, Count> batch;
  for (std::size_t k = 0; k < bundle.size; ++k) {
    const Prepared& contact = contacts[bundle.member[k]];
    std::array<Triple<double>, Count> corners;
    std::array<std::uint8_t, Count> places;
    for (std::size_t c = 0; c < Count; ++c) corners[c] = contact.corner[c], places[c] = contact.place[c];
    batch.add(contact.term, corners, places, to[bundle.member[k]]);
  }
  kernel(batch, projection);
}

void differentiate(const Bundle& bundle, const std::vector<Prepared>& contacts, HessianProjection projection,
                   StencilDerivatives* to) {
  const StencilKernels& kernels = stencil_kernels();
  switch (static_cast<FormKind>(bundle.group / 2)) {
    case FormKind::points: return differentiate<2>(bundle, contacts, kernels.contacts_of_2, projection, to);
    case FormKind::point_line: return differentiate<3>(bundle, contacts, kernels.contacts_of_3, projection, to);
    case FormKind::fixed_weights: return differentiate<4>(bundle, contacts, kernels.weighted_contacts, projection, to);
    case FormKind::point_plane:
    case FormKind::lines: return differentiate<4>(bundle, contacts, kernels.contacts_of_4, projection, to);
  }
}

}  // namespace

std::vector<Bundle> bundled(const std::vector<std::uint8_t>& group) {
  std::vector<Bundle> full, open(left_out);
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (group[i] == left_out) continue;
    Bundle& bundle = open[group[i]];
    bundle.group = group[i];
    bundle.member[bundle.size++] = static_cast<std::uint32_t>(i);
    if (bundle.size < batch_width) continue;
    full.push_back(bundle);
    bundle = {};
  }
  std::copy_if(open.begin(), open.end(), std::back_inserter(full),
               [](const Bundle& bundle) { return bundle.size > 0; });
  return full;
}

void differentiate(std::span<const ContactTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished) {
  std::vector<Prepared> contacts(terms.size());
  std::vector<std::uint8_t> group(terms.size());
  tbb::parallel_for(std::size_t{0}, terms.size(), [&](std::size_t i) {
    group[i] = prepare(terms[i], x, contacts[i]);
    if (group[i] != left_out) return;
    to[i] = {};
    finished(i);
  });
  const std::vector<Bundle> bundles = bundled(group);
  tbb::parallel_for(std::size_t{0}, bundles.size(), [&](std::size_t b) {
    differentiate(bundles[b], contacts, projection, to);
    for (std::size_t k = 0; k < bundles[b].size; ++k) finished(bundles[b].member[k]);
  });
}

/// Differentiates contacts with volumes one by one, because they are few compared with contacts between surfaces.
void differentiate(std::span<const VolumeTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished) {
  tbb::parallel_for(std::size_t{0}, terms.size(), [&](std::size_t i) {
    to[i] = stencil_derivatives<4>(gathered<4>(terms[i].vertex, x), projection,
                                   [&](const auto& corners) { return terms[i].energy(corners); });
    finished(i);
  });
}

void differentiate(std::span<const FrictionTerm> terms, const State& x, HessianProjection projection,
                   StencilDerivatives* to, const Finished& finished) {
  std::vector<std::uint8_t> group(terms.size());
  tbb::parallel_for(std::size_t{0}, terms.size(), [&](std::size_t i) {
    const Triple<double> slip = terms[i].slip(contact_corners(terms[i].sides, terms[i].vertex, x));
    const double squared = dot(slip, slip);
    group[i] = squared == 0 ? 0 : std::sqrt(squared) < terms[i].limit ? 1 : 2;
  });
  const std::vector<Bundle> bundles = bundled(group);
  tbb::parallel_for(std::size_t{0}, bundles.size(), [&](std::size_t b) {
    Batch<FrictionTerm, 4> batch;
    for (std::size_t k = 0; k < bundles[b].size; ++k) {
      const std::size_t i = bundles[b].member[k];
      batch.add(terms[i], contact_corners(terms[i].sides, terms[i].vertex, x), to[i]);
    }
    stencil_kernels().frictions(batch, projection);
    for (std::size_t k = 0; k < bundles[b].size; ++k) finished(bundles[b].member[k]);
  });
}

}  // namespace ogc::reference
