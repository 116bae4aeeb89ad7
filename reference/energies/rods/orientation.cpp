// Computes the unit quaternion q that minimises a segment's energy −½ qᵀ M q − b·q (compare/rods.md), by Newton's
// method on the unit sphere. Uses neither the eigenvectors of M nor the equation of the Lagrange multiplier. A function
// of this kind has at most one local minimiser that is not global (Martínez 1994), so a few starts in double find the
// global one. The last steps use 113 bits, which resolve b even if M is 10²⁰ times as large.
#include "reference/energies/rods/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <tbb/parallel_for.h>

#include "reference/energies/rods/on_sphere.hpp"

namespace ogc::reference {
namespace {

using namespace on_sphere;

template <class T>
Four<T> wide(const compare::Quaternion& q) {
  return {T(q[0]), T(q[1]), T(q[2]), T(q[3])};
}

template <class T>
Triple<T> difference(const compare::Vec3f& a, const compare::Vec3f& b) {
  return {T(a.x) - T(b.x), T(a.y) - T(b.y), T(a.z) - T(b.z)};
}

/// Returns the minimiser of least energy among those found from several starts.
Four<Many> least(const Problem<Many>& problem, const Four<Many>& old, const Many& unit) {
  const Problem<double> rough = problem.as<double>();
  std::vector<Four<double>> starts;
  Four<double> near;
  for (std::size_t k = 0; k < 4; ++k) near[k] = static_cast<double>(old[k]);
  starts.push_back(near);
  starts.push_back({0.3, -0.5, 0.7, 0.2});
  starts.push_back({0.6, 0.4, 0.1, -0.7});
  if (const double pull = size_of(rough.vector); pull > 0) starts.push_back(scaled(1 / pull, rough.vector));
  std::vector<Four<double>> ends;
  for (const Four<double>& start : starts)
    for (const double side : {1.0, -1.0}) {
      const Four<double> end = minimised(rough, scaled(side, start), static_cast<double>(unit), 1e-12);
      const auto is_near = [&](const Four<double>& other) { return inner(end, other) > 1 - 1e-6; };
      if (std::ranges::none_of(ends, is_near)) ends.push_back(end);
    }
  std::optional<Four<Many>> best;
  Many lowest = 0;
  // `ends` holds the minimisers that were found in double. If all quaternions of a circle have nearly the same energy,
  // these minimisers are spread over the circle. The four of lowest energy are enough starts to find the least
  // minimiser in 113 bits.
  std::ranges::sort(ends, {}, [&](const Four<double>& q) { return rough.energy(q); });
  ends.resize(std::min<std::size_t>(ends.size(), 4));
  for (const Four<double>& end : ends) {
    const Four<Many> q = minimised(problem, {Many(end[0]), Many(end[1]), Many(end[2]), Many(end[3])}, unit, 1e-30);
    const Many energy = problem.energy(q);
    if (!best || energy < lowest) best = q, lowest = energy;
  }
  return *best;
}

/// An orientation towards which a neighbour pulls the segment, by the rest shape or by damping.
struct Asked {
  Four<Many> orientation;  ///< t
  Many weight;             ///< w for the rest shape, k w for damping [N m]
  Many agreement;          ///< t·q with the old q
};

/// A case in 113-bit numbers, which hold products of up to five single-precision numbers up to their last bits.
struct Question {
  Four<Many> old;
  Problem<Many> problem;  ///< vector b is not yet set
  std::vector<Asked> asked;
  double pull_size = 0, direction_size = 1;  ///< Σ w (1 + k) [N m], 1 + k ‖Dᵗ‖/l

  explicit Question(const compare::OrientationCase& c) : old(wide<Many>(c.orientation)) {
    const Many damping(c.damping), length(c.rest_length);
    const Triple<Many> before = difference<Many>(c.start[1], c.start[0]);
    const Four<Many> own_start = wide<Many>(c.orientation_start);
    problem.apart = difference<Many>(c.vertex[1], c.vertex[0]);
    const Triple<Many> held = rotated(conjugate(own_start), before);
    for (std::size_t k = 0; k < 3; ++k) problem.direction[k] = own_axis<Many>()[k] + damping * held[k] / length;
    problem.stretch = Many(c.stretch);
    direction_size += static_cast<double>(damping * length_of(before) / length);
    add(c.behind, false, damping, own_start);
    add(c.ahead, true, damping, own_start);
    for (const Asked& a : asked) pull_size += static_cast<double>(a.weight);
  }

 private:
  void add(const compare::RodNeighbour& f, bool is_ahead, const Many& damping, const Four<Many>& own_start) {
    if (!(f.weight > 0)) return;
    const auto ask = [&](const Four<Many>& relative, const Many& weight) {
      const Four<Many> t = product(wide<Many>(f.now), is_ahead ? conjugate(relative) : relative);
      asked.push_back({t, weight, inner(t, old)});
    };
    ask(wide<Many>(f.rest), Many(f.weight));
    if (!(damping > 0.0)) return;
    const Four<Many> start = wide<Many>(f.start);
    ask(is_ahead ? product(conjugate(own_start), start) : product(conjugate(start), own_start),
        Many(damping * Many(f.weight)));
  }
};

/// Returns the Frobenius norm of H⁻¹ C, where H is `bend` and C has the columns `columns`. Returns infinity if H is not
/// positive definite.
double reaction(const Square<Many>& bend, const std::vector<Triple<Many>>& columns) {
  Many squared(0.0);
  for (const Triple<Many>& column : columns) {
    const auto x = solve(bend, Many(0.0), column);
    if (!x) return std::numeric_limits<double>::infinity();
    squared += dot(*x, *x);
  }
  return static_cast<double>(root(squared));
}

Triple<Many> along(const std::array<Four<Many>, 3>& basis, const Four<Many>& v) {
  return {inner(basis[0], v), inner(basis[1], v), inner(basis[2], v)};
}

/// Returns Σ ‖∂q/∂y‖ ‖y‖ over the given numbers y, at the minimiser q. `pull_size` is the size of the energy's vector
/// b, or of the faint vector that replaces b = 0.
double condition(const Question& question, const Problem<Many>& problem, const Four<Many>& q, double pull_size) {
  const auto basis_at = tangents(q);
  const Square<Many> bend = OnSphere<Many>(problem, q).bend;
  const Many twice = Many(-2.0) * problem.stretch;
  std::vector<Triple<Many>> by_apart, by_direction, by_pull;
  for (std::size_t k = 0; k < 3; ++k) {
    by_apart.push_back(along(basis_at, scaled(twice, product(product(basis<Many>(k), q), pure(problem.direction)))));
    by_direction.push_back(along(basis_at, scaled(twice, product(product(pure(problem.apart), q), basis<Many>(k)))));
    Triple<Many> unit{Many(0.0), Many(0.0), Many(0.0)};
    unit[k] = Many(1.0);
    by_pull.push_back(unit);
  }
  const double apart = static_cast<double>(length_of(problem.apart));
  const double all = reaction(bend, by_apart) * apart + reaction(bend, by_direction) * question.direction_size +
                     reaction(bend, {along(basis_at, problem.turned(q))}) + reaction(bend, by_pull) * pull_size;
  return std::max(1.0, std::isnan(all) ? std::numeric_limits<double>::infinity() : all);
}

/// Returns whether the tolerance exceeds a quarter of a radian. First-order errors are meaningless then, so any
/// orientation is accepted.
bool is_open(double scale) { return !(scale * compare::orientation_tolerance * compare::unit_roundoff <= 0.25); }

compare::OrientationAnswer answer(const Question& question, const Four<Many>& vector) {
  compare::OrientationAnswer result;
  Problem<Many> problem = question.problem;
  problem.vector = vector;
  problem.fill_matrix();
  const Many stretched = Many(2.0) * problem.stretch * length_of(problem.apart);
  const Many sigma = stretched * length_of(problem.direction), pull = size_of(vector);
  result.energy_scale = static_cast<double>(stretched) * question.direction_size + question.pull_size;
  for (std::size_t row = 0; row < 4; ++row) {
    result.vector[row] = static_cast<double>(vector[row]);
    for (std::size_t k = 0; k < 4; ++k) result.matrix[row][k] = static_cast<double>(problem.matrix[row][k]);
  }
  Four<Many> q = question.old;
  result.scale = 1;
  if (pull > 0.0 || sigma > 0.0) {
    // If there are no neighbours, many q have the least energy. A faint vector b along the old q selects the nearest of
    // them.
    double pull_size = question.pull_size;
    if (!(pull > 0.0)) {
      problem.vector = scaled(Many(Many(0x1p-60) * sigma), question.old);
      pull_size = pull_size > 0 ? pull_size : static_cast<double>(Many(0x1p-60) * sigma);
    }
    q = least(problem, question.old, Many(sigma + size_of(problem.vector)));
    result.scale = condition(question, problem, q, pull_size);
    if (is_open(result.scale)) result.scale = std::numeric_limits<double>::infinity();
  }
  problem.vector = vector;
  result.energy = static_cast<double>(problem.energy(q));
  for (std::size_t k = 0; k < 4; ++k) result.orientation[k] = static_cast<double>(q[k]);
  return result;
}

struct Accepted {
  std::vector<compare::OrientationAnswer> answers;
  bool near = false;
};

Accepted accepted(const compare::OrientationCase& c) {
  const Question question(c);
  std::vector<std::size_t> grey;
  bool near = false;
  std::vector<double> sign;
  for (std::size_t i = 0; i < question.asked.size(); ++i) {
    const double agreement = static_cast<double>(question.asked[i].agreement);
    sign.push_back(agreement < 0 ? -1 : 1);
    if (std::abs(agreement) <= compare::orientation_sign_grey * compare::unit_roundoff) grey.push_back(i);
    near = near || std::abs(agreement) <= compare::near_factor;
  }
  Accepted result;
  for (std::size_t choice = 0; choice < (std::size_t{1} << grey.size()); ++choice) {
    Four<Many> vector{Many(0.0), Many(0.0), Many(0.0), Many(0.0)};
    for (std::size_t i = 0; i < question.asked.size(); ++i) {
      double side = sign[i];
      for (std::size_t g = 0; g < grey.size(); ++g)
        if (grey[g] == i && (choice >> g & 1) != 0) side = -side;
      vector = sum(vector, scaled(Many(Many(side) * question.asked[i].weight), question.asked[i].orientation));
    }
    result.answers.push_back(answer(question, vector));
  }
  result.near = near || result.answers.front().scale > 1 / compare::near_factor;
  return result;
}

}  // namespace

std::vector<compare::OrientationAnswer> orientation(const compare::OrientationCase& question) {
  return accepted(question).answers;
}

compare::OrientationTruth orientation(const compare::OrientationIn& in) {
  compare::OrientationTruth truth{std::vector<std::vector<compare::OrientationAnswer>>(in.cases.size()),
                                  std::vector<std::uint8_t>(in.cases.size())};
  tbb::parallel_for(std::size_t{0}, in.cases.size(), [&](std::size_t i) {
    Accepted found = accepted(in.cases[i]);
    truth.accepted[i] = std::move(found.answers);
    truth.near[i] = found.near;
  });
  return truth;
}

}  // namespace ogc::reference
