// The rods of a scene in double, for whole runs: quaternions of all segments, how a step begins them, their sweep, the
// forces that vertices feel from them, energies and residual (compare/rods.md).
#pragma once

#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "compare/problem/scene.hpp"
#include "compare/stages/rest_state.hpp"
#include "reference/energies/rods/on_sphere.hpp"
#include "reference/energies/stencils/stencil_derivatives.hpp"
#include "reference/energies/vertex_block.hpp"

namespace ogc::reference {

/// A segment with what of it is constant in a step.
struct RodTerm {
  std::array<compare::Index, 2> vertex{-1, -1};     ///< x₀, x₁
  double length = 0, stretch = 0, damping = 0;      ///< l [m], k_s [N], k [1]
  Triple<double> start{};                           ///< R(qᵗ)ᵀ Dᵗ/l
  std::array<compare::Index, 2> neighbour{-1, -1};  ///< behind, ahead
  std::array<double, 2> weight{};                   ///< w = 4 k_b/l̄ [N m]
  std::array<FourOf<double>, 2> rest{}, before{};   ///< p°, pᵗ, as the segment sees them
  compare::Index held = -1;                         ///< as compare::segment_groups
};

/// Colours of the segments that nothing holds, −1 of others: no two neighbours share one, and each has the lowest that
/// its lower-numbered neighbours leave.
std::vector<compare::Index> segment_colours_of(const compare::RestStateOut& rest,
                                               const std::vector<compare::Index>& held);

/// Orientations of the scene's start: those that it gives, or of the rest shape, turned to where each segment starts.
std::vector<compare::Quaternion> start_orientations(const compare::Scene& scene, const compare::RestStateOut& rest);

/// q after the smallest rotation from one direction to another; half a turn about the first axis of q between opposite
/// ones, and q itself where one of them is 0.
FourOf<double> turned_along(const Triple<double>& from, const Triple<double>& to, const FourOf<double>& q);

/// The rods of one scene, step after step.
class RodSystem {
 public:
  /// The scene must be rounded and outlive it.
  RodSystem(const compare::Scene& scene, const compare::RestStateOut& rest);

  bool is_used() const { return !terms_.empty(); }  ///< whether there are any
  /// qᵗ of the next step; those of the scene's start where there are none.
  void set_start(std::span<const compare::Quaternion> orientations);
  /// q of a state that another solver made; where there are none, q stays.
  void put(std::span<const compare::Quaternion> orientations);
  /// q, rounded.
  std::vector<compare::Quaternion> orientations() const;

  /// xᵗ: what damping counts from.
  void begin_step(const std::vector<Triple<double>>& start, std::int64_t number);
  /// After the guess loop: q turned from qᵗ as segments have turned from xᵗ to x.
  void turn(const std::vector<Triple<double>>& x);
  /// Each free segment to its minimiser, colour by colour.
  void sweep(const std::vector<Triple<double>>& x);

  /// All segments.
  std::span<const RodTerm> terms() const { return terms_; }
  /// Adds segment `e` as its end `end` feels it; `ends`: where its ends are.
  void add_force(compare::Index e, std::size_t end, const std::array<Triple<double>, 2>& ends,
                 VertexSystemOf<double>& sum) const;

  // As stencils of Newton's method: segments, then joints. Behind the vertices, at `vertex_count + e`, stands ω of
  // segment e, three unknowns: positions that hold it mean q exp(ω/2), others q.
  std::size_t size() const { return terms_.size() + joints_.size(); }
  std::array<compare::Index, 4> vertices(std::size_t stencil) const;
  /// How many of these, the first ones, are vertices: two of a segment, none of a joint.
  std::size_t corners(std::size_t stencil) const { return stencil < terms_.size() ? 2 : 0; }
  /// Damping included [J].
  double energy(std::size_t stencil, const std::vector<Triple<double>>& x) const;
  /// At ω = 0.
  StencilDerivatives derivatives(std::size_t stencil, const std::vector<Triple<double>>& x,
                                 HessianProjection projection) const;
  /// Into the places behind `to`. Calls `finished` with the number of each stencil, on the thread that did it.
  template <class Finished>
  void differentiate(const std::vector<Triple<double>>& x, HessianProjection projection, StencilDerivatives* to,
                     Finished finished) const {
    tbb::parallel_for(std::size_t{0}, size(), [&](std::size_t i) {
      to[i] = derivatives(i, x, projection);
      finished(i);
    });
  }
  double length(std::size_t segment) const { return terms_[segment].length; }  ///< l [m]
  std::size_t segments() const { return terms_.size(); }
  bool is_free(std::size_t segment) const { return terms_[segment].held == -1; }
  /// What stands on the diagonal of ω, so that a matrix in which a twist is free is definite: far below k_s l [N m].
  double regularisation(std::size_t segment) const { return 1e-8 * terms_[segment].stretch * terms_[segment].length; }
  /// q ← q exp(ω/2), where there are ω behind the positions.
  void turn_by(const std::vector<Triple<double>>& x);

  double elastic_energy(const std::vector<Triple<double>>& x) const;  ///< without damping [J]
  /// Adds it to a sum [J].
  void add_elastic(const std::vector<Triple<double>>& x, double& sum) const { sum += elastic_energy(x); }
  /// Mean of ‖(I − q qᵀ)(M q + b)‖ over the free segments [N m].
  double mean_torque(const std::vector<Triple<double>>& x) const;
  /// Mean and largest ‖D‖/l − 1.
  struct Stretch {
    double mean = 0, largest = 0;
  };
  Stretch stretch(const std::vector<Triple<double>>& x) const;

 private:
  using Positions = std::vector<Triple<double>>;
  Triple<double> apart(std::size_t e, const Positions& x) const;
  on_sphere::Problem<double> problem(std::size_t e, const Positions& x) const;
  /// A neighbour `second` across end `end` of segment `first` < `second`.
  struct Joint {
    std::size_t first, end, second;
  };
  FourOf<double> orientation(std::size_t e, const Positions& x) const;

  const compare::Scene& scene_;
  std::vector<RodTerm> terms_;
  std::vector<Joint> joints_;
  std::size_t vertex_count_;
  std::vector<std::vector<std::size_t>> classes_;  ///< free segments by colour
  std::vector<compare::Quaternion> scene_start_;
  std::vector<FourOf<double>> start_, q_;
  Positions start_positions_;
  std::int64_t number_ = 1;
};

}  // namespace ogc::reference
