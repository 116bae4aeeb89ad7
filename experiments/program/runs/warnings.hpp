// What is legal and can hardly be meant. Each kind is said once a run, with its number and what to do: by whoever has
// metres for millimetres, or a step in which nothing can move as it wants to.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "experiments/program/runs/solvers.hpp"

namespace ogc::experiments {

/// Box of a scene [m] above which its lengths are hardly metres: a house is smaller than its diagonal.
inline constexpr double largest_diagonal = 20;
/// Median edges of a body that r may reach: beyond them a vertex is in contact with what it is sewn to, several rings
/// of neighbours away.
inline constexpr double most_edges_a_radius = 2;
/// Contact radii that keyframes may begin away from their body: less is no motion that contact could miss, and far
/// above the roundings of files.
inline constexpr double most_radii_from_keys = 0.01;
/// Share of what a step is to move that truncation may take (MomentumShare).
inline constexpr double most_momentum_lost = 0.5;

/// So many steps in a row that end with every free vertex cut by its bound are no accident.
inline constexpr std::int64_t most_held_steps = 10;

/// A run warns where its median step leaves free vertices with this share of their force (Eq. 29).
inline constexpr double most_force_left = 0.1;

/// Collects the forces that the steps of a run leave. A step does not count where rounding may make more than
/// most_force_left of Eq. 29: there was no force to speak of, as in free fall.
class ForcesLeft {
 public:
  /// Takes a step's row, if it has them.
  void look_at(const compare::StepMetrics& row);
  /// Steps that count.
  std::size_t steps() const { return residuals_.size(); }
  /// The residual of Eq. 29 that the median step leaves; not-a-number where no step counts.
  double median_residual() const;
  /// How many free vertices a bound holds in the median step; not-a-number where no step counts.
  double median_held() const;

 private:
  std::vector<double> residuals_, held_;
};

/// What is said of a run at most once.
class Warnings {
 public:
  /// Looks at the scene, which must be rounded and valid, as it starts: its box, r against the edges of each body with
  /// triangles, and against the thickness of each solid at rest, rest shapes that isometric bending does not know, of
  /// IPC the speed at which a step ends against what gravity changes in one, and keyframes that begin away from their
  /// body.
  explicit Warnings(const compare::Scene& scene, Solver solver = Solver::vbd);
  /// Looks at a step: what the guess loop lost though it did all its rounds (MomentumShare; empty: not known), the
  /// lag of prescribed vertices, and whether bounds end most_held_steps in a row. Returns what the first step of its
  /// kind gives reason to say; the list keeps the worst.
  std::vector<std::string> look_at(const compare::StepMetrics& row, std::optional<double> momentum_lost);
  /// What the steps so far left.
  const ForcesLeft& forces_left() const { return forces_left_; }
  /// What is said at the end, of the steps as a whole.
  std::vector<std::string> look_back() const;
  /// All that there is to say so far, one text a kind: what, where, how much, what to do.
  std::vector<std::string> list() const;

 private:
  /// The worst step of a kind.
  struct Worst {
    std::int64_t step = 0;
    double value = 0;
  };
  std::string momentum_text() const;
  std::string lag_text() const;
  std::string held_text() const;
  std::string force_text() const;
  std::vector<std::string> of_scene_;
  double radius_ = 0;
  std::int64_t guess_rounds_ = 0, iterations_ = 0;
  std::int64_t free_ = 0;                     ///< vertices that nothing but forces moves
  std::int64_t held_ = 0, longest_held_ = 0;  ///< steps in a row that end with all of them cut
  std::optional<Worst> momentum_, lag_;
  ForcesLeft forces_left_;
};

}  // namespace ogc::experiments
