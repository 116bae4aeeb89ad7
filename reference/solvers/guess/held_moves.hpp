// What contacts leave of the moves of a guess loop, round after round (method.md §5.2, What contacts leave of a move):
// in double for whole runs, and for the judge with the accepted error of an answer in single precision.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "compare/stages/contact_force.hpp"
#include "compare/stages/step.hpp"
#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// A contact, seen from one of its vertices.
struct Hold {
  double weight = 0;        ///< of the vertex, not 0
  Triple<double> normal{};  ///< n
  Triple<double> others{};  ///< o = Σ w_u m_u over the other vertices [m]
  double friction = 0;      ///< μ
  /// Returns q [m]; it is not positive where the contact takes nothing.
  double taken(const Triple<double>& move) const;
  /// Returns s/w, the slip of the vertex on its partner [m].
  Triple<double> slide(const Triple<double>& move) const;
};
/// Returns what the contact leaves of a move [m].
Triple<double> held_by(const Hold& contact, const Triple<double>& move);

/// A contact that may hold vertices: its vertices and its friction.
struct GuessContact {
  compare::ContactSides sides = compare::ContactSides::point_point;
  std::array<compare::Index, 4> vertex{-1, -1, -1, -1};  ///< in the order of the stage contact_force
  double friction = 0;                                   ///< μ
};

/// The guess loop of one step, as far as contacts hold it.
class HeldMoves {
 public:
  /// `groups`: by vertex; −1 for free vertices, which contacts hold; above 0 for prescribed ones, which stay or go. r
  /// [m].
  HeldMoves(std::vector<compare::Index> groups, double contact_radius)
      : groups_(std::move(groups)),
        radius_(contact_radius),
        stays_(groups_.size(), false),
        taken_(groups_.size()),
        taken_error_(groups_.size(), 0) {}

  /// Does a round about `previous`, with the contacts found there. Returns where each vertex goes if nothing truncates
  /// it [m]: its target to the bit where no contact takes anything, `previous` where a prescribed vertex stays.
  std::vector<Triple<double>> round(std::span<const GuessContact> contacts, const std::vector<Triple<double>>& previous,
                                    const std::vector<Triple<double>>& target);
  /// Does the same round in the form that the judge compares with.
  std::vector<compare::HeldMove> judged_round(std::span<const GuessContact> contacts,
                                              const std::vector<compare::Vec3f>& previous,
                                              const std::vector<compare::Vec3f>& target);
  /// Returns for each vertex whether it is prescribed and a contact kept it in place in the last `round`.
  const std::vector<bool>& stays() const { return stays_; }

 private:
  bool is_free(compare::Index v) const { return groups_[static_cast<std::size_t>(v)] == -1; }
  bool is_prescribed(compare::Index v) const { return groups_[static_cast<std::size_t>(v)] > 0; }

  std::vector<compare::Index> groups_;
  double radius_;
  bool is_first_ = true;               ///< no round has taken place
  std::vector<bool> stays_;            ///< the result of stays()
  std::vector<Triple<double>> taken_;  ///< t by vertex [m]
  std::vector<double> taken_error_;    ///< how far another implementation's t may be from it [m]
};

}  // namespace ogc::reference
