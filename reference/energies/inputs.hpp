// Differentiates first by the inputs of a stencil, so that each later derivative (force, block) comes with its
// condition: the unit in which the judge counts errors (compare/stages/force.hpp).
#pragma once

#include <span>
#include <vector>

#include "compare/stages/force.hpp"
#include "reference/energies/vertex_block.hpp"

namespace ogc::reference {

/// A number with its derivatives by the inputs of a question.
using Input = Derivative<double, 28>;
/// A number with its derivatives by the coordinates of the own vertex, whose force the question is about.
using ByVertex = Derivative<Input, 3>;

/// Collects the inputs of one stencil.
class Inputs {
 public:
  /// Returns p − from as one input. It is exact: differences of single-precision numbers of one size have no rounding
  /// in double.
  Triple<Input> vector(const compare::Vec3f& p, const compare::Vec3f& from);
  /// Returns a given number, known to u of itself.
  Input number(double value) { return number(value, std::abs(value)); }
  /// Returns a number known to u times `size`. If `size` is the condition of a computed number, that number's inputs
  /// need not be carried along.
  Input number(double value, double size);
  /// Returns all points of a stencil relative to points[origin], whose entry is 0. A kernel may form its differences
  /// from any one of them, so the condition is the largest over these choices.
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
    std::array<double, 3> at{};  ///< the value of a vector
  };
  struct Range {
    std::size_t begin, end;
  };
  double stencil_condition(std::span<const Input> answer, const Range& stencil) const;
  std::vector<Group> groups_;
  std::vector<Range> stencils_;
  std::size_t used_ = 0;
};

/// Returns a point that does not move with the own vertex.
Triple<ByVertex> fixed(const Triple<Input>& point);
/// Returns the own vertex, at the origin of the relative coordinates.
Triple<ByVertex> own_vertex();

/// A sweep's block in Input numbers.
using Block = BlockOf<Input>;

/// Returns a force and its block as an answer.
compare::ForceAnswer answer(const Inputs& inputs, const VertexSystemOf<Input>& system);
/// Returns the answer of an energy, whose force is minus its slope, and a block.
compare::ForceAnswer answer(const Inputs& inputs, const ByVertex& energy, const Block& block);

/// Adds damping by vertex to an elastic force with block B: −k B moved, where `moved` is the vertex's motion since the
/// start of the step and k is `damping`, and (1 + k) B for B.
compare::ForceAnswer damped_by_vertex(const Inputs& inputs, const VertexSystemOf<Input>& elastic, const Input& damping,
                                      const Triple<Input>& moved);

/// Multiplies the units of error, for a model whose tolerances differ from those of its stage.
compare::ForceAnswer with_units(compare::ForceAnswer answer, double force, double block);
/// Adds two answers that are rounded separately.
compare::ForceAnswer sum(compare::ForceAnswer a, const compare::ForceAnswer& b);

}  // namespace ogc::reference
