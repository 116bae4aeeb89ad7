// Newton's method on the energy that sweeps descend, with everything fixed that a step changes on its way: contact sets
// and their e_k, and λ, n and w of friction. No bounds and no detections, so there is one question: where is the
// gradient zero, and how far from there may a state be whose gradient is not.
//
// With H ⪰ λ I on the straight line between a state x and the minimiser x*, the mean value theorem gives
// ‖x − x*‖ ≤ ‖∇E(x)‖/λ, over all free coordinates, and Taylor's theorem ‖x − x*‖² ≤ 2 (E(x) − E(x*))/λ. The first is
// far from tight where the gradient is that of stiff directions, as what storing positions leaves is; the second less.
// Both also hold where H jumps (a contact that begins to act, a closest point that leaves its edge): ∇E does not.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "compare/stages/sweep.hpp"

namespace ogc::reference {

/// Where Newton's method ended.
struct Minimum {
  std::vector<std::array<double, 3>> position;  ///< of all vertices [m]
  /// Mean ‖∂E/∂x_v‖ over free vertices before each iteration, and at the end [N].
  std::vector<double> forces;
  bool converged = false;  ///< the last force is what rounding of positions alone makes
};

/// ∇E at a state, over free vertices.
struct Gradient {
  double norm = 0;  ///< ‖∇E‖ [N]
  double mean = 0;  ///< mean ‖∂E/∂x_v‖, the numerator of Eq. 29 [N]
};

/// Finds the minimiser of the energy of one question of a sweep.
class Minimiser {
 public:
  using Positions = std::vector<std::array<double, 3>>;  ///< of all vertices [m]

  /// E of the question of a sweep: its scene, which must outlive this, xᵗ, y, contacts found at X_prev; its bounds,
  /// colours and old positions are not read. There is no friction before `lag_friction`. Throws compare::InputError for
  /// damping by vertex.
  explicit Minimiser(const compare::SweepIn& in);
  ~Minimiser();
  /// λ, n and w of friction are those of this state until the next call.
  void lag_friction(const Positions& x);
  /// From this state, prescribed vertices at their targets. Not converged where no step lowers the energy, or after
  /// 200 iterations.
  Minimum minimum(const Positions& from);
  /// At these positions [m].
  Gradient gradient(const Positions& x);
  /// E(x) − E(y), term by term [J].
  double energy_above(const Positions& x, const Positions& y) const;
  /// A λ with H(x) ⪰ λ I [N/m]: a Cholesky factorisation of H(x) − λ I has succeeded, up to its rounding. It is the
  /// smallest eigenvalue less a part in 2¹⁰. Nothing where H(x) is not positive definite.
  std::optional<double> smallest_eigenvalue(const Positions& x);

 private:
  class Problem;
  std::unique_ptr<Problem> problem_;
};

}  // namespace ogc::reference
