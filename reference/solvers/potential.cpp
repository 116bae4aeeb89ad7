#include "reference/solvers/potential.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "compare/problem/error.hpp"
#include "reference/energies/mollifier.hpp"
#include "reference/energies/overlap_share.hpp"
#include "reference/geometry/closest_points.hpp"
#include "reference/solvers/kinds/kernels.hpp"
#include "reference/solvers/kinds/rest_state.hpp"
#include "reference/solvers/potential_batches.hpp"

namespace ogc::reference {
namespace {

using compare::ContactSides;
using compare::Index;

/// Calls `visit` with the positions of the contact's vertices, as an array of two, three or four.
template <class Visit>
auto with_count(ContactSides sides, const std::array<Index, 4>& vertex, const State& x, Visit visit) {
  switch (vertex_count(sides)) {
    case 2: return visit(gathered<2>(vertex, x));
    case 3: return visit(gathered<3>(vertex, x));
    default: return visit(gathered<4>(vertex, x));
  }
}

/// Returns e_k (compare/stages/contact_force.hpp); x holds the single-precision positions of the detection.
double energy_share(const std::array<float, 2>& rest_squared, const std::array<Triple<double>, 4>& x) {
  if (rest_squared[0] > 0 && rest_squared[1] > 0) {
    const Mollifier<double> mollifier(x[1] - x[0], x[3] - x[2], rest_squared[0], rest_squared[1]);
    return mollifier.acts() ? mollifier.value() : 1;
  }
  if (rest_squared[0] > 0 || rest_squared[1] > 0) return 1;
  const auto seen = [&](std::size_t k) {
    return Vec3f{static_cast<float>(x[k][0]), static_cast<float>(x[k][1]), static_cast<float>(x[k][2])};
  };
  if (!nearly_parallel(EdgePair{{seen(0), seen(1)}, {seen(2), seen(3)}})) return 1;
  return overlap_share(x[1] - x[0], x[3] - x[2], x[2] - x[0]);
}

double energy_of(const ContactTerm& term, const State& x) {
  const ClosestForm form = closest_form(term.sides, contact_corners(term.sides, term.vertex, x));
  return with_count(term.sides, term.vertex, x, [&](const auto& corners) { return term.energy(form, corners); });
}
double energy_of(const VolumeTerm& term, const State& x) { return term.energy(gathered<4>(term.vertex, x)); }
double energy_of(const FrictionTerm& term, const State& x) {
  return with_count(term.sides, term.vertex, x, [&](const auto& corners) { return term.energy(corners); });
}

double largest_coordinate(const State& x) {
  double largest = 0;
  for (const Triple<double>& p : x) largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  return largest;
}

double norm(const Triple<double>& a) { return std::hypot(a[0], a[1], a[2]); }

}  // namespace

State widened(const std::vector<compare::Vec3f>& positions) {
  State state;
  state.reserve(positions.size());
  for (const compare::Vec3f& p : positions) state.push_back({p.x, p.y, p.z});
  return state;
}

std::vector<Mobility> mobility_of(const compare::Scene& scene) {
  std::vector<Mobility> mobility;
  for (const Index group : rigid_groups(scene))
    mobility.push_back(group < 0 ? Mobility::free : group == 0 ? Mobility::fixed : Mobility::prescribed);
  return mobility;
}

Potential::Potential(const compare::Scene& scene, const compare::Topology& topology)
    : scene_(scene),
      topology_(topology),
      rest_(rest_state({&scene, &topology}).exact),
      body_(body_of_vertex(scene)),
      mobility_(mobility_of(scene)),
      mass_(rest_.mass.begin(), rest_.mass.end()),
      step_(scene.settings.time_step),
      elements_(ListsOf<ElementKinds>::made(scene, rest_)) {
  switch (scene.settings.damping) {
    case compare::DampingForm::strain: break;
    case compare::DampingForm::per_vertex:
      throw compare::InputError(
          "damping=per_vertex has no potential, so Newton's method can't minimise one: use --solver vbd, or "
          "damping=strain");
  }
  unknowns_ = mobility_;
  for (std::size_t e = 0; e < rods().segments(); ++e)
    unknowns_.push_back(rods().is_free(e) ? Mobility::free : Mobility::fixed);
  free_count_ = static_cast<std::size_t>(std::count(mobility_.begin(), mobility_.end(), Mobility::free));
}

void Potential::begin_step(const State& start, const State& target) {
  start_ = start;
  target_ = target;
  contacts_.clear();
  frictions_.clear();
  volumes_.clear();
  // RodSystem::begin_step is called elsewhere, because it needs the number of the step.
  const auto begin = [&](auto& list) {
    if constexpr (requires { list.begin(start); }) list.begin(start);
  };
  std::apply([&](auto&... lists) { (begin(lists), ...); }, elements_);
}

void Potential::set_contacts(const ContactSets& sets, const State& previous) {
  contacts_.clear();
  for (const compare::VertexFacetContact& contact : sets.vertex_facet)
    add_contact(stencil_of(topology_, contact), previous);
  for (const compare::EdgeEdgeContact& contact : sets.edge_edge) add_contact(stencil_of(topology_, contact), previous);
  volumes_.clear();
  for (const compare::VolumeContact& contact : sets.volumes) add_contact(contact);
}

void Potential::add_contact(const ContactStencil& stencil, const State& previous) {
  const auto is_free = [&](Index v) { return v >= 0 && mobility_[static_cast<std::size_t>(v)] == Mobility::free; };
  if (std::none_of(stencil.vertex.begin(), stencil.vertex.end(), is_free)) return;
  const compare::MeetingMaterial& material = material_of(rest_, scene_.bodies.size(), body_, stencil);
  if (material.stiffness == 0) return;
  contacts_.push_back({stencil.sides, stencil.vertex, scene_.settings.contact_radius, double{material.stiffness}, 1,
                       double{material.friction}, scene_.settings.contact_activation});
  if (stencil.sides != ContactSides::edge_edge) return;
  const std::array<float, 2> rest_squared = mollified_rest_squared(topology_, rest_, stencil);
  contacts_.back().mollifier = energy_share(rest_squared, gathered<4>(stencil.vertex, previous));
}

void Potential::add_contact(const compare::VolumeContact& contact) {
  const auto body_of = [&](Index v) { return static_cast<std::size_t>(body_[static_cast<std::size_t>(v)]); };
  const compare::Triangle& corners = topology_.triangles[static_cast<std::size_t>(contact.triangle)];
  const auto is_free = [&](Index v) { return mobility_[static_cast<std::size_t>(v)] == Mobility::free; };
  if (!is_free(contact.point) && std::ranges::none_of(corners, is_free)) return;
  const compare::MeetingMaterial& material =
      rest_.meetings[body_of(contact.point) * scene_.bodies.size() + body_of(corners[0])];
  const compare::Vec3f& n = contact.direction;
  VolumeTerm term;
  term.vertex = {contact.point, corners[0], corners[1], corners[2]};
  // The stored weights add up to 1 only up to rounding. They are divided by their sum, because a translation would
  // otherwise cause a force.
  const double sum = double{contact.weights[0]} + double{contact.weights[1]} + double{contact.weights[2]};
  for (std::size_t k = 0; k < 3; ++k) term.weight[k + 1] = -double{contact.weights[k]} / sum;
  term.normal = {double{n.x}, double{n.y}, double{n.z}};
  term.start = separation(term.weight, gathered<4>(term.vertex, start_));
  term.contact_radius = scene_.settings.contact_radius;
  term.stiffness = double{material.stiffness};
  term.friction = double{material.friction};
  term.slip_limit = scene_.settings.friction_velocity * step_;
  volumes_.push_back(term);
}

std::optional<FrictionTerm> Potential::friction_at(const ContactTerm& term,
                                                   const std::array<Triple<double>, 4>& corners) const {
  if (term.friction == 0) return {};
  const ClosestForm form = closest_form(term.sides, corners);
  const Triple<double> apart = separation(form.weight, corners);
  const double distance = norm(apart);
  if (distance == 0 || distance >= term.contact_radius) return {};
  using Slope = Derivative<double, 1>;
  const double slope =
      contact_activation(term.activation, Slope(distance, 0), term.contact_radius, term.stiffness).slope[0];
  return FrictionTerm{term.sides,
                      term.vertex,
                      form.weight,
                      (1 / distance) * apart,
                      separation(form.weight, contact_corners(term.sides, term.vertex, start_)),
                      -term.friction * term.mollifier * slope,
                      scene_.settings.friction_velocity * step_};
}

void Potential::lag_friction(const State& x) {
  frictions_.clear();
  for (const ContactTerm& term : contacts_)
    if (const auto friction = friction_at(term, contact_corners(term.sides, term.vertex, x)))
      frictions_.push_back(*friction);
  for (const VolumeTerm& term : volumes_) {
    const FrictionTerm friction = term.friction_at(gathered<4>(term.vertex, x));
    if (friction.force > 0) frictions_.push_back(friction);
  }
}

template <class Use>
auto Potential::in_its_list(std::size_t stencil, Use use) const {
  decltype(use(contacts_, stencil)) result{};
  const auto in_one = [&](const auto& list) {
    const std::size_t count = list.size();
    if (stencil < count) return result = use(list, stencil), true;
    stencil -= count;
    return false;
  };
  std::apply([&](const auto&... lists) { return (in_one(lists) || ...); },
             std::tuple_cat(std::apply([](const auto&... lists) { return std::tie(lists...); }, elements_),
                            std::tie(contacts_, volumes_, frictions_)));
  return result;
}

std::array<Index, 4> Potential::vertices(std::size_t stencil) const {
  return in_its_list(stencil, [](const auto& list, std::size_t i) -> std::array<Index, 4> {
    if constexpr (requires { list.vertices(i); })
      return list.vertices(i);
    else
      return list[i].vertex;
  });
}

std::vector<std::array<Index, 4>> Potential::vertices() const {
  std::vector<std::array<Index, 4>> all;
  all.reserve(stencil_count());
  for (std::size_t i = 0; i < stencil_count(); ++i) all.push_back(vertices(i));
  return all;
}

std::vector<Mobility> Potential::unknowns() const { return unknowns_; }

std::vector<double> Potential::inertias() const {
  std::vector<double> all;
  for (std::size_t v = 0; v < mass_.size(); ++v) all.push_back(inertia(v));
  for (std::size_t e = 0; e < rods().segments(); ++e) all.push_back(rods().regularisation(e));
  return all;
}

double Potential::stencil_energy(std::size_t stencil, const State& x) const {
  return in_its_list(stencil, [&](const auto& list, std::size_t i) {
    if constexpr (requires { list.energy(i, x); })
      return list.energy(i, x);
    else
      return energy_of(list[i], x);
  });
}

PotentialTerms Potential::terms(const State& x) const {
  PotentialTerms result;
  result.stencil.resize(stencil_count());
  result.inertia.resize(mobility_.size());
  tbb::parallel_for(std::size_t{0}, result.stencil.size(),
                    [&](std::size_t i) { result.stencil[i] = stencil_energy(i, x); });
  for (std::size_t v = 0; v < mobility_.size(); ++v) {
    if (mobility_[v] != Mobility::free) continue;
    const Triple<double> away = x[v] - target_[v];
    result.inertia[v] = 0.5 * inertia(v) * dot(away, away);
  }
  return result;
}

double Potential::change(const PotentialTerms& from, const PotentialTerms& to) {
  double sum = 0;
  for (std::size_t i = 0; i < from.stencil.size(); ++i) sum += to.stencil[i] - from.stencil[i];
  for (std::size_t i = 0; i < from.inertia.size(); ++i) sum += to.inertia[i] - from.inertia[i];
  return sum;
}

double Potential::total(const PotentialTerms& terms) {
  double sum = 0;
  for (const double e : terms.stencil) sum += e;
  for (const double e : terms.inertia) sum += e;
  return sum;
}

PotentialDerivatives Potential::derivatives(const State& x, HessianProjection projection,
                                            PotentialDerivatives room) const {
  PotentialDerivatives result = std::move(room);
  for (std::vector<double>* sums : {&result.slopes, &result.curvatures}) sums->resize(stencil_count());
  result.stencil.resize(stencil_count());
  std::size_t first = 0;
  const auto add_elements = [&](const auto& list) {
    list.differentiate(x, projection, result.stencil.data() + first,
                       [&, first](std::size_t i) { measure(first + i, list.corners(i), result); });
    first += list.size();
  };
  std::apply([&](const auto&... lists) { (add_elements(lists), ...); }, elements_);
  const auto add = [&](const auto& terms) {
    differentiate(std::span(terms), x, projection, result.stencil.data() + first,
                  [&, first](std::size_t i) { measure(first + i, 4, result); });
    first += terms.size();
  };
  add(contacts_);
  add(volumes_);
  add(frictions_);
  sum_gradient(x, result);
  return result;
}

/// Stores the moduli of the stencil's gradient and Hessian, summed over its free vertices. `sum_gradient` computes the
/// noise of `result` from these sums.
void Potential::measure(std::size_t stencil, std::size_t corners, PotentialDerivatives& result) const {
  const StencilDerivatives& derivatives = result.stencil[stencil];
  const auto vertex = vertices(stencil);
  double slopes = 0, curvatures = 0;
  std::array<double, 12> columns{};  // separate sums shorten the chain of additions
  for (std::size_t k = 0; k < corners && vertex[k] >= 0; ++k) {
    if (unknowns_[static_cast<std::size_t>(vertex[k])] != Mobility::free) continue;
    for (std::size_t row = 3 * k; row < 3 * k + 3; ++row) {
      slopes += std::abs(derivatives.gradient[row]);
      for (std::size_t column = 0; column < 3 * corners; ++column)
        columns[column] += std::abs(derivatives.hessian[12 * row + column]);
    }
  }
  for (const double column : columns) curvatures += column;
  result.slopes[stencil] = slopes;
  result.curvatures[stencil] = curvatures;
}

void Potential::sum_gradient(const State& x, PotentialDerivatives& result) const {
  result.gradient.assign(unknowns_.size(), {});
  double slopes = 0, curvatures = 0;
  for (std::size_t i = 0; i < result.stencil.size(); ++i) {
    slopes += result.slopes[i];
    curvatures += result.curvatures[i];
    const auto vertex = vertices(i);
    for (std::size_t k = 0; k < 4 && vertex[k] >= 0; ++k) {
      const auto v = static_cast<std::size_t>(vertex[k]);
      if (unknowns_[v] != Mobility::free) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) result.gradient[v][axis] += result.stencil[i].gradient[3 * k + axis];
    }
  }
  for (std::size_t v = 0; v < mobility_.size(); ++v) {
    if (mobility_[v] != Mobility::free) continue;
    const Triple<double> pull = inertia(v) * (x[v] - target_[v]);
    result.gradient[v] = result.gradient[v] + pull;
    slopes += std::abs(pull[0]) + std::abs(pull[1]) + std::abs(pull[2]);
    curvatures += 3 * inertia(v);
  }
  const double rounding = 0x1p-52 * largest_coordinate(x);
  result.energy_noise = rounding * slopes;
  result.force_noise = free_count_ > 0 ? rounding * curvatures / static_cast<double>(free_count_) : 0;
  result.torque_noise = 0;
  add_frame_noise(x, result);
}

/// Adds to the noise of `result` the errors in energy and forces that rounded frames cause. Sets the noise of torques,
/// which rounded positions and rounded frames cause.
void Potential::add_frame_noise(const State& x, PotentialDerivatives& result) const {
  const RodSystem& rods = this->rods();
  if (!rods.is_used()) return;
  const double largest = largest_coordinate(x);
  double slopes = 0, forces = 0, torques = 0;
  const std::size_t first = elastic_count() - rods.size();
  for (std::size_t i = 0; i < rods.size(); ++i) {
    const StencilDerivatives& derivatives = result.stencil[first + i];
    const std::size_t positions = 3 * rods.corners(i);
    const auto vertex = rods.vertices(i);
    for (std::size_t row = 0; row < 12 && vertex[row / 3] >= 0; ++row) {
      if (unknowns_[static_cast<std::size_t>(vertex[row / 3])] != Mobility::free) continue;
      if (row >= positions) slopes += std::abs(derivatives.gradient[row]);
      for (std::size_t column = 0; column < 12; ++column) {
        const double curvature = std::abs(derivatives.hessian[12 * row + column]);
        if (row >= positions)
          torques += (column < positions ? largest : 1) * curvature;
        else if (column >= positions)
          forces += curvature;
      }
    }
  }
  result.energy_noise += 0x1p-52 * slopes;
  if (free_count_ > 0) result.force_noise += 0x1p-52 * forces / static_cast<double>(free_count_);
  result.torque_noise = 0x1p-52 * torques;
}

double Potential::elastic_energy(const State& x) const {
  double sum = 0;
  std::apply([&](const auto&... lists) { (lists.add_elastic(x, sum), ...); }, elements_);
  return sum;
}

std::int64_t Potential::inverted_tetrahedra(const State& x) const {
  return std::ranges::count_if(elements<TetrahedronKind>().terms(), [&](const TetrahedronTerm& term) {
    const SolidDeformation<double> f = solid_deformation<double>(gathered<4>(term.vertex, x), term.gradient);
    return !(dot(f[0], cross(f[1], f[2])) > 0);
  });
}

double Potential::contact_energy(const State& x) const {
  double sum = 0;
  for (const ContactTerm& term : contacts_) sum += energy_of(term, x);
  for (const VolumeTerm& term : volumes_) sum += energy_of(term, x);
  return sum;
}

}  // namespace ogc::reference
