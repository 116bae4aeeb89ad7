// The inputs of a stencil as innermost directions of differentiation, so that each derivative comes with its condition:
// the unit in which the judge counts errors (compare/stages/force.hpp).
#pragma once

#include <span>
#include <vector>

#include "compare/stages/force.hpp"
#include "reference/energies/vertex_block.hpp"

namespace ogc::reference {

/// A number that knows how it reacts to each input.
using Input = Derivative<double, 28>;
/// A number with its derivatives by the coordinates of the vertex asked about.
using ByVertex = Derivative<Input, 3>;

/// Collects the inputs of one stencil.
class Inputs {
 public:
  /// p − from as one input. Exact: differences of single-precision numbers of one size have no rounding in double.
  Triple<Input> vector(const compare::Vec3f& p, const compare::Vec3f& from);
  /// A number that is given, known to u of itself.
  Input number(double value) { return number(value, std::abs(value)); }
  /// A number that is known to u times `size`: with the condition of a number as its size, its own inputs need not be
  /// carried along.
  Input number(double value, double size);
  /// All points of a stencil relative to points[origin], whose entry is 0. A kernel may form its differences from any
  /// one of them: the condition is the largest over these choices.
  template <std::size_t N>
  std::array<Triple<Input>, N> stencil(const std::array<compare::Vec3f, N>& points, std::size_t origin) {
    std::array<Triple<Input>, N> relative;
    stencils_.push_back({groups_.size(), groups_.size() + N - 1});
    for (std::size_t k = 0; k < N; ++k)
      if (k != origin) relative[k] = vector(points[k], points[origin]);
    return relative;
  }
  /// Σ ‖∂f/∂q‖ ‖q‖ over the inputs q, for an answer f of several numbers (Euclidean norms).
  double condition(std::span<const Input> answer) const;

 private:
  struct Group {
    std::size_t first, count;
    double size;
    std::array<double, 3> at{};  ///< of a vector
  };
  struct Range {
    std::size_t begin, end;
  };
  double stencil_condition(std::span<const Input> answer, const Range& stencil) const;
  std::vector<Group> groups_;
  std::vector<Range> stencils_;
  std::size_t used_ = 0;
};

/// A point that does not move with the vertex asked about.
Triple<ByVertex> fixed(const Triple<Input>& point);
/// The vertex asked about, at the origin of the relative coordinates.
Triple<ByVertex> own_vertex();

/// The block of a sweep that knows its inputs.
using Block = BlockOf<Input>;

/// A force and its block as an answer.
compare::ForceAnswer answer(const Inputs& inputs, const VertexSystemOf<Input>& system);
/// The answer from an energy, whose force is minus its slope, and a block.
compare::ForceAnswer answer(const Inputs& inputs, const ByVertex& energy, const Block& block);

/// B moved, of a vertex that moved since the start of the step, as a force of damping `k`: −k B moved, on top of the
/// elastic force, and (1 + k) B for B.
compare::ForceAnswer damped_by_vertex(const Inputs& inputs, const VertexSystemOf<Input>& elastic, const Input& damping,
                                      const Triple<Input>& moved);

/// Multiplies the units of error: what a stage's tolerance is to one of its models.
compare::ForceAnswer with_units(compare::ForceAnswer answer, double force, double block);
/// Both at once, rounded apart.
compare::ForceAnswer sum(compare::ForceAnswer a, const compare::ForceAnswer& b);

}  // namespace ogc::reference
