#include "reference/solvers/vertex_system.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace ogc::reference {
namespace {

using compare::Index;
/// By the own coordinates, to first and second order.
using Own = Derivative<double, 3>;
using OwnTwice = Second<3>;

OwnTwice variable(double value, std::size_t direction) {
  OwnTwice x(value);
  x.slope[direction] = 1;
  return x;
}

template <class T>
Triple<T> own(const Triple<double>& x) {
  if constexpr (std::is_same_v<T, Own>)
    return {T(x[0], 0), T(x[1], 1), T(x[2], 2)};
  else
    return {variable(x[0], 0), variable(x[1], 1), variable(x[2], 2)};
}

/// A function of one measure, as value, slope and curvature.
template <class Energy>
Second<1> along(double measure, Energy energy) {
  Second<1> x(measure);
  x.slope[0] = 1;
  return energy(x);
}

/// Plain positions of a stencil, then with the own vertex as variable.
template <std::size_t Count>
std::array<Triple<double>, Count> plain_corners(const std::array<Index, Count>& vertex, Index self,
                                                const SweepView& x) {
  std::array<Triple<double>, Count> corners{};
  for (std::size_t k = 0; k < Count; ++k)
    if (vertex[k] >= 0) corners[k] = x.at(self, vertex[k]);
  return corners;
}
template <class T, std::size_t Count>
std::array<Triple<T>, Count> with_own(const std::array<Triple<double>, Count>& corners, std::size_t place) {
  std::array<Triple<T>, Count> x;
  for (std::size_t k = 0; k < Count; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis) x[k][axis] = T(corners[k][axis]);
  x[place] = own<T>(corners[place]);
  return x;
}

void add_force(double slope, const std::array<double, 3>& gradient, VertexSystem& sum) {
  for (std::size_t i = 0; i < 3; ++i) sum.force[i] -= slope * gradient[i];
}

void add_outer(double weight, const std::array<double, 3>& a, const std::array<double, 3>& b, VertexSystem& sum) {
  for (std::size_t i = 0, k = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j, ++k) sum.block[k] += 0.5 * weight * (a[i] * b[j] + a[j] * b[i]);
}

void add_identity(double weight, VertexSystem& sum) {
  for (const std::size_t k : {0u, 3u, 5u}) sum.block[k] += weight;
}

/// The material part of an energy of the strain.
void add_strain(const Strain<OwnTwice>& g, const OwnTwice& energy, VertexSystem& sum) {
  for (std::size_t i = 0, k = 0; i < 3; ++i) {
    add_force(energy.slope[i], g[i].slope, sum);
    for (std::size_t j = 0; j <= i; ++j, ++k) add_outer((i == j ? 1 : 2) * energy.bend(k), g[i].slope, g[j].slope, sum);
  }
}

/// Where stiff, the part of the elastic stress: G is a quadratic function whose second derivative is a multiple of the
/// identity.
void add_geometric(const Strain<OwnTwice>& g, const OwnTwice& elastic, VertexSystem& sum) {
  double geometric = 0;
  for (std::size_t i = 0; i < 3; ++i) geometric += elastic.slope[i] * g[i].bend(0);
  add_identity(std::max(0.0, geometric), sum);
}

/// Slope and exact second derivative.
void add_exactly(const OwnTwice& energy, VertexSystem& sum) {
  add_force(1, energy.slope, sum);
  for (std::size_t i = 0, k = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k) {
      std::array<double, 3> a{}, b{};
      a[i] = b[j] = 1;
      add_outer((i == j ? 1 : 2) * energy.bend(k), a, b, sum);
    }
}

/// The exact second derivative, with its eigenvalue along the normal as max(0, ·).
void add_neo_hookean(const OwnTwice& energy, const Triple<double>& normal, VertexSystem& sum) {
  add_exactly(energy, sum);
  Triple<double> along{};
  for (std::size_t i = 0, k = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k) {
      along[i] += energy.bend(k) * normal[j];
      if (i != j) along[j] += energy.bend(k) * normal[i];
    }
  const double squared = dot(normal, normal);
  if (squared > 0) add_outer(std::max(0.0, -dot(normal, along) / squared) / squared, normal, normal, sum);
}

void add_membrane(const MembraneTerm& term, std::size_t place, const std::array<Triple<double>, 3>& corners,
                  VertexSystem& sum) {
  const Deformation<OwnTwice> f = deformation<OwnTwice>(with_own<OwnTwice>(corners, place), term.gradient);
  const Strain<OwnTwice> g = strain(f);
  Strain<OwnTwice> by_strain;
  for (std::size_t i = 0; i < 3; ++i) by_strain[i] = variable(g[i].value, i);
  if (term.damping > 0) add_strain(g, term.damping_of(by_strain), sum);
  if (term.neo_hookean()) {
    const Deformation<double> plain_f = deformation<double>(corners, term.gradient);
    return add_neo_hookean(term.elastic_of(f), cross(plain_f[0], plain_f[1]), sum);
  }
  const OwnTwice elastic = term.elastic_of(by_strain);
  add_strain(g, elastic, sum);
  add_geometric(g, elastic, sum);
}

void add_isometric(const HingeTerm& term, const Hinge<Own>& x, VertexSystem& sum) {
  add_force(1, term.isometric_energy(x).slope, sum);
  for (const Own& component : separation(term.weight, x))
    add_outer(term.stiffness, component.slope, component.slope, sum);
}

void add_hinge(const HingeTerm& term, std::size_t place, const std::array<Triple<double>, 4>& corners,
               VertexSystem& sum) {
  const Hinge<Own> x = with_own<Own>(corners, place);
  if (term.isometric) add_isometric(term, x, sum);
  if (term.isometric && term.damping == 0) return;
  const Fold<Own> fold(x);
  if (fold.collapsed()) return;
  const Own angle = fold.angle();
  const Second<1> energy = along(angle.value, [&](const Second<1>& a) { return term.energy_of(a); });
  add_force(energy.slope[0], angle.slope, sum);
  add_outer(energy.bend(0), angle.slope, angle.slope, sum);
}

/// w² k_s (n nᵀ + max(0, 1 − l₀/l)(I − n nᵀ)), and w² k k_s n nᵀ of the damping; w² k_s I where l = 0
/// (compare/stages/spring.hpp).
void add_spring(const SpringTerm& term, std::size_t place, const std::array<Triple<double>, 4>& ends,
                VertexSystem& sum) {
  const std::array<Triple<Own>, 4> x = with_own<Own>(ends, place);
  const Triple<Own> apart = separation(term.weight, x);
  const Own length = sqrt(dot(apart, apart));
  const double squared_weight = term.weight[place] * term.weight[place];
  if (length.value == 0) return add_identity(squared_weight * term.stiffness, sum);
  const double across = std::max(0.0, 1 - term.rest_length / length.value);
  add_force(1, term.energy(x).slope, sum);
  add_identity(squared_weight * term.stiffness * across, sum);
  add_outer(term.stiffness * (1 - across + term.damping), length.slope, length.slope, sum);
}

/// The exact second derivative of the elastic part, the material part of the damping.
void add_tetrahedron(const TetrahedronTerm& term, std::size_t place, const std::array<Triple<double>, 4>& corners,
                     VertexSystem& sum) {
  const SolidDeformation<OwnTwice> f = solid_deformation<OwnTwice>(with_own<OwnTwice>(corners, place), term.gradient);
  add_exactly(term.elastic_of(f), sum);
  if (term.damping == 0) return;
  const SolidStrain<OwnTwice> g = solid_strain(f);
  SolidStrain<Second<6>> by_strain;
  for (std::size_t i = 0; i < 6; ++i) {
    by_strain[i] = Second<6>(g[i].value);
    by_strain[i].slope[i] = 1;
  }
  const Second<6> energy = term.damping_of(by_strain);
  for (std::size_t i = 0, k = 0; i < 6; ++i) {
    add_force(energy.slope[i], g[i].slope, sum);
    for (std::size_t j = 0; j <= i; ++j, ++k) add_outer((i == j ? 1 : 2) * energy.bend(k), g[i].slope, g[j].slope, sum);
  }
}

/// Of a contact's vertices those that are updated at the same time, the own one among them.
using Updated = std::array<bool, 4>;

/// Σ |w_u| over the vertices that are updated, in units of the own one's |w|: what their blocks are multiplied by, so
/// that they majorise what all of them do (method.md §7.4). Any number where the own one's weight is 0.
double majorant(const ClosestForm& form, const Updated& updated, std::size_t own) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += updated[k] ? std::abs(form.weight[k]) : 0;
  return form.weight[own] == 0 ? 1 : sum / std::abs(form.weight[own]);
}

void add_friction(const FrictionTerm& term, double factor, const std::array<Triple<Own>, 4>& x, VertexSystem& sum) {
  const Triple<Own> slip = term.slip(x);
  const Own squared = dot(slip, slip);
  const double slope = along(squared.value, [&](const Second<1>& s) { return term.energy_of(s); }).slope[0];
  add_force(slope, squared.slope, sum);
  for (const Own& component : slip) add_outer(2 * factor * slope, component.slope, component.slope, sum);
}

/// Slope and curvature below 2⁻²³ r are those there, as in the stage contact_force.
void add_contact(const Potential& potential, const ContactTerm& term, const Updated& updated, std::size_t place,
                 const std::array<Triple<double>, 4>& corners, VertexSystem& sum) {
  const ClosestForm form = closest_form(term.sides, corners);
  const std::array<Triple<Own>, 4> x = with_own<Own>(corners, place);
  const Triple<Own> apart = separation(form.weight, x);
  const Own distance = sqrt(dot(apart, apart));
  if (distance.value == 0 || distance.value >= term.radius) return;
  const Second<1> energy = along(std::max(distance.value, 0x1p-23 * term.radius), [&](const Second<1>& d) {
    return contact_activation(term.activation, d, term.radius, term.mollifier * term.stiffness);
  });
  add_force(energy.slope[0], distance.slope, sum);
  const double factor = majorant(form, updated, place);
  add_outer(factor * energy.bend(0), distance.slope, distance.slope, sum);
  if (const auto friction = potential.friction_at(term, corners)) add_friction(*friction, factor, x, sum);
}

}  // namespace

template <class Terms>
void VertexSystems::list(const Terms& terms, Parts& parts) const {
  parts.assign(potential_.mobility().size(), {});
  for (std::size_t i = 0; i < terms.size(); ++i)
    for (std::size_t k = 0; k < terms[i].vertex.size() && terms[i].vertex[k] >= 0; ++k) {
      const auto v = static_cast<std::size_t>(terms[i].vertex[k]);
      if (potential_.mobility()[v] == Mobility::free)
        parts[v].push_back({static_cast<std::uint32_t>(i), static_cast<std::uint8_t>(k)});
    }
}

VertexSystems::VertexSystems(const Potential& potential) : potential_(potential) {
  list(potential.membranes(), membranes_);
  list(potential.hinges(), hinges_);
  list(potential.springs(), springs_);
  list(potential.tetrahedra(), tetrahedra_);
}

void VertexSystems::read_contacts() { list(potential_.contacts(), contacts_); }

VertexSystem VertexSystems::at(Index vertex, const SweepView& x) const {
  const auto v = static_cast<std::size_t>(vertex);
  const double inertia = potential_.inertia(v);
  VertexSystem sum;
  for (std::size_t axis = 0; axis < 3; ++axis)
    sum.force[axis] = inertia * (potential_.target()[v][axis] - x.old[v][axis]);
  add_identity(inertia, sum);
  for (const Part& part : membranes_[v]) {
    const MembraneTerm& term = potential_.membranes()[part.stencil];
    add_membrane(term, part.place, plain_corners(term.vertex, vertex, x), sum);
  }
  for (const Part& part : hinges_[v]) {
    const HingeTerm& term = potential_.hinges()[part.stencil];
    add_hinge(term, part.place, plain_corners(term.vertex, vertex, x), sum);
  }
  for (const Part& part : springs_[v]) {
    const SpringTerm& term = potential_.springs()[part.stencil];
    add_spring(term, part.place, plain_corners(term.vertex, vertex, x), sum);
  }
  for (const Part& part : tetrahedra_[v]) {
    const TetrahedronTerm& term = potential_.tetrahedra()[part.stencil];
    add_tetrahedron(term, part.place, plain_corners(term.vertex, vertex, x), sum);
  }
  for (const Part& part : contacts_[v]) {
    const ContactTerm& term = potential_.contacts()[part.stencil];
    Updated updated{};
    for (std::size_t k = 0; k < 4; ++k) {
      const Index u = term.vertex[k];
      updated[k] = u == vertex || (u >= 0 && x.colour[static_cast<std::size_t>(u)] == x.colour[v]);
    }
    add_contact(potential_, term, updated, part.place, plain_corners(term.vertex, vertex, x), sum);
  }
  return sum;
}

double VertexSystems::mean_force(const State& x) const {
  const std::vector<Index> colour(x.size(), 0);
  std::vector<double> force(x.size(), 0);
  tbb::parallel_for(std::size_t{0}, x.size(), [&](std::size_t v) {
    if (potential_.mobility()[v] != Mobility::free) return;
    const Triple<double> f = at(static_cast<Index>(v), {x, x, colour}).force;
    force[v] = std::hypot(f[0], f[1], f[2]);
  });
  double sum = 0;
  for (const double f : force) sum += f;
  return potential_.free_count() > 0 ? sum / static_cast<double>(potential_.free_count()) : 0;
}

}  // namespace ogc::reference
