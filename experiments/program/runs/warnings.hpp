// Warns of input that is legal but hardly intended, such as millimetres in place of metres, or a step in which bounds
// stop every motion. Each kind of warning appears once in a run, with its number and a remedy.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "experiments/program/runs/solvers.hpp"

namespace ogc::experiments {

/// Diagonal of a scene's box above which its lengths are hardly metres [m]; a house is smaller.
inline constexpr double largest_diagonal = 20;
/// Largest r in median edges of a body. Above it a vertex is in contact with neighbours in the mesh that are several
/// rings away.
inline constexpr double most_edges_a_radius = 2;
/// Distance in contact radii that keyframes may have from their body at the start. A smaller one is no motion that
/// contact could miss, and this is far above the rounding of files.
inline constexpr double most_radii_from_keys = 0.01;
/// Share of a step's motion that truncation may take (MomentumShare).
inline constexpr double most_momentum_lost = 0.5;

/// Number of consecutive steps that end with every free vertex cut by its bound, from which on it is no accident.
inline constexpr std::int64_t most_held_steps = 10;

/// Share of the force (Eq. 29) that the median step may leave on free vertices; above it a run warns.
inline constexpr double most_force_left = 0.1;

/// Collects the forces that the steps of a run leave. A step does not count if rounding may account for more than
/// most_force_left in Eq. 29: then there was hardly any force, as in free fall.
class ForcesLeft {
 public:
  /// Takes a step's row, if the row has these numbers.
  void look_at(const compare::StepMetrics& row);
  /// Returns the number of steps that count.
  std::size_t steps() const { return residuals_.size(); }
  /// Returns the residual of Eq. 29 in the median step; not-a-number if no step counts.
  double median_residual() const;
  /// Returns the number of free vertices that a bound holds in the median step; not-a-number if no step counts.
  double median_held() const;

 private:
  std::vector<double> residuals_, held_;
};

/// Collects the warnings of a run, each at most once.
class Warnings {
 public:
  /// Checks the scene at its start, which must be rounded and valid: bounds=off, its box, r against the edges of each
  /// body with triangles and against the thickness of each solid at rest, rest shapes that isometric bending does not
  /// support, for IPC the speed at which a step ends against the speed that gravity adds in one, and keyframes that
  /// begin away from their body.
  explicit Warnings(const compare::Scene& scene, Solver solver = Solver::vbd);
  /// Checks a step: the loss of a guess loop that did all its rounds (MomentumShare; empty: not known), the lag of
  /// prescribed vertices, and whether bounds end most_held_steps in a row. Returns a warning for the first step of each
  /// kind; the list keeps the worst step.
  std::vector<std::string> look_at(const compare::StepMetrics& row, std::optional<double> momentum_lost);
  /// Returns the forces that the steps so far left.
  const ForcesLeft& forces_left() const { return forces_left_; }
  /// Returns the warnings about the steps as a whole, for the end of the run.
  std::vector<std::string> look_back() const;
  /// Returns all warnings so far, one text for each kind: what, where, how much, what to do.
  std::vector<std::string> list() const;

 private:
  /// Holds the worst step of a kind.
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
  std::int64_t free_ = 0;                     ///< vertices that only forces move
  std::int64_t held_ = 0, longest_held_ = 0;  ///< consecutive steps that end with all of them cut
  std::optional<Worst> momentum_, lag_;
  ForcesLeft forces_left_;
};

}  // namespace ogc::experiments
