// The truth about an orientation follows from the energy alone: its minimisers are sought by Newton's method on the
// unit sphere, which knows neither the eigenvectors of M nor the equation of its multiplier. A function of this kind
// has at most one local minimiser that is not global (Martínez 1994), so that a handful of starts, in double, finds the
// basin; the rest is done in numbers of 113 bits, in which b is known beside an M of 10²⁰ times its size.
#include "reference/energies/rods/orientation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <tbb/parallel_for.h>

#include "reference/energies/rods/rod_terms.hpp"

namespace ogc::reference {
namespace {

/// Binary128, of 113 bits: the compiler's own, whose exponents need no care.
__extension__ using Many = __float128;

using std::sqrt;
/// Newton's method on the root in double, which doubles its bits twice.
Many sqrt(const Many& x) {
  if (!(x > 0)) return 0;
  Many root = std::sqrt(static_cast<double>(x));
  for (int step = 0; step < 2; ++step) root = (root + x / root) / 2;
  return root;
}

template <class T>
using Four = FourOf<T>;
/// Symmetric, 3×3: of the tangent space.
template <class T>
using Square = std::array<Triple<T>, 3>;

template <class T>
Four<T> wide(const compare::Quaternion& q) {
  return {T(q[0]), T(q[1]), T(q[2]), T(q[3])};
}

template <class T>
Triple<T> difference(const compare::Vec3f& a, const compare::Vec3f& b) {
  return {T(a.x) - T(b.x), T(a.y) - T(b.y), T(a.z) - T(b.z)};
}

template <class T>
Four<T> scaled(const T& s, const Four<T>& a) {
  return {s * a[0], s * a[1], s * a[2], s * a[3]};
}
template <class T>
Four<T> sum(const Four<T>& a, const Four<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}
template <class T>
T size_of(const Four<T>& a) {
  return sqrt(inner(a, a));
}
template <class T>
T length_of(const Triple<T>& a) {
  return sqrt(dot(a, a));
}

/// i, j, k, 1.
template <class T>
Four<T> basis(std::size_t k) {
  Four<T> e{T(0.0), T(0.0), T(0.0), T(0.0)};
  e[k] = T(1.0);
  return e;
}

/// What the energy −½ qᵀ M q − b·q consists of.
template <class T>
struct Problem {
  Triple<T> apart, direction;  ///< D [m], c [1]
  T stretch;                   ///< k_s [N]
  Four<T> vector;              ///< b [N m]
  std::array<Four<T>, 4> matrix;

  void fill_matrix() {
    for (std::size_t k = 0; k < 4; ++k) {
      const Four<T> column = turned(basis<T>(k));
      for (std::size_t row = 0; row < 4; ++row) matrix[row][k] = column[row];
    }
  }
  /// M q.
  Four<T> turned(const Four<T>& q) const {
    return scaled(T(T(-2.0) * stretch), product(product(pure(apart), q), pure(direction)));
  }
  Four<T> pull(const Four<T>& q) const {
    Four<T> all = vector;
    for (std::size_t row = 0; row < 4; ++row) all[row] += inner(matrix[row], q);
    return all;
  }
  T energy(const Four<T>& q) const {
    T all = T(0.0) - inner(vector, q);
    for (std::size_t row = 0; row < 4; ++row) all -= T(0.5) * q[row] * inner(matrix[row], q);
    return all;
  }
  template <class To>
  Problem<To> as() const {
    Problem<To> to;
    for (std::size_t k = 0; k < 3; ++k) {
      to.apart[k] = static_cast<To>(apart[k]);
      to.direction[k] = static_cast<To>(direction[k]);
    }
    to.stretch = static_cast<To>(stretch);
    for (std::size_t row = 0; row < 4; ++row) {
      to.vector[row] = static_cast<To>(vector[row]);
      for (std::size_t k = 0; k < 4; ++k) to.matrix[row][k] = static_cast<To>(matrix[row][k]);
    }
    return to;
  }
};

/// A basis of the tangent space at q: q i, q j, q k.
template <class T>
std::array<Four<T>, 3> tangents(const Four<T>& q) {
  return {product(q, basis<T>(0)), product(q, basis<T>(1)), product(q, basis<T>(2))};
}

/// The slope of the energy along the tangents, and its second derivative on the sphere.
template <class T>
struct OnSphere {
  Triple<T> slope;
  Square<T> bend;

  OnSphere(const Problem<T>& problem, const Four<T>& q) {
    const Four<T> pull = problem.pull(q);
    const T multiplier = inner(q, pull);
    const auto along = tangents(q);
    for (std::size_t i = 0; i < 3; ++i) {
      slope[i] = T(0.0) - inner(pull, along[i]);
      Four<T> turned;
      for (std::size_t row = 0; row < 4; ++row) turned[row] = inner(problem.matrix[row], along[i]);
      for (std::size_t j = 0; j < 3; ++j) bend[i][j] = (i == j ? multiplier : T(0.0)) - inner(turned, along[j]);
    }
  }
};

/// The solution of (A + shift I) x = y by Cholesky's method; none where that matrix is not positive definite.
template <class T>
std::optional<Triple<T>> solve(const Square<T>& a, const T& shift, const Triple<T>& y) {
  std::array<Triple<T>, 3> lower;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      T left = a[i][j] + (i == j ? shift : T(0.0));
      for (std::size_t k = 0; k < j; ++k) left -= lower[i][k] * lower[j][k];
      if (i == j && !(left > 0.0)) return std::nullopt;
      lower[i][j] = i == j ? T(sqrt(left)) : T(left / lower[j][j]);
    }
  Triple<T> x = y;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < i; ++k) x[i] -= lower[i][k] * x[k];
    x[i] /= lower[i][i];
  }
  for (std::size_t i = 3; i-- > 0;) {
    for (std::size_t k = i + 1; k < 3; ++k) x[i] -= lower[k][i] * x[k];
    x[i] /= lower[i][i];
  }
  return x;
}

/// Minimises from q on; until the slope is `enough` of `unit`, or nothing gets lower. A shift makes the second
/// derivative positive definite where it is not.
template <class T>
Four<T> minimised(const Problem<T>& problem, Four<T> q, const T& unit, double enough) {
  q = scaled(T(T(1.0) / size_of(q)), q);
  T energy = problem.energy(q);
  for (int step = 0; step < 100; ++step) {
    const OnSphere<T> at(problem, q);
    if (!(length_of(at.slope) > T(enough) * unit)) break;
    T shift(0.0);
    auto turn = solve(at.bend, shift, at.slope);
    while (!turn) {
      shift = shift > 0.0 ? T(T(16.0) * shift) : T(T(0x1p-120) * unit);  // as small as will do: curvatures differ
      turn = solve(at.bend, shift, at.slope);
    }
    bool lower = false;
    for (T share(1.0); share > T(0x1p-40) && !lower; share *= T(0.5)) {
      Four<T> there = product(
          q, Four<T>{T(0.0) - share * (*turn)[0], T(0.0) - share * (*turn)[1], T(0.0) - share * (*turn)[2], T(1.0)});
      there = scaled(T(T(1.0) / size_of(there)), there);
      const T found = problem.energy(there);
      // Near the end the energy no longer tells, and full steps are right.
      const bool is_small = length_of(*turn) < T(1e-4) && shift == 0.0;
      if (found < energy || (is_small && share == 1.0)) q = there, energy = found, lower = true;
    }
    if (!lower) break;
  }
  return q;
}

/// The least of what is reached from many starts.
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
  // Where nearly a whole circle of quaternions is as good, ends stand all around it: the lowest lead to the minimiser.
  std::ranges::sort(ends, {}, [&](const Four<double>& q) { return rough.energy(q); });
  ends.resize(std::min<std::size_t>(ends.size(), 4));
  for (const Four<double>& end : ends) {
    const Four<Many> q = minimised(problem, {Many(end[0]), Many(end[1]), Many(end[2]), Many(end[3])}, unit, 1e-30);
    const Many energy = problem.energy(q);
    if (!best || energy < lowest) best = q, lowest = energy;
  }
  return *best;
}

/// One of the orientations that neighbours ask for, and their twins.
struct Asked {
  Four<Many> orientation;  ///< t
  Many weight;             ///< w, or k w [N m]
  Many agreement;          ///< t·q of the old q
};

/// A case in exact numbers: products of single-precision numbers, five of them at most, are exact in 113 bits but for
/// their last.
struct Question {
  Four<Many> old;
  Problem<Many> problem;  ///< without b
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

/// ‖H⁻¹ (columns)‖, Euclidean; infinite where H is not positive definite.
double reaction(const Square<Many>& bend, const std::vector<Triple<Many>>& columns) {
  Many squared(0.0);
  for (const Triple<Many>& column : columns) {
    const auto x = solve(bend, Many(0.0), column);
    if (!x) return std::numeric_limits<double>::infinity();
    squared += dot(*x, *x);
  }
  return static_cast<double>(sqrt(squared));
}

/// What a vector of four is along the tangents.
Triple<Many> along(const std::array<Four<Many>, 3>& basis, const Four<Many>& v) {
  return {inner(basis[0], v), inner(basis[1], v), inner(basis[2], v)};
}

/// Σ ‖∂q/∂y‖ ‖y‖ at the minimiser q. `pull`: what stands for b and its size.
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

/// As far as tolerances reach, does another minimiser stand in for this one? A quarter of a radian: beyond it the first
/// order says nothing.
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
    // Of those that are as good without neighbours the one nearest to the old q: it asks for itself, faintly.
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
