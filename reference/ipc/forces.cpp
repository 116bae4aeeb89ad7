#include "reference/ipc/forces.hpp"

#include <cmath>

#include <tbb/parallel_for.h>

#include "reference/ipc/barrier_kernels.hpp"
#include "reference/solvers/potential_batches.hpp"

namespace ogc::reference {
namespace {

using compare::at, compare::Index;
using compare::ContactSides;

template <class Visit>
auto with_corners(std::size_t count, const std::array<Index, 4>& vertex, const State& x, Visit visit) {
  switch (count) {
    case 2: return visit(gathered<2>(vertex, x));
    case 3: return visit(gathered<3>(vertex, x));
    default: return visit(gathered<4>(vertex, x));
  }
}

const BarrierKernels& barrier_kernels() {
#ifdef __x86_64__
  if (has_avx2()) return barrier_kernels_avx2;
#endif
  return barrier_kernels_baseline;
}

/// Returns a number that is equal for barriers that can be differentiated together. Their closest features must be of
/// the same kind (FormKind). If the barriers are mollified, these features must also be at the same places among the
/// four vertices.
std::uint8_t group_of(const BarrierTerm& term) {
  const int form = static_cast<int>(term.form.kind);
  return static_cast<std::uint8_t>(term.rest_squared > 0 ? 16 * (1 + form) + 4 * term.form.at[0] + term.form.at[1]
                                                         : form);
}

template <std::size_t Count>
void differentiate(const Bundle& bundle, const std::vector<ShapedBarrier>& terms,
                   StencilKernels::Function<ShapedBarrier, Count> kernel, const State& x, HessianProjection projection,
                   StencilDerivatives* to) {
  Batch<ShapedBarrier, Count> batch;
  for (std::size_t k = 0; k < bundle.size; ++k) {
    const ShapedBarrier& term = terms[bundle.member[k]];
    batch.add(term, gathered<Count>(term.barrier.vertex, x), to[bundle.member[k]]);
  }
  kernel(batch, projection);
}

/// Writes the derivatives of all barriers, multiplied by κ, to the array that begins at `to`.
void differentiate(const BarrierSet& set, const BarrierShape& shape, double stiffness, const State& x,
                   HessianProjection projection, StencilDerivatives* to) {
  std::vector<ShapedBarrier> terms;
  std::vector<std::uint8_t> group;
  for (const BarrierTerm& term : set.terms) {
    terms.push_back({term, shape});
    terms.back().barrier.weight *= stiffness;
    group.push_back(group_of(term));
  }
  const std::vector<Bundle> bundles = bundled(group);
  const BarrierKernels& kernels = barrier_kernels();
  tbb::parallel_for(std::size_t{0}, bundles.size(), [&](std::size_t b) {
    switch (terms[bundles[b].member[0]].barrier.count) {
      case 2: return differentiate<2>(bundles[b], terms, kernels.of_2, x, projection, to);
      case 3: return differentiate<3>(bundles[b], terms, kernels.of_3, x, projection, to);
      default: return differentiate<4>(bundles[b], terms, kernels.of_4, x, projection, to);
    }
  });
}

constexpr std::array<ContactSides, 5> sides_of_count{ContactSides::point_point, ContactSides::point_point,
                                                     ContactSides::point_point, ContactSides::point_edge,
                                                     ContactSides::point_triangle};

std::size_t count_of(const FrictionTerm& term) { return static_cast<std::size_t>(vertex_count(term.sides)); }

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

}  // namespace

double change(const IpcEnergy& from, const IpcEnergy& to) {
  return Potential::change(from.elastic, to.elastic) + (to.barrier - from.barrier) + (to.rest - from.rest);
}

double value_noise(const IpcEnergy& energy) {
  double moduli = energy.barrier + std::abs(energy.rest);
  for (const double e : energy.elastic.stencil) moduli += std::abs(e);
  for (const double e : energy.elastic.inertia) moduli += e;
  return 0x1p-52 * moduli;
}

IpcForces::IpcForces(const compare::Scene& scene, const compare::Topology& topology, const BarrierShape& shape)
    : scene_(scene),
      shape_(shape),
      potential_(scene, topology),
      mobility_(potential_.unknowns()),
      elastic_vertices_(potential_.vertices()),
      body_(body_of_vertex(scene)) {}

void IpcForces::begin_step(const State& start, const State& target, std::int64_t number) {
  potential_.begin_step(start, target);
  potential_.rods().begin_step(start, number);
  start_ = start;
  target_ = target;
  frictions_.clear();
  pull_.reset();
}

double IpcForces::friction_coefficient(const BarrierTerm& term) const {
  std::size_t first = 0, second = 0;
  for (std::size_t k = 0; k < term.count; ++k)
    (term.form.weight[k] > 0 ? first : second) = at(body_[at(term.vertex[k])]);
  return double{potential_.rest().meetings[first * scene_.bodies.size() + second].friction};
}

void IpcForces::lag_friction(const BarrierSet& set, const State& x, double stiffness) {
  frictions_.clear();
  for (const BarrierTerm& term : set.terms) {
    const double friction = friction_coefficient(term);
    if (friction == 0) continue;
    std::array<Triple<double>, 4> corners{}, before{};
    for (std::size_t k = 0; k < term.count; ++k)
      corners[k] = x[at(term.vertex[k])], before[k] = start_[at(term.vertex[k])];
    const Triple<double> apart = separation(term.form.weight, corners);
    const double squared = dot(apart, apart), distance = std::sqrt(squared);
    double force = -stiffness * term.weight * barrier_slopes(shape_.gap(squared), shape_.support()).slope[0] * 2 *
                   distance;
    if (term.rest_squared > 0)
      force *= Mollifier<double>(corners[1] - corners[0], corners[3] - corners[2], term.rest_squared, 1).value();
    frictions_.push_back({sides_of_count[term.count], term.vertex, term.form.weight, (1 / distance) * apart,
                          separation(term.form.weight, before), friction * force,
                          scene_.settings.friction_velocity * scene_.settings.time_step});
  }
}

IpcEnergy IpcForces::energy(const State& x, const BarrierSet& set, double stiffness) const {
  IpcEnergy result{potential_.terms(x), std::vector<double>(set.terms.size()), std::vector<double>(frictions_.size())};
  tbb::parallel_for(std::size_t{0}, set.terms.size(), [&](std::size_t i) {
    const BarrierTerm& term = set.terms[i];
    result.barriers[i] = with_corners(term.count, term.vertex, x,
                                      [&](const auto& corners) { return term.energy(shape_, corners); });
  });
  tbb::parallel_for(std::size_t{0}, frictions_.size(), [&](std::size_t i) {
    const FrictionTerm& term = frictions_[i];
    result.friction[i] = with_corners(count_of(term), term.vertex, x,
                                      [&](const auto& corners) { return term.energy(corners); });
  });
  result.barrier = stiffness * sum(result.barriers);
  result.rest = sum(result.friction);
  if (pull_)
    for (std::size_t v = 0; v < x.size(); ++v) {
      if (mobility_[v] != Mobility::prescribed) continue;
      const Triple<double> lag = x[v] - target_[v];
      result.rest += 0.5 * pull_->stiffness * potential_.inertia(v) * dot(lag, lag) - dot(pull_->force[v], lag);
    }
  return result;
}

IpcDerivatives IpcForces::derivatives(const State& x, const BarrierSet& set, double stiffness,
                                      HessianProjection projection, IpcDerivatives room) const {
  PotentialDerivatives earlier;
  earlier.stencil = std::move(room.stencil);
  PotentialDerivatives elastic = potential_.derivatives(x, projection, std::move(earlier));
  IpcDerivatives result{std::move(elastic.stencil), elastic_vertices_, {}, elastic.energy_noise};
  const std::size_t first = result.stencil.size(), second = first + set.terms.size();
  result.stencil.resize(second + frictions_.size());
  for (const BarrierTerm& term : set.terms) result.vertices.push_back(term.vertex);
  for (const FrictionTerm& term : frictions_) result.vertices.push_back(term.vertex);
  differentiate(set, shape_, stiffness, x, projection, result.stencil.data() + first);
  differentiate(std::span(frictions_), x, projection, result.stencil.data() + second, [](std::size_t) {});
  add_gradient(result, x);
  return result;
}

void IpcForces::add_gradient(IpcDerivatives& result, const State& x) const {
  result.gradient.assign(mobility_.size(), {});
  for (std::size_t i = 0; i < result.stencil.size(); ++i)
    for (std::size_t k = 0; k < 4 && result.vertices[i][k] >= 0; ++k) {
      Triple<double>& g = result.gradient[at(result.vertices[i][k])];
      for (std::size_t axis = 0; axis < 3; ++axis) g[axis] += result.stencil[i].gradient[3 * k + axis];
    }
  for (std::size_t v = 0; v < mobility_.size(); ++v) {
    if (!unknown(v)) {
      result.gradient[v] = {};
    } else if (v >= x.size()) {
      continue;  // a frame, which has no inertia
    } else if (mobility_[v] == Mobility::free) {
      result.gradient[v] = result.gradient[v] + potential_.inertia(v) * (x[v] - target_[v]);
    } else {
      result.gradient[v] = result.gradient[v] + pull_->stiffness * potential_.inertia(v) * (x[v] - target_[v]) -
                           pull_->force[v];
    }
  }
}

State IpcForces::barrier_gradient(const State& x, const BarrierSet& set) const {
  State gradient(x.size());
  std::vector<StencilDerivatives> derivatives(set.terms.size());
  differentiate(set, shape_, 1, x, HessianProjection::none, derivatives.data());
  for (std::size_t i = 0; i < set.terms.size(); ++i) {
    const BarrierTerm& term = set.terms[i];
    const StencilDerivatives& d = derivatives[i];
    for (std::size_t k = 0; k < term.count; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (unknown(at(term.vertex[k]))) gradient[at(term.vertex[k])][axis] += d.gradient[3 * k + axis];
  }
  return gradient;
}

std::vector<double> IpcForces::diagonal() const {
  std::vector<double> diagonal = potential_.inertias();
  if (pull_)
    for (std::size_t v = 0; v < diagonal.size(); ++v)
      if (mobility_[v] == Mobility::prescribed) diagonal[v] *= pull_->stiffness;
  return diagonal;
}

}  // namespace ogc::reference
