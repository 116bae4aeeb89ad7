#include "reference/solvers/vertex_system.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <Eigen/Dense>

namespace ogc::reference {
namespace {

using compare::Index;
/// Returns the positions of a stencil's vertices that the update of vertex `self` reads.
template <std::size_t Count>
std::array<Triple<double>, Count> plain_corners(const std::array<Index, Count>& vertex, Index self,
                                                const SweepView& x) {
  std::array<Triple<double>, Count> corners{};
  for (std::size_t k = 0; k < Count; ++k)
    if (vertex[k] >= 0) corners[k] = x.at(self, vertex[k]);
  return corners;
}

/// Holds for each of a contact's four vertices whether it is updated together with the vertex `own`; true for `own`.
using Updated = std::array<bool, 4>;

/// Returns Σ |w_u|/|w|, or 1 if w is 0. Here w is the weight at place `own`, and the sum is over the vertices that are
/// updated together. A block times this factor majorises the energy if all these vertices move at once (method.md
/// §7.4).
double majorant(const std::array<double, 4>& weight, const Updated& updated, std::size_t own) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += updated[k] ? std::abs(weight[k]) : 0;
  return weight[own] == 0 ? 1 : sum / std::abs(weight[own]);
}

/// Returns which of a contact's vertices have the colour of `own`. With ContactBlocks::own returns only `own`.
Updated updated_with(Index own, const std::array<Index, 4>& vertex, const SweepView& x, ContactBlocks blocks) {
  Updated updated{};
  for (std::size_t k = 0; k < 4; ++k) {
    const Index u = vertex[k];
    updated[k] = u == own || (majorises(blocks) && u >= 0 &&
                              x.colour[static_cast<std::size_t>(u)] == x.colour[static_cast<std::size_t>(own)]);
  }
  return updated;
}

void add_friction(const FrictionTerm& term, double factor, const std::array<Triple<ByOwn<double>>, 4>& x,
                  VertexSystem& sum) {
  const Triple<ByOwn<double>> slip = term.slip(x);
  const ByOwn<double> squared = dot(slip, slip);
  const double slope = along(squared.value, [&](const Second<1>& s) { return term.energy_of(s); }).slope[0];
  add_force(slope, squared.slope, sum);
  for (const ByOwn<double>& component : slip)
    add_outer(2 * factor * slope, component.slope, component.slope, sum.block);
}

/// Adds a contact. Slope and curvature of the activation are taken at d, clamped to 2⁻²³ r … r as in the stage
/// contact_force.
void add_contact(const Potential& potential, const ContactTerm& term, const Updated& updated, std::size_t place,
                 const std::array<Triple<double>, 4>& corners, VertexSystem& sum) {
  const ClosestForm form = closest_form(term.sides, corners);
  const std::array<Triple<ByOwn<double>>, 4> x = with_own<ByOwn<double>>(corners, place);
  const Triple<ByOwn<double>> apart = separation(form.weight, x);
  const ByOwn<double> distance = sqrt(dot(apart, apart));
  if (distance.value == 0) return;
  const double acting = std::clamp(distance.value, 0x1p-23 * term.contact_radius, term.contact_radius);
  const Second<1> energy = along(acting, [&](const Second<1>& d) {
    return activation_energy(term.activation, d, term.contact_radius, term.mollifier * term.stiffness);
  });
  add_force(energy.slope[0], distance.slope, sum);
  const double factor = majorant(form.weight, updated, place);
  add_outer(factor * energy.bend(0), distance.slope, distance.slope, sum.block);
  if (const auto friction = potential.friction_at(term, corners)) add_friction(*friction, factor, x, sum);
}

/// Adds a contact with a volume for its point or for one of the triangle's corners.
void add_volume(const VolumeTerm& term, const Updated& updated, std::size_t place,
                const std::array<Triple<double>, 4>& corners, VertexSystem& sum) {
  if (term.weight[place] == 0) return;
  const std::array<Triple<ByOwn<double>>, 4> x = with_own<ByOwn<double>>(corners, place);
  const ByOwn<double> overlap = term.overlap(separation(term.weight, x));
  if (!(overlap.value > 0)) return;
  const double factor = majorant(term.weight, updated, place);
  add_force(term.stiffness * overlap.value, overlap.slope, sum);
  add_outer(factor * term.stiffness, overlap.slope, overlap.slope, sum.block);
  if (term.friction > 0) add_friction(term.friction_at(corners), factor, x, sum);
}

}  // namespace

Triple<double> solved(const VertexSystem& system, const Triple<double>& a) {
  const auto& b = system.block;
  const Eigen::Matrix3d h{{b[0], b[1], b[2]}, {b[1], b[3], b[4]}, {b[2], b[4], b[5]}};
  const Eigen::Vector3d x = h.llt().solve(Eigen::Vector3d(a[0], a[1], a[2]));
  return {x[0], x[1], x[2]};
}

template <class Terms>
void VertexSystems::list(const Terms& terms, Incidences& incidences) const {
  incidences.assign(potential_.mobility().size(), {});
  for (std::size_t i = 0; i < terms.size(); ++i)
    for (std::size_t k = 0; k < terms[i].vertex.size() && terms[i].vertex[k] >= 0; ++k) {
      const auto v = static_cast<std::size_t>(terms[i].vertex[k]);
      if (potential_.mobility()[v] == Mobility::free)
        incidences[v].push_back({static_cast<std::uint32_t>(i), static_cast<std::uint8_t>(k)});
    }
}

VertexSystems::VertexSystems(const Potential& potential, ContactBlocks blocks)
    : potential_(potential), blocks_(blocks) {
  for_each_kind([&]<class Kind, std::size_t number>() { list(potential.elements<Kind>().terms(), elements_[number]); });
  read_contacts();
}

void VertexSystems::read_contacts() {
  list(potential_.contacts(), contacts_);
  list(potential_.volumes(), volumes_);
}

VertexSystem VertexSystems::at(Index vertex, const SweepView& x) const {
  const auto v = static_cast<std::size_t>(vertex);
  const double inertia = potential_.inertia(v);
  VertexSystem sum;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sum.force[axis] = inertia * (potential_.target()[v][axis] - x.old[v][axis]);
  add_identity(inertia, sum.block);
  for_each_kind([&]<class Kind, std::size_t number>() {
    const typename Kind::List& elements = potential_.elements<Kind>();
    for (const Incidence& incidence : elements_[number][v])
      Kind::add(elements, incidence.stencil, incidence.place,
                plain_corners(elements.terms()[incidence.stencil].vertex, vertex, x), sum);
  });
  for (const Incidence& incidence : contacts_[v]) {
    const ContactTerm& term = potential_.contacts()[incidence.stencil];
    add_contact(potential_, term, updated_with(vertex, term.vertex, x, blocks_), incidence.place,
                plain_corners(term.vertex, vertex, x), sum);
  }
  for (const Incidence& incidence : volumes_[v]) {
    const VolumeTerm& term = potential_.volumes()[incidence.stencil];
    add_volume(term, updated_with(vertex, term.vertex, x, blocks_), incidence.place,
               plain_corners(term.vertex, vertex, x), sum);
  }
  return sum;
}

std::vector<double> VertexSystems::forces(const State& x) const {
  const std::vector<Index> colour(x.size(), 0);
  std::vector<double> force(x.size(), 0);
  tbb::parallel_for(std::size_t{0}, x.size(), [&](std::size_t v) {
    if (potential_.mobility()[v] != Mobility::free) return;
    const Triple<double> f = at(static_cast<Index>(v), {x, x, colour}).force;
    force[v] = std::hypot(f[0], f[1], f[2]);
  });
  return force;
}

double VertexSystems::mean_force(const State& x) const { return mean_over_free(forces(x)); }

double VertexSystems::mean_over_free(const std::vector<double>& force) const {
  double sum = 0;
  for (const double f : force) sum += f;
  return potential_.free_count() > 0 ? sum / static_cast<double>(potential_.free_count()) : 0;
}

}  // namespace ogc::reference
