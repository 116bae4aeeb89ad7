#include "reference/energies/inputs.hpp"

#include <algorithm>

namespace ogc::reference {

namespace {

/// Returns the size of an input for `condition`: the length, but at least 2⁻¹⁰⁰ m if it is not 0. Products of smaller
/// lengths with the factors of an energy may underflow.
double sized(double length) { return length == 0 ? 0 : std::max(length, 0x1p-100); }

}  // namespace

Triple<Input> Inputs::vector(const compare::Vec3f& p, const compare::Vec3f& from) {
  const std::array<double, 3> relative{double{p.x} - from.x, double{p.y} - from.y, double{p.z} - from.z};
  groups_.push_back({used_, 3, sized(std::hypot(relative[0], relative[1], relative[2])), relative});
  Triple<Input> point;
  for (std::size_t k = 0; k < 3; ++k) point[k] = Input(relative[k], used_++);
  return point;
}

Input Inputs::number(double value, double size) {
  groups_.push_back({used_, 1, size});
  return Input(value, used_++);
}

namespace {

/// The derivatives of an answer f by a vector q; row i holds ∂fᵢ/∂q.
using Rows = std::vector<std::array<double, 3>>;

Rows rows_of(std::span<const Input> answer, std::size_t first) {
  Rows rows;
  for (const Input& x : answer) rows.push_back({x.slope[first], x.slope[first + 1], x.slope[first + 2]});
  return rows;
}

double norm(const Rows& rows) {
  double squared = 0;
  for (const auto& row : rows) squared += row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
  return std::sqrt(squared);
}

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return sized(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
}

}  // namespace

double Inputs::stencil_condition(std::span<const Input> answer, const Range& stencil) const {
  // The point at the origin is points[0]. Moving it changes the answer as moving all other points in the opposite
  // direction does.
  std::vector<std::array<double, 3>> points(1);
  std::vector<double> norms(1);
  Rows origin(answer.size());
  for (std::size_t g = stencil.begin; g < stencil.end; ++g) {
    const Rows rows = rows_of(answer, groups_[g].first);
    points.push_back(groups_[g].at);
    norms.push_back(norm(rows));
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) origin[i][k] += rows[i][k];
  }
  norms[0] = norm(origin);
  double largest = 0;
  for (const auto& base : points) {
    double sum = 0;
    for (std::size_t j = 0; j < points.size(); ++j) sum += norms[j] * distance(points[j], base);
    largest = std::max(largest, sum);
  }
  return largest;
}

double Inputs::condition(std::span<const Input> answer) const {
  double sum = 0;
  std::size_t next = 0;
  for (const Range& stencil : stencils_) sum += stencil_condition(answer, stencil);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    while (next < stencils_.size() && g >= stencils_[next].end) ++next;
    if (next < stencils_.size() && g >= stencils_[next].begin) continue;
    const Group& group = groups_[g];
    double squared = 0;
    for (const Input& x : answer)
      for (std::size_t i = 0; i < group.count; ++i) squared += x.slope[group.first + i] * x.slope[group.first + i];
    sum += std::sqrt(squared) * group.size;
  }
  return sum;
}

Triple<ByVertex> fixed(const Triple<Input>& point) {
  return {ByVertex(point[0]), ByVertex(point[1]), ByVertex(point[2])};
}

Triple<ByVertex> own_vertex() { return {ByVertex(Input(0.0), 0), ByVertex(Input(0.0), 1), ByVertex(Input(0.0), 2)}; }

compare::ForceAnswer answer(const Inputs& inputs, const VertexSystemOf<Input>& system) {
  compare::ForceAnswer result;
  result.force = {system.force[0].value, system.force[1].value, system.force[2].value};
  for (std::size_t k = 0; k < 6; ++k) result.block[k] = system.block[k].value;
  result.force_scale = inputs.condition(system.force);
  result.block_scale = inputs.condition(system.block);
  return result;
}

compare::ForceAnswer answer(const Inputs& inputs, const ByVertex& energy, const Block& block) {
  return answer(inputs, {{-energy.slope[0], -energy.slope[1], -energy.slope[2]}, block});
}

compare::ForceAnswer damped_by_vertex(const Inputs& inputs, const VertexSystemOf<Input>& elastic, const Input& damping,
                                      const Triple<Input>& moved) {
  const Block& block = elastic.block;
  const Triple<Input> resisted{dot(Triple<Input>{block[0], block[1], block[2]}, moved),
                               dot(Triple<Input>{block[1], block[3], block[4]}, moved),
                               dot(Triple<Input>{block[2], block[4], block[5]}, moved)};
  VertexSystemOf<Input> damped;
  for (std::size_t i = 0; i < 3; ++i) damped.force[i] = elastic.force[i] - damping * resisted[i];
  for (std::size_t i = 0; i < 6; ++i) damped.block[i] = (Input(1.0) + damping) * block[i];
  return answer(inputs, damped);
}

compare::ForceAnswer with_units(compare::ForceAnswer answer, double force, double block) {
  answer.force_scale *= force;
  answer.block_scale *= block;
  return answer;
}

compare::ForceAnswer sum(compare::ForceAnswer a, const compare::ForceAnswer& b) {
  a.force = {a.force.x + b.force.x, a.force.y + b.force.y, a.force.z + b.force.z};
  for (std::size_t k = 0; k < 6; ++k) a.block[k] += b.block[k];
  a.force_scale += b.force_scale;
  a.block_scale += b.block_scale;
  return a;
}

}  // namespace ogc::reference
