// How the two sides of a contact meet, as numbers that know their inputs: what contact_force and friction_force share.
// Which features hold the closest points is decided exactly; where they lie on these features is a formula, so that the
// condition of an answer holds the sensitivity of the weights.
//
// Weights are constants of the outer differentiation (method.md §4.2): the distance is stationary in them where they
// are those of the closest points, so that the force is the same.
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

/// One acceptable way of meeting. Coordinates are relative to the first edge's end 0, the second side's first vertex
/// where the first side is a point.
struct Meeting {
  Inputs inputs;                        ///< what scales are relative to
  std::array<Triple<Input>, 4> vertex;  ///< x [m]
  std::array<Input, 4> weight;          ///< those of the first side add up to 1, those of the second to −1
  Input contact_radius, stiffness;      ///< r; k_c e_k
  /// g
  compare::ContactActivation activation = compare::ContactActivation::ogc;
  bool across = false;        ///< asked for the other side of the jump of g' at τ, which d cannot be told from
  Input distance;             ///< d, without derivatives where it is 0
  double doubt = 0;           ///< how far the vector between the contact points can be off [m]
  double distance_doubt = 0;  ///< how far d can be off, to first order [m]
  /// the first order may not hold for the place of the contact points (compare/stages/contact_force.hpp)
  bool needle = false;

  /// |w| Σ |w_u| over the vertex asked about and those that are updated together with it.
  Input majorant(const compare::ContactForceCase& question) const;
  /// Σ w_i x_i, the vector d n from the second side's contact point to the first's.
  Triple<Input> separation() const;
  /// The distance that slope and curvature belong to: d, but within 2⁻²³ r … r. It keeps d's derivatives on both sides
  /// of these corners, and has none where d is surely beyond r, so that nothing depends on how far.
  template <class T>
  T acting_distance(T d) const {
    if (is_beyond()) return T(contact_radius);
    const double least = 0x1p-23 * contact_radius.value, tau = 0.5 * contact_radius.value;
    if (plain(d) < least) set_plain(d, least);
    if (plain(d) > contact_radius.value) set_plain(d, contact_radius.value);
    if (across) set_plain(d, plain(d) < tau ? tau : std::nextafter(tau, 0.0));
    return d;
  }
  /// g at the acting distance, over any number type.
  template <class T>
  T energy(const T& acting) const {
    return activation_energy(activation, acting, T(contact_radius), T(stiffness));
  }
  /// Whether g' jumps where d is.
  bool may_jump() const {
    return form_of(activation).jumps && std::abs(distance.value - 0.5 * contact_radius.value) <= distance_doubt;
  }
  /// What first order does not say of −g': of activations whose g' has no slope at r, how large it is within the doubt
  /// about r [N].
  double slope_doubt() const;
  /// Whether the contact has a force: 0 < d < r. Beyond r it has a block alone.
  bool acts() const { return distance.value > 0 && distance.value < contact_radius.value; }
  /// Whether d cannot be told from r.
  bool may_end() const { return std::abs(distance.value - contact_radius.value) <= distance_doubt; }
  /// Whether d is r or more, and can be told from less.
  bool is_beyond() const { return distance.value >= contact_radius.value && !may_end(); }
  /// Whether the contact points cannot be told from touching ones: neither d nor n is known.
  bool may_touch() const { return distance.value <= 2 * doubt; }

 private:
  static void set_plain(Input& x, double value) { x.value = value; }
  static void set_plain(ByVertex& x, double value) { x.value.value = value; }
};

/// The exact meeting first, then those that a decision in its grey zone could give instead.
std::vector<Meeting> meetings(const compare::ContactForceCase& question);

/// Whether a decision of the contact lies within near_factor: the features of its closest points, d = r, and d = τ of
/// an activation with two stages.
bool is_near_decision(const compare::ContactForceCase& question, const Meeting& exact);

/// Where a stage's answer becomes 0.
enum class Ends {
  at_radius,  ///< from d = r on
  nowhere     ///< only at d = 0, where there is no normal
};

/// Accepted answers of a stage over the meetings of a contact. `acting` answers for one that acts; `largest`: a force
/// and a block, by their moduli in the scales, that no answer can exceed at this distance [m] or a larger one: where
/// points cannot be told from touching ones, and of needles.
std::vector<compare::ForceAnswer> answers(const std::vector<Meeting>& meetings, Ends end,
                                          const std::function<compare::ForceAnswer(double)>& largest,
                                          const std::function<compare::ForceAnswer(const Meeting&)>& acting);

/// The largest −g' and g'' from this distance on [N], [N/m]; 2⁻²³ r stands for all that are nearer.
struct LargestSlopes {
  double first = 0, second = 0;  ///< −g', g''
};
/// At any distance from `distance` on [m].
LargestSlopes largest_slopes(const compare::ContactForceCase& question, double distance);
/// |w| Σ |w_u| is no larger: moduli of all weights add up to 2.
inline double largest_majorant(const compare::ContactForceCase& question) { return question.together == 0 ? 1 : 2; }

/// The scale of a number's error where all of it may be wrong, and rounded as others are.
inline double units_of_whole(double tolerance) { return 1 / (compare::unit_roundoff * tolerance) + 1; }

/// The largest modulus that an answer of several numbers can be taken for.
double reach(const Inputs& inputs, std::span<const Input> answer);

/// Adds to the scales what the error of the own weight does beside those of its inputs: where weights are computed one
/// by one, as in closest_face, each can be off by u times the largest condition of them all, even one that is 0, where
/// the first order of the block's w² vanishes. `force` and `curvature` are the largest ones of w = 1. With n vertices
/// updated together the block has |w| Σ |w_u|, which is off by the error of the one times the other, and of the other,
/// n errors, times the one.
void add_weight_error(const Meeting& meeting, const compare::ContactForceCase& question, double force, double curvature,
                      compare::ForceAnswer& answer);

}  // namespace ogc::reference
