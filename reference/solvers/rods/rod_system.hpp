// Computes the rods of a scene in double, for whole runs (compare/rods.md): the quaternions of all segments at the
// start of a step and after each sweep, forces on vertices, energies and residual.
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

/// A segment and its constants in a step.
struct RodTerm {
  std::array<compare::Index, 2> vertex{-1, -1};     ///< x₀, x₁
  double length = 0, stretch = 0, damping = 0;      ///< l [m], k_s [N], k [1]
  Triple<double> start{};                           ///< R(qᵗ)ᵀ Dᵗ/l
  std::array<compare::Index, 2> neighbour{-1, -1};  ///< segments behind and ahead; −1 if there is none
  std::array<double, 2> weight{};                   ///< w = 4 k_b/l̄ [N m]
  std::array<FourOf<double>, 2> rest{}, before{};   ///< p° at rest, pᵗ at xᵗ: rotations relative to each neighbour
  compare::Index held = -1;                         ///< the segment's entry of compare::segment_groups
};

/// Returns a colour for each free segment, −1 for others: the lowest colour that no lower-numbered neighbour has.
std::vector<compare::Index> segment_colours_of(const compare::RestStateOut& rest,
                                               const std::vector<compare::Index>& held);

/// Returns the orientations at the scene's start: those that the scene gives, otherwise the orientations of the rest
/// shape, each rotated so that its director is along the segment at the start.
std::vector<compare::Quaternion> start_orientations(const compare::Scene& scene, const compare::RestStateOut& rest);

/// Returns q after the smallest rotation from one direction to another. Opposite directions give a rotation by π about
/// the first axis of q. If a direction is zero, returns q.
FourOf<double> turned_along(const Triple<double>& from, const Triple<double>& to, const FourOf<double>& q);

/// The rods of one scene, step after step.
class RodSystem {
 public:
  /// Takes a rounded scene, which must outlive this object.
  RodSystem(const compare::Scene& scene, const compare::RestStateOut& rest);

  bool is_used() const { return !terms_.empty(); }  ///< whether the scene has rods
  /// Sets qᵗ of the next step; an empty span selects the orientations at the scene's start. Throws
  /// std::invalid_argument if the number of segments differs.
  void set_start(std::span<const compare::Quaternion> orientations);
  /// Sets q, for a state of another solver; an empty span keeps q. Throws std::invalid_argument if the number of
  /// segments differs.
  void put(std::span<const compare::Quaternion> orientations);
  /// Returns q, rounded to single precision.
  std::vector<compare::Quaternion> orientations() const;

  /// Begins a step at xᵗ with q = qᵗ; damping is relative to this state.
  void begin_step(const std::vector<Triple<double>>& start, std::int64_t number);
  /// Sets q after the guess loop by rotating qᵗ:
  ///
  /// - free segment: as its direction rotates from xᵗ to x; not at all with rod_start=kept
  /// - prescribed segment: as its motion rotates; as its direction rotates if the motion defines no rotation
  /// - fixed segment: not at all
  void turn(const std::vector<Triple<double>>& x);
  /// Moves each free segment to its minimiser, colour by colour.
  void sweep(const std::vector<Triple<double>>& x);

  /// Returns all segments.
  std::span<const RodTerm> terms() const { return terms_; }
  /// Adds the force of segment `e` on its end `end`; `ends` are the positions of both ends.
  void add_force(compare::Index e, std::size_t end, const std::array<Triple<double>, 2>& ends,
                 VertexSystemOf<double>& sum) const;

  // Stencils of Newton's method: first the segments, then the joints. The positions may include three unknowns ω of
  // each segment e, at index `vertex_count + e` after the vertices. Then the quaternion of e is q exp(ω/2), otherwise
  // q.
  std::size_t size() const { return terms_.size() + joints_.size(); }
  std::array<compare::Index, 4> vertices(std::size_t stencil) const;
  /// Returns how many of the stencil's first unknowns are vertices: two for a segment, none for a joint.
  std::size_t corners(std::size_t stencil) const { return stencil < terms_.size() ? 2 : 0; }
  /// Returns the energy, damping included [J].
  double energy(std::size_t stencil, const std::vector<Triple<double>>& x) const;
  /// Returns the derivatives at ω = 0.
  StencilDerivatives derivatives(std::size_t stencil, const std::vector<Triple<double>>& x,
                                 HessianProjection projection) const;
  /// Writes the derivatives of all stencils to to[0], to[1], … Calls `finished` with the number of each stencil, on the
  /// thread that computed it.
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
  /// Returns the diagonal term of ω [N m], which is far below k_s l. Without it the matrix of a freely twisting rod
  /// would be singular.
  double regularisation(std::size_t segment) const { return 1e-8 * terms_[segment].stretch * terms_[segment].length; }
  /// Sets q ← q exp(ω/2). x has the ω of all segments after the positions.
  void turn_by(const std::vector<Triple<double>>& x);

  double elastic_energy(const std::vector<Triple<double>>& x) const;  ///< without damping [J]
  /// Adds the elastic energy without damping to `sum` [J].
  void add_elastic(const std::vector<Triple<double>>& x, double& sum) const { sum += elastic_energy(x); }
  /// Returns the mean of ‖(I − q qᵀ)(M q + b)‖ over the free segments [N m].
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
  /// The joint between end `end` of segment `first` and segment `second`; `first` < `second`.
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
