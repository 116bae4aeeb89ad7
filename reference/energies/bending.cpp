#include "reference/energies/bending.hpp"

#include <algorithm>
#include <numbers>
#include <vector>

#include "reference/energies/inputs.hpp"
#include "reference/energies/parallel.hpp"

namespace ogc::reference {
namespace {

template <class T>
using Hinge = std::array<Triple<T>, 4>;

template <class T>
bool is_zero(const Triple<T>& a) {
  return plain(a[0]) == 0 && plain(a[1]) == 0 && plain(a[2]) == 0;
}

template <class T>
double plain_length(const Triple<T>& a) {
  return std::hypot(plain(a[0]), plain(a[1]), plain(a[2]));
}

/// The two normals and the edge between them.
template <class T>
struct Fold {
  Hinge<T> x;
  Triple<T> edge, first, second;
  explicit Fold(const Hinge<T>& at) : x(at), edge(x[1] - x[0]), first(cross(edge, x[2] - x[0])), second(cross(x[3] - x[0], edge)) {}
  bool collapsed() const { return is_zero(first) || is_zero(second); }
  bool may_count_as_collapsed() const { return is_needle(first, x[2]) || is_needle(second, x[3]); }
  /// Whether the sine at an end of the edge is below the contract's limit; the longer side has the smaller sine.
  bool is_needle(const Triple<T>& normal, const Triple<T>& opposite) const {
    const double side = std::max(plain_length(opposite - x[0]), plain_length(opposite - x[1]));
    return plain_length(normal) < compare::bending_needle * compare::unit_roundoff * plain_length(edge) * side;
  }
  /// From the first normal to the second, about the edge.
  T angle() const { return atan2(dot(cross(first, second), edge) / sqrt(dot(edge, edge)), dot(first, second)); }
};

Hinge<ByVertex> now_of(const compare::BendingCase& q, Inputs& inputs) {
  const auto own = static_cast<std::size_t>(q.own);
  const Hinge<Input> relative = inputs.stencil(q.vertex, own);
  Hinge<ByVertex> x;
  for (std::size_t k = 0; k < 4; ++k) x[k] = k == own ? own_vertex() : fixed(relative[k]);
  return x;
}

const Input& at_vertex(const ByVertex& x) { return x.value; }
const Input& at_vertex(const Input& x) { return x; }

/// The angle, and where it cannot be told from ±π also the one on the other side.
template <class T>
std::vector<T> with_turn(const Inputs& inputs, const T& angle) {
  const Input& value = at_vertex(angle);
  const double doubt = compare::bending_grey * compare::unit_roundoff * inputs.condition({&value, 1});
  if (std::abs(value.value) + doubt < std::numbers::pi) return {angle};
  return {angle, angle + T(Input(value.value > 0 ? -2 * std::numbers::pi : 2 * std::numbers::pi))};
}

struct Material {
  Input stiffness, rest_angle, damping;
};

compare::ForceAnswer answer_at(const Inputs& inputs, const Material& m, const ByVertex& angle, const Input& start) {
  const ByVertex bent = angle - ByVertex(m.rest_angle), moved = angle - ByVertex(start);
  const ByVertex energy = ByVertex(Input(0.5) * m.stiffness) * (bent * bent + ByVertex(m.damping) * moved * moved);
  Block block;
  add_outer(block, m.stiffness * (Input(1.0) + m.damping), angle, angle);
  return answer(inputs, energy, block);
}

}  // namespace

std::vector<compare::ForceAnswer> bending(const compare::BendingCase& question) {
  Inputs inputs;
  const Fold<ByVertex> now(now_of(question, inputs));
  const Fold<Input> before(inputs.stencil(question.start, 0));
  const Material material{inputs.number(question.stiffness), inputs.number(question.rest_angle), inputs.number(question.damping)};
  if (now.collapsed()) return {compare::ForceAnswer{}};
  const bool damped = question.damping > 0;
  const std::vector<ByVertex> angles = with_turn(inputs, now.angle());
  std::vector<Input> starts = damped && !before.collapsed() ? with_turn(inputs, before.angle()) : std::vector{Input(0.0)};
  if (damped && !before.collapsed() && before.may_count_as_collapsed()) starts.push_back(Input(0.0));
  std::vector<compare::ForceAnswer> answers;
  for (const ByVertex& angle : angles)
    for (const Input& start : starts) answers.push_back(answer_at(inputs, material, angle, start));
  if (now.may_count_as_collapsed()) answers.push_back({});
  return answers;
}

compare::ForceTruth bending(const compare::BendingIn& in) {
  return for_all(in.cases, [](const compare::BendingCase& question) { return bending(question); });
}

}  // namespace ogc::reference
