// Measures trajectories, and solves scalar recursions that several laws share. Masses and energies are implemented
// again from method.md, because a law must not use code of the solvers that it judges.
#pragma once

#include <string>
#include <vector>

#include "compare/laws/law.hpp"
#include "compare/stages/numbers.hpp"

namespace ogc::compare::law_measures {

/// Return a + s b, a · b, a × b and ‖a‖.
Vec3 plus(const Vec3& a, const Vec3& b, double s = 1);
double dot(const Vec3& a, const Vec3& b);
Vec3 cross(const Vec3& a, const Vec3& b);
double length(const Vec3& a);

/// Returns the force that a step may leave unbalanced, as a share of a body's weight. Newton's method ends at 10⁻⁴
/// (newton_tolerance) of the force after the guess loop, which for a body at rest is its weight. Sweeps must reach
/// 1/40.
double force_left(const Trajectory& run);

/// Returns the number of steps by which friction's normal force may lag. It is 1, because a solve uses the force of the
/// previous solve. With barriers it is 2, because their force is 0 at the start of a motion.
double lagged_steps(const Trajectory& run);

/// Returns the mass m_v of each vertex [kg], 0 on fixed bodies. A vertex has a third of the rest mass of each triangle
/// around it, a quarter of each tetrahedron and half of each segment (method.md §4.10, §8.4).
std::vector<double> masses(const Scene& scene);

/// Return the total mass of a body [kg]; its centre of mass and the velocity of that centre; Σ m v of everything that
/// moves [kg m/s].
double mass_of(const Scene& scene, std::size_t body);
Vec3 centre(const Scene& scene, std::size_t body, const LawState& state);
Vec3 centre_velocity(const Scene& scene, std::size_t body, const LawState& state);
Vec3 momentum(const Scene& scene, const LawState& state);
/// Returns Σ m x × v of everything that moves, about the origin [kg m²/s].
Vec3 angular_momentum(const Scene& scene, const LawState& state);
/// Returns Σ m v²/2 of everything that moves [J].
double kinetic_energy(const Scene& scene, const LawState& state);
/// Returns the largest coordinate of any state [m].
double largest_coordinate(const Trajectory& run);

/// Returns the largest error of positions in single precision after n steps of free flight [m]. With u = 2⁻²⁴ each step
/// rounds x by u |x|, and v = (x' − x)/h by 2 u |x|/h. Errors of v accumulate: n + 2 (1 + … + n) roundings, in the
/// worst case all of one sign.
double flight_rounding(std::int64_t n, double largest_coordinate);

/// Returns the velocity v' of a body that slides with velocity v against friction (method.md §4.4), after one step of
/// implicit Euler: v' = v + h (drive − brake f₁(|v'|/ε_v) sign v'). `drive` is the acceleration without friction,
/// `brake` the largest deceleration by friction [m/s²]. The right side falls as v' rises, so v' is unique.
double slid(double velocity, double drive, double brake, double friction_velocity, double time_step);

/// Height and velocity of a mass. `bounced` returns them after a step of implicit Euler from height x. A plane at
/// height 0 repels the mass below r with the force k_c (r − x); x must be at least r/2. x' minimises ‖x' − y‖²/(2h²) +
/// (k_c/m)/2 max(0, r − x')², where y = x + h v + h² a.
struct Height {
  double x = 0, v = 0;  ///< [m], [m/s]
};
Height bounced(const Height& from, double acceleration, double stiffness_over_mass, double radius, double time_step);

}  // namespace ogc::compare::law_measures
