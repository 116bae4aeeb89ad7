// Differentiates by the inputs of a stencil first, so that each later derivative (force, block) has a condition. The
// condition is the unit in which the judge counts errors (compare/stages/force.hpp).
#pragma once

#include <span>
#include <vector>

#include "compare/stages/force.hpp"
#include "reference/energies/vertex_block.hpp"

namespace ogc::reference {

/// A number with its derivatives by the inputs of a question.
using Input = Derivative<double, 28>;
/// A number with its derivatives by the own vertex, on which the question's force acts.
using ByVertex = Derivative<Input, 3>;

/// Collects the inputs of one stencil.
class Inputs {
 public:
  /// Returns p − from as one input. It is exact, because double holds the difference of two single-precision numbers of
  /// similar size.
  Triple<Input> vector(const compare::Vec3f& p, const compare::Vec3f& from);
  /// Returns a given number with the error u |value|.
  Input number(double value) { return number(value, std::abs(value)); }
  /// Returns a number with the error u · `size`. If `size` is the condition of a computed number, that number's own
  /// inputs can be dropped.
  Input number(double value, double size);
  /// Returns all points of a stencil relative to points[origin], whose entry is 0. A kernel may take any point as the
  /// origin, so the condition is the largest over all origins.
  template <std::size_t N>
  std::array<Triple<Input>, N> stencil(const std::array<compare::Vec3f, N>& points, std::size_t origin) {
    std::array<Triple<Input>, N> relative;
    stencils_.push_back({groups_.size(), groups_.size() + N - 1});
    for (std::size_t k = 0; k < N; ++k)
      if (k != origin) relative[k] = vector(points[k], points[origin]);
    return relative;
  }
  /// Returns Σ ‖∂f/∂q‖ ‖q‖ over the inputs q, for an answer f of several numbers (Euclidean norms).
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

/// Returns a point that does not depend on the own vertex.
Triple<ByVertex> fixed(const Triple<Input>& point);
/// Returns the own vertex, which is the origin of the relative coordinates.
Triple<ByVertex> own_vertex();

using Block = BlockOf<Input>;

/// Returns a force and its block as an answer.
compare::ForceAnswer answer(const Inputs& inputs, const VertexSystemOf<Input>& system);
/// Returns the answer of an energy, whose force is minus its slope, and a block.
compare::ForceAnswer answer(const Inputs& inputs, const ByVertex& energy, const Block& block);

/// Adds damping by vertex to an elastic force with the block B: adds −k B `moved` to the force and k B to the block.
/// `moved` is the vertex's motion since the start of the step, k is `damping`.
compare::ForceAnswer damped_by_vertex(const Inputs& inputs, const VertexSystemOf<Input>& elastic, const Input& damping,
                                      const Triple<Input>& moved);

/// Multiplies the units of error, for a model with other tolerances than its stage.
compare::ForceAnswer with_units(compare::ForceAnswer answer, double force, double block);
/// Adds two answers that are rounded separately.
compare::ForceAnswer sum(compare::ForceAnswer a, const compare::ForceAnswer& b);

}  // namespace ogc::reference
