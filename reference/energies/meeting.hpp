// Computes the contact points of one contact and what follows from them, in Input numbers, for contact_force and
// friction_force. The features with the closest points are decided exactly. The positions of the contact points on
// these features come from a formula, so that the condition of an answer includes the sensitivity of the weights.
//
// The outer differentiation treats the weights as constants (method.md §4.2). The force is the same, because the
// closest points minimise the distance.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "compare/stages/contact_force.hpp"
#include "reference/energies/contact_activation.hpp"
#include "reference/energies/inputs.hpp"

namespace ogc::reference {

/// One accepted position of the contact points, with everything that follows from it. Coordinates are relative to end 0
/// of the first edge, or to the second side's first vertex if the first side is a point.
struct Meeting {
  Inputs inputs;
  std::array<Triple<Input>, 4> vertex;  ///< x [m]
  std::array<Input, 4> weight;          ///< weights that add up to 1 on the first side, to −1 on the second
  Input contact_radius, stiffness;      ///< r; k_c e_k
  /// the activation g
  compare::ContactActivation activation = compare::ContactActivation::ogc;
  bool across = false;  ///< whether g' is taken from the other side of its jump at τ; only if d is within rounding of τ
  Input distance;       ///< d, without derivatives if it is 0
  double doubt = 0;     ///< error of the vector between the contact points [m]
  double distance_doubt = 0;  ///< error of d, to first order [m]
  /// whether the derivatives may underestimate the error in the position of the contact points
  /// (compare/stages/contact_force.hpp)
  bool needle = false;

  /// Returns |w| Σ |w_u|. w is the own vertex's weight; the sum is over the own vertex and the vertices that are
  /// updated with it.
  Input majorant(const compare::ContactForceCase& question) const;
  /// Returns Σ w_i x_i, the vector from the second side's contact point to the first side's. Its length is d.
  Triple<Input> separation() const;
  /// Returns the distance at which slope and curvature are evaluated: d clamped to 2⁻²³ r … r, with the derivatives of
  /// d. If d is certainly beyond r, the result has no derivatives, so that nothing depends on the distance of sides
  /// that are far apart.
  template <class T>
  T acting_distance(T d) const {
    if (is_beyond()) return T(contact_radius);
    const double least = 0x1p-23 * contact_radius.value, tau = 0.5 * contact_radius.value;
    if (plain(d) < least) set_plain(d, least);
    if (plain(d) > contact_radius.value) set_plain(d, contact_radius.value);
    if (across) set_plain(d, plain(d) < tau ? tau : std::nextafter(tau, 0.0));
    return d;
  }
  /// Returns g at the acting distance, over any number type.
  template <class T>
  T energy(const T& acting) const {
    return activation_energy(activation, acting, T(contact_radius), T(stiffness));
  }
  /// Returns whether g' may jump at d, within rounding.
  bool may_jump() const {
    return form_of(activation).jumps && std::abs(distance.value - 0.5 * contact_radius.value) <= distance_doubt;
  }
  /// Returns an error of −g' [N] that first-order errors do not include. The error is 0 unless g' and g'' are 0 at r
  /// and d is within rounding of r. Then it is −g' at the distance r minus three errors of d.
  double slope_doubt() const;
  /// Returns whether the contact has a force: 0 < d < r. For d ≥ r it has only a block.
  bool acts() const { return distance.value > 0 && distance.value < contact_radius.value; }
  /// Returns whether rounding of d may change the decision d < r.
  bool may_end() const { return std::abs(distance.value - contact_radius.value) <= distance_doubt; }
  /// Returns whether d is certainly at least r.
  bool is_beyond() const { return distance.value >= contact_radius.value && !may_end(); }
  /// Returns whether the contact points may coincide within rounding; neither d nor n is known then.
  bool may_touch() const { return distance.value <= 2 * doubt; }

 private:
  static void set_plain(Input& x, double value) { x.value = value; }
  static void set_plain(ByVertex& x, double value) { x.value.value = value; }
};

/// Returns the Meeting with the exact contact points first. One Meeting for each other outcome of a grey decision
/// follows.
std::vector<Meeting> meetings(const compare::ContactForceCase& question);

/// Returns whether a decision of the contact lies within near_factor of its boundary. The decisions are the features of
/// the closest points, whether d < r, and whether d < τ if the activation has two branches.
bool is_near_decision(const compare::ContactForceCase& question, const Meeting& exact);

/// Selects the distances at which a stage's answer is 0.
enum class Ends {
  at_radius,  ///< for d ≥ r
  nowhere     ///< only for d = 0, where the normal is undefined
};

/// Returns a stage's accepted answers for all `meetings` (accepted positions of the contact points) of a contact.
/// `acting` returns the answer of a Meeting with a force. `largest` takes a distance d [m] and returns upper limits of
/// force and block at all distances from d on, as scales. It is used for needles, and if the contact points may
/// coincide.
std::vector<compare::ForceAnswer> answers(const std::vector<Meeting>& meetings, Ends end,
                                          const std::function<compare::ForceAnswer(double)>& largest,
                                          const std::function<compare::ForceAnswer(const Meeting&)>& acting);

/// Upper limits of −g' [N] and g'' [N/m] at and beyond a distance; distances below 2⁻²³ r count as 2⁻²³ r.
struct LargestSlopes {
  double first = 0, second = 0;  ///< −g', g''
};
/// Returns upper limits of −g' and g'' that hold for all distances from `distance` [m] on.
LargestSlopes largest_slopes(const compare::ContactForceCase& question, double distance);
/// Returns an upper limit of Meeting::majorant, |w| Σ |w_u|. The moduli of all weights add up to 2.
inline double largest_majorant(const compare::ContactForceCase& question) { return question.together == 0 ? 1 : 2; }

/// Returns the error scale for which a stage with this tolerance accepts every error up to 1: 1/(2⁻²⁴ · tolerance),
/// plus 1 for one rounding.
inline double units_of_whole(double tolerance) { return 1 / (compare::unit_roundoff * tolerance) + 1; }

/// Returns an upper limit of the answer's norm: the norm of its value plus its error.
double reach(const Inputs& inputs, std::span<const Input> answer);

/// Adds the rounding errors of the weights to the scales, which contain only the errors of the inputs so far. Weights
/// are computed as in closest_face. So each weight, even a weight of 0, has an error of 2⁻²⁴ times the largest
/// condition of all weights. `force` and `curvature` are the largest force and curvature for w = 1. If n vertices u are
/// updated together, the block has the factor |w| Σ |w_u|, whose error has the terms
///
///  - the error of |w| times the sum,
///  - |w| times n errors of weights,
///  - the product of both errors.
void add_weight_error(const Meeting& meeting, const compare::ContactForceCase& question, double force, double curvature,
                      compare::ForceAnswer& answer);

}  // namespace ogc::reference
