#include "reference/solvers/rods/rod_system.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <tbb/parallel_for.h>

#include "compare/problem/rods.hpp"

namespace ogc::reference {

using compare::at, compare::Index;
using Frame = FourOf<double>;

namespace {

Frame wide(const compare::Quaternion& q) { return {q[0], q[1], q[2], q[3]}; }
compare::Quaternion narrow(const Frame& q) {
  compare::Quaternion to;
  for (std::size_t k = 0; k < 4; ++k) to[k] = static_cast<float>(q[k]);
  return to;
}

Frame unit(const Frame& q) { return on_sphere::scaled(1 / std::sqrt(inner(q, q)), q); }

double norm(const Triple<double>& a) { return std::hypot(a[0], a[1], a[2]); }

/// Returns q̄_b q_a, where segment b lies behind a joint and segment a ahead of it. `own` and `other` are the
/// quaternions of a segment and its neighbour; the neighbour is segment a if `end` is 1.
Frame relative(const Frame& own, const Frame& other, std::size_t end) {
  return end == 1 ? product(conjugate(own), other) : product(conjugate(other), own);
}

}  // namespace

Frame turned_along(const Triple<double>& from, const Triple<double>& to, const Frame& q) {
  const double a = norm(from), b = norm(to);
  if (!(a > 0 && b > 0)) return q;
  // The rotation is the quaternion product of `first` and the unit vector half-way between both directions.
  const Triple<double> first = (1 / a) * from, middle = first + (1 / b) * to;
  const double size = norm(middle);
  if (!(size > 0x1p-40)) return product(q, Frame{1, 0, 0, 0});
  const Triple<double> half = (1 / size) * middle, axis = cross(first, half);
  return unit(product(Frame{axis[0], axis[1], axis[2], dot(first, half)}, q));
}

std::vector<Index> segment_colours_of(const compare::RestStateOut& rest, const std::vector<Index>& held) {
  std::vector<Index> colour(rest.segments.size(), -1);
  for (std::size_t e = 0; e < colour.size(); ++e) {
    if (held[e] != -1) continue;
    const auto taken = [&](Index c) {
      return std::ranges::any_of(rest.segments[e].neighbour, [&](Index f) { return f >= 0 && colour[at(f)] == c; });
    };
    for (colour[e] = 0; taken(colour[e]);) ++colour[e];
  }
  return colour;
}

std::vector<compare::Quaternion> start_orientations(const compare::Scene& scene, const compare::RestStateOut& rest) {
  if (!scene.orientations.empty()) return scene.orientations;
  std::vector<compare::Quaternion> all;
  const auto between = [](const std::vector<compare::Vec3>& x, const compare::Edge& ends) {
    const compare::Vec3 &a = x[at(ends[0])], &b = x[at(ends[1])];
    return Triple<double>{b.x - a.x, b.y - a.y, b.z - a.z};
  };
  for (const compare::RestSegment& segment : rest.segments) {
    const Triple<double> from = between(scene.rest_positions, segment.end),
                         to = between(scene.mesh.positions, segment.end);
    all.push_back(from == to ? segment.orientation : narrow(turned_along(from, to, wide(segment.orientation))));
  }
  return all;
}

RodSystem::RodSystem(const compare::Scene& scene, const compare::RestStateOut& rest)
    : scene_(scene), vertex_count_(scene.mesh.positions.size()), scene_start_(start_orientations(scene, rest)) {
  const std::vector<Index> held = compare::segment_groups(scene, compare::rod_segments(scene));
  for (std::size_t e = 0; e < rest.segments.size(); ++e) {
    const compare::RestSegment& from = rest.segments[e];
    const compare::RodMaterial& material = *scene.bodies[at(from.body)].material.rod;
    RodTerm term;
    term.vertex = from.end;
    term.length = double{from.length};
    term.stretch = material.stretch;
    term.damping = material.damping / scene.settings.time_step;
    term.neighbour = from.neighbour;
    for (std::size_t end = 0; end < 2; ++end) {
      term.weight[end] = double{from.weight[end]};
      term.rest[end] = wide(from.relative[end]);
    }
    term.held = held[e];
    terms_.push_back(term);
  }
  const std::vector<Index> colour = segment_colours_of(rest, held);
  for (std::size_t e = 0; e < colour.size(); ++e) {
    if (colour[e] < 0) continue;
    classes_.resize(std::max(classes_.size(), at(colour[e]) + 1));
    classes_[at(colour[e])].push_back(e);
  }
  for (std::size_t e = 0; e < terms_.size(); ++e)
    for (std::size_t end = 0; end < 2; ++end)
      if (terms_[e].weight[end] > 0 && at(terms_[e].neighbour[end]) > e)
        joints_.push_back({e, end, at(terms_[e].neighbour[end])});
  set_start({});
}

void RodSystem::set_start(std::span<const compare::Quaternion> orientations) {
  if (orientations.empty()) orientations = scene_start_;
  if (orientations.size() != terms_.size()) throw std::invalid_argument("orientations of other rods");
  start_.clear();
  for (const compare::Quaternion& q : orientations) start_.push_back(wide(q));
  q_ = start_;
}

void RodSystem::put(std::span<const compare::Quaternion> orientations) {
  if (orientations.empty()) return;
  if (orientations.size() != terms_.size()) throw std::invalid_argument("orientations of other rods");
  for (std::size_t e = 0; e < q_.size(); ++e) q_[e] = wide(orientations[e]);
}

std::vector<compare::Quaternion> RodSystem::orientations() const {
  std::vector<compare::Quaternion> all;
  for (const Frame& q : q_) all.push_back(narrow(q));
  return all;
}

Triple<double> RodSystem::apart(std::size_t e, const Positions& x) const {
  return x[at(terms_[e].vertex[1])] - x[at(terms_[e].vertex[0])];
}

void RodSystem::begin_step(const Positions& start, std::int64_t number) {
  if (!is_used()) return;
  start_positions_ = start;
  number_ = number;
  q_ = start_;
  for (std::size_t e = 0; e < terms_.size(); ++e) {
    RodTerm& term = terms_[e];
    term.start = (1 / term.length) * rotated(conjugate(start_[e]), apart(e, start));
    for (std::size_t end = 0; end < 2; ++end)
      if (term.neighbour[end] >= 0) term.before[end] = relative(start_[e], start_[at(term.neighbour[end])], end);
  }
}

void RodSystem::turn(const Positions& x) {
  const double h = scene_.settings.time_step, before = static_cast<double>(number_ - 1) * h;
  for (std::size_t e = 0; e < terms_.size(); ++e) {
    const Index held = terms_[e].held;
    if (held > 0 && says_turn(scene_.motions[at(held) - 1]))
      q_[e] = unit(product(wide(prescribed_turn(scene_.motions[at(held) - 1], before, before + h)), start_[e]));
    else if (held > 0 || (held < 0 && turns(scene_.settings.rod_start)))
      q_[e] = turned_along(apart(e, start_positions_), apart(e, x), start_[e]);
    else
      q_[e] = start_[e];
  }
}

on_sphere::Problem<double> RodSystem::problem(std::size_t e, const Positions& x) const {
  const RodTerm& term = terms_[e];
  on_sphere::Problem<double> problem;
  problem.apart = apart(e, x);
  problem.direction = own_axis<double>() + term.damping * term.start;
  problem.stretch = term.stretch;
  problem.vector = {};
  const auto add = [&](const Frame& asked, double weight) {
    problem.vector = on_sphere::sum(problem.vector,
                                    on_sphere::scaled(inner(asked, q_[e]) < 0 ? -weight : weight, asked));
  };
  for (std::size_t end = 0; end < 2; ++end) {
    if (!(term.weight[end] > 0)) continue;
    const Frame& other = q_[at(term.neighbour[end])];
    const auto asked = [&](const Frame& p) { return product(other, end == 1 ? conjugate(p) : p); };
    add(asked(term.rest[end]), term.weight[end]);
    if (term.damping > 0) add(asked(term.before[end]), term.damping * term.weight[end]);
  }
  problem.fill_matrix();
  return problem;
}

namespace {

/// Returns the minimiser nearest to `old` for a segment without neighbours. Every q whose director is along D is a
/// minimiser.
Frame without_neighbours(const on_sphere::Problem<double>& problem, const Frame& old, double sigma) {
  const Frame upper = on_sphere::sum(on_sphere::scaled(sigma, old), problem.turned(old));
  return inner(upper, upper) > 1e-20 * sigma * sigma ? unit(upper) : old;
}

/// Descends from `old` and returns the minimiser that it reaches if this is the global one. Otherwise returns the
/// lowest minimiser from several starts.
Frame least(const on_sphere::Problem<double>& problem, const Frame& old, double sigma, double pull) {
  constexpr double enough = 1e-14;
  const double size = sigma + pull;
  const auto is_least = [&](const Frame& q) { return inner(q, problem.pull(q)) >= sigma - 1e-9 * size; };
  Frame best = on_sphere::minimised(problem, old, size, enough);
  if (is_least(best)) return best;
  for (const Frame& start : {Frame{0.3, -0.5, 0.7, 0.2}, Frame{0.6, 0.4, 0.1, -0.7}, problem.vector})
    for (const double side : {1.0, -1.0}) {
      const Frame q = on_sphere::minimised(problem, on_sphere::scaled(side, start), size, enough);
      if (problem.energy(q) < problem.energy(best)) best = q;
    }
  return best;
}

/// Returns the solution as printed in Hsu et al. 2025: q ∝ (μ + M) b with μ = σ + ‖b‖ (M, b, σ: compare/rods.md).
Frame as_published(const on_sphere::Problem<double>& problem, double sigma, double pull) {
  return unit(on_sphere::sum(on_sphere::scaled(sigma + pull, problem.vector), problem.turned(problem.vector)));
}

}  // namespace

void RodSystem::sweep(const Positions& x) {
  for (const std::vector<std::size_t>& members : classes_)
    tbb::parallel_for(std::size_t{0}, members.size(), [&](std::size_t k) {
      const std::size_t e = members[k];
      const auto own = problem(e, x);
      const double sigma = 2 * own.stretch * norm(own.apart) * norm(own.direction),
                   pull = std::sqrt(inner(own.vector, own.vector));
      if (!(sigma > 0 || pull > 0)) return;
      if (!(pull > 0))
        q_[e] = without_neighbours(own, q_[e], sigma);
      else
        q_[e] = minimises(scene_.settings.rod_orientation) ? least(own, q_[e], sigma, pull)
                                                           : as_published(own, sigma, pull);
    });
}

namespace {

/// Returns k_s l/2 (‖D/l − R(q) e₃‖² + k ‖D/l − R(q) R(qᵗ)ᵀ Dᵗ/l‖²); `apart` is D, `damping` is k. The second norm
/// equals that of the change of the strain R(q)ᵀ D/l since xᵗ, because R(q) keeps lengths.
template <class T>
T segment_energy(const RodTerm& term, const Triple<T>& apart, const FourOf<T>& q, double damping) {
  const auto about = [&](const Triple<double>& own) {
    const Triple<T> held = rotated(q, Triple<T>{T(own[0]), T(own[1]), T(own[2])});
    Triple<T> strain;
    for (std::size_t axis = 0; axis < 3; ++axis) strain[axis] = (1 / term.length) * apart[axis] - held[axis];
    return stretch_energy(strain, term.stretch, term.length);
  };
  T energy = about(own_axis<double>());
  if (damping > 0) energy = energy + damping * about(term.start);
  return energy;
}

template <class T>
FourOf<T> constant(const Frame& q) {
  return {T(q[0]), T(q[1]), T(q[2]), T(q[3])};
}

/// Returns w/2 ‖p − s p°‖². Here w is `weight`, p is the relative rotation of both segments, p° is `rest`, and s = ±1
/// is the sign that makes the result smaller.
template <class T>
T joint_energy(const FourOf<T>& own, const FourOf<T>& other, std::size_t end, double weight, const Frame& rest) {
  const FourOf<T> p = end == 1 ? product(conjugate(own), other) : product(conjugate(other), own);
  double agreement = 0;
  for (std::size_t k = 0; k < 4; ++k) agreement += plain(p[k]) * rest[k];
  T sum(0.0);
  for (std::size_t k = 0; k < 4; ++k) {
    const T difference = p[k] - T(agreement < 0 ? -rest[k] : rest[k]);
    sum = sum + difference * difference;
  }
  return 0.5 * weight * sum;
}

/// Returns the unit quaternion that equals q exp(ω/2) to second order.
template <class T>
FourOf<T> turned_by(const Frame& q, const Triple<T>& omega) {
  using std::sqrt;
  const Triple<T> half = 0.5 * omega;
  const T real = T(1.0) / sqrt(T(1.0) + dot(half, half));
  return product(constant<T>(q), FourOf<T>{real * half[0], real * half[1], real * half[2], real});
}

using Six = Second<6, double>;

/// Returns three variables with the value 0: the inputs `first` to `first` + 2 of six inputs.
Triple<Six> variables(std::size_t first) {
  Triple<Six> x;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    x[axis] = Six(0.0);
    x[axis].slope[first + axis] = 1;
  }
  return x;
}

}  // namespace

void RodSystem::add_force(Index e, std::size_t end, const std::array<Triple<double>, 2>& ends,
                          VertexSystemOf<double>& sum) const {
  using Own = ByOwnTwice<double>;
  const RodTerm& term = terms_[at(e)];
  const auto x = with_own<Own>(ends, end);
  Triple<Own> apart;
  for (std::size_t axis = 0; axis < 3; ++axis) apart[axis] = x[1][axis] - x[0][axis];
  add_exactly(segment_energy(term, apart, constant<Own>(q_[at(e)]), term.damping), sum);
}

std::array<Index, 4> RodSystem::vertices(std::size_t stencil) const {
  const auto unknown = [&](std::size_t e) { return static_cast<Index>(vertex_count_ + e); };
  if (stencil < terms_.size()) return {terms_[stencil].vertex[0], terms_[stencil].vertex[1], unknown(stencil), -1};
  const Joint& joint = joints_[stencil - terms_.size()];
  return {unknown(joint.first), unknown(joint.second), -1, -1};
}

Frame RodSystem::orientation(std::size_t e, const Positions& x) const {
  return x.size() > vertex_count_ ? turned_by<double>(q_[e], x[vertex_count_ + e]) : q_[e];
}

void RodSystem::turn_by(const Positions& x) {
  for (std::size_t e = 0; e < q_.size(); ++e) q_[e] = unit(orientation(e, x));
}

double RodSystem::energy(std::size_t stencil, const Positions& x) const {
  if (stencil < terms_.size())
    return segment_energy(terms_[stencil], apart(stencil, x), orientation(stencil, x), terms_[stencil].damping);
  const Joint& joint = joints_[stencil - terms_.size()];
  const RodTerm& term = terms_[joint.first];
  const Frame own = orientation(joint.first, x), other = orientation(joint.second, x);
  double sum = joint_energy(own, other, joint.end, term.weight[joint.end], term.rest[joint.end]);
  if (term.damping > 0)
    sum += term.damping * joint_energy(own, other, joint.end, term.weight[joint.end], term.before[joint.end]);
  return sum;
}

StencilDerivatives RodSystem::derivatives(std::size_t stencil, const Positions& x, HessianProjection projection) const {
  const auto differentiated = [&] {
    if (stencil < terms_.size()) {
      Triple<Six> between = variables(0);
      const Triple<double> now = apart(stencil, x);
      for (std::size_t axis = 0; axis < 3; ++axis) between[axis] = between[axis] + Six(now[axis]);
      return segment_energy(terms_[stencil], between, turned_by(q_[stencil], variables(3)), terms_[stencil].damping);
    }
    const Joint& joint = joints_[stencil - terms_.size()];
    const RodTerm& term = terms_[joint.first];
    const FourOf<Six> own = turned_by(q_[joint.first], variables(0)), other = turned_by(q_[joint.second], variables(3));
    Six sum = joint_energy(own, other, joint.end, term.weight[joint.end], term.rest[joint.end]);
    if (term.damping > 0)
      sum = sum + term.damping * joint_energy(own, other, joint.end, term.weight[joint.end], term.before[joint.end]);
    return sum;
  };
  const Six energy = differentiated();
  std::array<double, 36> matrix;
  for (std::size_t i = 0, k = 0; i < 6; ++i)
    for (std::size_t j = 0; j <= i; ++j, ++k) matrix[6 * i + j] = matrix[6 * j + i] = energy.bend(k);
  project(matrix.data(), 6, projection);
  // Maps unknowns of the stencil to variables of its energy. The first three variables of a segment are D = x₁ − x₀.
  struct Part {
    std::size_t place, variable;
    double sign;
  };
  const std::vector<Part> parts = stencil < terms_.size() ? std::vector<Part>{{0, 0, -1}, {1, 0, 1}, {2, 3, 1}}
                                                          : std::vector<Part>{{0, 0, 1}, {1, 3, 1}};
  StencilDerivatives result;
  result.energy = energy.value;
  for (const Part& a : parts)
    for (std::size_t r = 0; r < 3; ++r) {
      result.gradient[3 * a.place + r] = a.sign * energy.slope[a.variable + r];
      for (const Part& b : parts)
        for (std::size_t c = 0; c < 3; ++c)
          result.hessian[12 * (3 * a.place + r) + 3 * b.place + c] = a.sign * b.sign *
                                                                     matrix[6 * (a.variable + r) + b.variable + c];
    }
  return result;
}

double RodSystem::elastic_energy(const Positions& x) const {
  double sum = 0;
  for (std::size_t e = 0; e < terms_.size(); ++e) sum += segment_energy(terms_[e], apart(e, x), orientation(e, x), 0);
  for (const Joint& joint : joints_) {
    const RodTerm& term = terms_[joint.first];
    sum += joint_energy(orientation(joint.first, x), orientation(joint.second, x), joint.end, term.weight[joint.end],
                        term.rest[joint.end]);
  }
  return sum;
}

double RodSystem::mean_torque(const Positions& x) const {
  double sum = 0;
  std::size_t count = 0;
  for (const std::vector<std::size_t>& members : classes_)
    for (const std::size_t e : members) {
      const Frame pull = problem(e, x).pull(q_[e]);
      const Frame across = on_sphere::sum(pull, on_sphere::scaled(-inner(pull, q_[e]), q_[e]));
      sum += std::sqrt(inner(across, across));
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

RodSystem::Stretch RodSystem::stretch(const Positions& x) const {
  Stretch result{0, -1};
  for (std::size_t e = 0; e < terms_.size(); ++e) {
    const double own = norm(apart(e, x)) / terms_[e].length - 1;
    result.mean += own / static_cast<double>(terms_.size());
    result.largest = std::max(result.largest, own);
  }
  return result;
}

}  // namespace ogc::reference
