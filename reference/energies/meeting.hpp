// How the two sides of a contact meet, in Input numbers: the common part of contact_force and friction_force. Which
// features hold the closest points is decided exactly; where the points lie on these features is a formula, so that the
// condition of an answer includes the sensitivity of the weights.
//
// Weights are constants of the outer differentiation (method.md §4.2): at the closest points the distance is stationary
// in them, so that the force is the same.
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

/// One acceptable way of meeting. Coordinates are relative to end 0 of the first edge or, where the first side is a
/// point, to the second side's first vertex.
struct Meeting {
  Inputs inputs;                        ///< the inputs to which conditions refer
  std::array<Triple<Input>, 4> vertex;  ///< x [m]
  std::array<Input, 4> weight;          ///< those of the first side add up to 1, those of the second to −1
  Input contact_radius, stiffness;      ///< r; k_c e_k
  /// The activation g.
  compare::ContactActivation activation = compare::ContactActivation::ogc;
  bool across = false;        ///< evaluated on the other side of the jump of g' at τ, from which d can't be told
  Input distance;             ///< d, without derivatives where it is 0
  double doubt = 0;           ///< error of the vector between the contact points [m]
  double distance_doubt = 0;  ///< error of d, to first order [m]
  /// Whether the first order may fail for the place of the contact points (compare/stages/contact_force.hpp).
  bool needle = false;

  /// Returns |w| Σ |w_u| over the own vertex and those that are updated together with it.
  Input majorant(const compare::ContactForceCase& question) const;
  /// Returns Σ w_i x_i, the vector d n from the second side's contact point to the first's.
  Triple<Input> separation() const;
  /// Returns the distance at which slope and curvature are taken: d, but within 2⁻²³ r … r. It keeps d's derivatives on
  /// both sides of these limits, but has none where d is surely beyond r, so that nothing depends on how far.
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
  /// Returns whether g' jumps where d is.
  bool may_jump() const {
    return form_of(activation).jumps && std::abs(distance.value - 0.5 * contact_radius.value) <= distance_doubt;
  }
  /// Returns the error of −g' that the first order lacks [N]: for activations whose g' has no slope at r, the size of
  /// −g' within the doubt about r.
  double slope_doubt() const;
  /// Returns whether the contact has a force: 0 < d < r. Beyond r it has only a block.
  bool acts() const { return distance.value > 0 && distance.value < contact_radius.value; }
  /// Returns whether d can't be told from r.
  bool may_end() const { return std::abs(distance.value - contact_radius.value) <= distance_doubt; }
  /// Returns whether d is surely r or more.
  bool is_beyond() const { return distance.value >= contact_radius.value && !may_end(); }
  /// Returns whether the contact points can't be told from touching ones: then neither d nor n is known.
  bool may_touch() const { return distance.value <= 2 * doubt; }

 private:
  static void set_plain(Input& x, double value) { x.value = value; }
  static void set_plain(ByVertex& x, double value) { x.value.value = value; }
};

/// Returns the exact meeting first, then those that a decision in its grey zone could give instead.
std::vector<Meeting> meetings(const compare::ContactForceCase& question);

/// Returns whether a decision of the contact lies within near_factor: the features of its closest points, d = r, and d
/// = τ of an activation with two stages.
bool is_near_decision(const compare::ContactForceCase& question, const Meeting& exact);

/// Where a stage's answer becomes 0.
enum class Ends {
  at_radius,  ///< from d = r on
  nowhere     ///< only at d = 0, where there is no normal
};

/// Returns the accepted answers of a stage over the meetings of a contact. `acting` returns the answer of a meeting
/// that acts. `largest` returns, in the scales, moduli that force and block can't exceed at this distance [m] or a
/// larger one; it serves for points that can't be told from touching ones, and for needles.
std::vector<compare::ForceAnswer> answers(const std::vector<Meeting>& meetings, Ends end,
                                          const std::function<compare::ForceAnswer(double)>& largest,
                                          const std::function<compare::ForceAnswer(const Meeting&)>& acting);

/// The largest −g' and g'' from a distance on [N], [N/m]; 2⁻²³ r stands for all smaller distances.
struct LargestSlopes {
  double first = 0, second = 0;  ///< −g', g''
};
/// Returns them for all distances from `distance` on [m].
LargestSlopes largest_slopes(const compare::ContactForceCase& question, double distance);
/// Returns a bound of |w| Σ |w_u|: moduli of all weights add up to 2.
inline double largest_majorant(const compare::ContactForceCase& question) { return question.together == 0 ? 1 : 2; }

/// Returns the scale of a number that may be wrong as a whole and is rounded, too.
inline double units_of_whole(double tolerance) { return 1 / (compare::unit_roundoff * tolerance) + 1; }

/// Returns the largest modulus that an answer of several numbers may have within its error.
double reach(const Inputs& inputs, std::span<const Input> answer);

/// Adds to the scales the effect of the own weight's error beyond that of its inputs. Weights are computed one by one,
/// as in closest_face, so each can be off by u times the largest condition of all, even a weight of 0, where the first
/// order of the block's w² vanishes. `force` and `curvature` are the largest ones for w = 1. With n vertices updated
/// together the block has |w| Σ |w_u|; its error is the error of |w| times the sum, plus that of the sum, n errors,
/// times |w|.
void add_weight_error(const Meeting& meeting, const compare::ContactForceCase& question, double force, double curvature,
                      compare::ForceAnswer& answer);

}  // namespace ogc::reference
