// Differentiates an energy by all given numbers q of its stencil (positions, constants). These derivatives are the
// innermost of nested derivatives. So each outer derivative f (force, block) has a condition Σ ‖∂f/∂q‖ ‖q‖. The judge
// takes it as the error scale of f (compare/stages/force.hpp).
#pragma once

#include <span>
#include <vector>

#include "compare/stages/force.hpp"
#include "reference/energies/vertex_block.hpp"

namespace ogc::reference {

/// A number with its derivatives by the given numbers of one case.
using Input = Derivative<double, 28>;
/// An Input number with its derivatives by the position of the own vertex, on which the force acts.
using ByVertex = Derivative<Input, 3>;

/// Collects the given numbers (inputs) of one stencil.
class Inputs {
 public:
  /// Returns p − from as one input. Double holds the difference of two single-precision numbers of similar size
  /// exactly.
  Triple<Input> vector(const compare::Vec3f& p, const compare::Vec3f& from);
  /// Returns a given number as an input. Its error is u |value|, u = 2⁻²⁴.
  Input number(double value) { return number(value, std::abs(value)); }
  /// Returns a number as an input whose error is u · `size`. For a computed number, pass its condition as `size`; the
  /// inputs from which it was computed are then not needed.
  Input number(double value, double size);
  /// Returns all points of a stencil relative to points[origin]; the entry of points[origin] is 0. A kernel may take
  /// any point as the origin, so the condition is the largest over all origins.
  template <std::size_t N>
  std::array<Triple<Input>, N> stencil(const std::array<compare::Vec3f, N>& points, std::size_t origin) {
    std::array<Triple<Input>, N> relative;
    stencils_.push_back({groups_.size(), groups_.size() + N - 1});
    for (std::size_t k = 0; k < N; ++k)
      if (k != origin) relative[k] = vector(points[k], points[origin]);
    return relative;
  }
  /// Returns Σ ‖∂f/∂q‖ ‖q‖ (Euclidean norms) over the inputs q. f is `answer`, which may have several numbers.
  double condition(std::span<const Input> answer) const;

 private:
  struct Group {
    std::size_t first, count;
    double size;
    std::array<double, 3> at{};  ///< value, if the input is a vector
  };
  struct Range {
    std::size_t begin, end;
  };
  double stencil_condition(std::span<const Input> answer, const Range& stencil) const;
  std::vector<Group> groups_;
  std::vector<Range> stencils_;
  std::size_t used_ = 0;
};

/// Returns a point whose derivatives by the own vertex are 0.
Triple<ByVertex> fixed(const Triple<Input>& point);
/// Returns the own vertex as the variable, at the origin of the relative coordinates.
Triple<ByVertex> own_vertex();

using Block = BlockOf<Input>;

/// Returns force and block as an answer, with their error scales.
compare::ForceAnswer answer(const Inputs& inputs, const VertexSystemOf<Input>& system);
/// Returns the force −∂E/∂x of `energy` and the given block as an answer, with their error scales.
compare::ForceAnswer answer(const Inputs& inputs, const ByVertex& energy, const Block& block);

/// Returns force and block with damping by vertex. Adds −k B `moved` to the elastic force and k B to the elastic block
/// B. `moved` is the vertex's motion since the start of the step, k is `damping`.
compare::ForceAnswer damped_by_vertex(const Inputs& inputs, const VertexSystemOf<Input>& elastic, const Input& damping,
                                      const Triple<Input>& moved);

/// Multiplies the error scales of force and block by `force` and `block`, for a model whose tolerances differ from
/// those of its stage.
compare::ForceAnswer with_units(compare::ForceAnswer answer, double force, double block);
/// Returns the sum of two answers that are rounded separately; their error scales add up.
compare::ForceAnswer sum(compare::ForceAnswer a, const compare::ForceAnswer& b);

}  // namespace ogc::reference
