#include "reference/energies/inputs.hpp"

namespace ogc::reference {

Triple<Input> Inputs::vector(const compare::Vec3f& p, const compare::Vec3f& from) {
  const std::array<double, 3> relative{double{p.x} - from.x, double{p.y} - from.y, double{p.z} - from.z};
  groups_.push_back({used_, 3, std::hypot(relative[0], relative[1], relative[2])});
  Triple<Input> point;
  for (std::size_t k = 0; k < 3; ++k) point[k] = Input(relative[k], used_++);
  return point;
}

Input Inputs::number(double value) {
  groups_.push_back({used_, 1, std::abs(value)});
  return Input(value, used_++);
}

double Inputs::condition(std::span<const Input> answer) const {
  double sum = 0;
  for (const Group& group : groups_) {
    double squared = 0;
    for (const Input& x : answer)
      for (std::size_t i = 0; i < group.count; ++i) squared += x.slope[group.first + i] * x.slope[group.first + i];
    sum += std::sqrt(squared) * group.size;
  }
  return sum;
}

Triple<ByVertex> fixed(const Triple<Input>& point) { return {ByVertex(point[0]), ByVertex(point[1]), ByVertex(point[2])}; }

Triple<ByVertex> own_vertex() { return {ByVertex(Input(0.0), 0), ByVertex(Input(0.0), 1), ByVertex(Input(0.0), 2)}; }

void add_outer(Block& block, const Input& weight, const ByVertex& a, const ByVertex& b) {
  std::size_t k = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j, ++k) block[k] = block[k] + Input(0.5) * weight * (a.slope[i] * b.slope[j] + a.slope[j] * b.slope[i]);
}

void add_identity(Block& block, const Input& weight) {
  for (const std::size_t k : {0u, 3u, 5u}) block[k] = block[k] + weight;
}

compare::ForceAnswer answer(const Inputs& inputs, const ByVertex& energy, const Block& block) {
  compare::ForceAnswer result;
  result.force = {-energy.slope[0].value, -energy.slope[1].value, -energy.slope[2].value};
  for (std::size_t k = 0; k < 6; ++k) result.block[k] = block[k].value;
  result.force_scale = inputs.condition(energy.slope);
  result.block_scale = inputs.condition(block);
  return result;
}

Input positive_part(const Input& x) {
  Input result = x;
  if (result.value < 0) result.value = 0;
  return result;
}

}  // namespace ogc::reference
