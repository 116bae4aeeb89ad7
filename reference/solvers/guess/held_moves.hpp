// Computes the part of each move that contacts leave in a round of the guess loop (method.md §5.2, What contacts leave
// of a move). Whole runs compute in double. For the judge, the accepted error of a single-precision answer is computed,
// too.
#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "compare/stages/contact_force.hpp"
#include "compare/stages/step.hpp"
#include "reference/energies/derivative.hpp"

namespace ogc::reference {

/// The data of a contact that determine what it leaves of one vertex's move.
struct Hold {
  double weight = 0;        ///< weight of the vertex, not 0
  Triple<double> normal{};  ///< n
  Triple<double> others{};  ///< o = Σ w_u m_u over the other vertices [m]
  double friction = 0;      ///< μ
  /// Returns q, the part of the move that the contact removes along its normal [m]; if it is not positive, the contact
  /// removes nothing.
  double taken(const Triple<double>& move) const;
  /// Returns s/w, the slip of the vertex relative to the other side [m].
  Triple<double> slide(const Triple<double>& move) const;
};
/// Returns what the contact leaves of the move [m].
Triple<double> held_by(const Hold& contact, const Triple<double>& move);

/// A contact that may stop vertices in the guess loop.
struct GuessContact {
  compare::ContactSides sides = compare::ContactSides::point_point;
  std::array<compare::Index, 4> vertex{-1, -1, -1, -1};  ///< in the order of the stage contact_force
  double friction = 0;                                   ///< μ
};

/// Applies contacts to the moves of one step's guess loop, round by round.
class HeldMoves {
 public:
  /// `groups` holds −1 for a free vertex (contacts reduce its move) and a positive number for a prescribed vertex (a
  /// contact may keep it in place). The contact radius is in metres.
  HeldMoves(std::vector<compare::Index> groups, double contact_radius)
      : groups_(std::move(groups)),
        radius_(contact_radius),
        stays_(groups_.size(), false),
        taken_(groups_.size()),
        taken_error_(groups_.size(), 0) {}

  /// Computes a round at the positions `previous` with the contacts found there. Returns the position of each vertex
  /// before truncation [m]. A free vertex whose move no contact reduces gets exactly its target. A prescribed vertex
  /// that a contact keeps in place gets its position in `previous`.
  std::vector<Triple<double>> round(std::span<const GuessContact> contacts, const std::vector<Triple<double>>& previous,
                                    const std::vector<Triple<double>>& target);
  /// Computes a round with accepted errors, for the judge.
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
  bool is_first_ = true;  ///< whether no round has taken place
  std::vector<bool> stays_;
  std::vector<Triple<double>> taken_;  ///< t of each vertex (what contacts removed in the previous round) [m]
  std::vector<double> taken_error_;    ///< accepted error of another implementation's t [m]
};

}  // namespace ogc::reference
