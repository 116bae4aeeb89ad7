#include "reference/energies/bending.hpp"

#include <numbers>

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

/// The two normals and the edge between them.
template <class T>
struct Fold {
  Triple<T> edge, first, second;
  explicit Fold(const Hinge<T>& x) : edge(x[1] - x[0]), first(cross(edge, x[2] - x[0])), second(cross(x[3] - x[0], edge)) {}
  bool collapsed() const { return is_zero(first) || is_zero(second); }
  /// From the first normal to the second, about the edge.
  T angle() const { return atan2(dot(cross(first, second), edge) / sqrt(dot(edge, edge)), dot(first, second)); }
};

Hinge<Input> start_of(const compare::BendingCase& q, Inputs& inputs) {
  return {Triple<Input>{}, inputs.vector(q.start[1], q.start[0]), inputs.vector(q.start[2], q.start[0]), inputs.vector(q.start[3], q.start[0])};
}

Hinge<ByVertex> now_of(const compare::BendingCase& q, Inputs& inputs) {
  Hinge<ByVertex> x;
  const auto own = static_cast<std::size_t>(q.own);
  for (std::size_t k = 0; k < 4; ++k) x[k] = k == own ? own_vertex() : fixed(inputs.vector(q.vertex[k], q.vertex[own]));
  return x;
}

/// 2π towards the other side where the angle cannot be told from ±π; 0 elsewhere.
double turn(const Inputs& inputs, const Input& angle) {
  const double doubt = compare::bending_grey * compare::unit_roundoff * inputs.condition({&angle, 1});
  if (std::abs(angle.value) + doubt < std::numbers::pi) return 0;
  return angle.value > 0 ? -2 * std::numbers::pi : 2 * std::numbers::pi;
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
  const Fold<Input> before(start_of(question, inputs));
  const Material material{inputs.number(question.stiffness), inputs.number(question.rest_angle), inputs.number(question.damping)};
  if (now.collapsed()) return {compare::ForceAnswer{}};
  const ByVertex angle = now.angle();
  const Input start = question.damping > 0 && !before.collapsed() ? before.angle() : Input(0.0);
  const double turned = turn(inputs, angle.value), turned_start = turn(inputs, start);
  std::vector<compare::ForceAnswer> answers{answer_at(inputs, material, angle, start)};
  if (turned != 0) answers.push_back(answer_at(inputs, material, angle + ByVertex(turned), start));
  if (turned_start != 0) answers.push_back(answer_at(inputs, material, angle, start + Input(turned_start)));
  if (turned != 0 && turned_start != 0) answers.push_back(answer_at(inputs, material, angle + ByVertex(turned), start + Input(turned_start)));
  return answers;
}

compare::ForceTruth bending(const compare::BendingIn& in) {
  return for_all(in.cases, [](const compare::BendingCase& question) { return bending(question); });
}

}  // namespace ogc::reference
