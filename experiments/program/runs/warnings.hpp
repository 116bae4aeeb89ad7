// Warns of input that is valid but hardly intended, for example millimetres in place of metres, or a step in which
// bounds stop every motion. A run prints each kind of warning once, with a number and a remedy.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "experiments/program/runs/solvers.hpp"

namespace ogc::experiments {

/// Largest plausible diagonal of a scene's bounding box [m]; a house is smaller. A longer diagonal suggests another
/// unit than metres.
inline constexpr double largest_diagonal = 20;
/// Largest r that causes no warning, in median edge lengths of a body. With a larger r, vertices are in contact with
/// mesh neighbours that are several rings away.
inline constexpr double most_edges_a_radius = 2;
/// Largest distance between the first keyframe and its body at the start that causes no warning, in multiples of r. The
/// body covers this distance in the first step, and so short a motion can't pass through a contact. The rounding of
/// files causes far smaller distances.
inline constexpr double most_radii_from_keys = 0.01;
/// Largest share of a step's motion that truncation may take without a warning (MomentumShare).
inline constexpr double most_momentum_lost = 0.5;

/// If bounds cut every free vertex in this many consecutive steps, the run warns.
inline constexpr std::int64_t most_held_steps = 10;

/// Largest residual of the median step that causes no warning. The residual is the share of the force that is left on
/// free vertices (Eq. 29).
inline constexpr double most_force_left = 0.1;

/// Collects the residuals (Eq. 29) that the steps of a run leave. A step counts only if rounded positions can cause a
/// residual of at most most_force_left. In other steps there was hardly any force, as in free fall.
class ForcesLeft {
 public:
  /// Adds the residual and the number of held vertices of a step, if the step counts.
  void look_at(const compare::StepMetrics& row);
  /// Returns the number of steps that count.
  std::size_t steps() const { return residuals_.size(); }
  /// Returns the residual (Eq. 29) of the median step; not-a-number if no step counts.
  double median_residual() const;
  /// Returns the number of free vertices that a bound holds in the median step; not-a-number if no step counts.
  double median_held() const;

 private:
  std::vector<double> residuals_, held_;
};

/// Collects the warnings of a run, each kind at most once.
class Warnings {
 public:
  /// Checks the scene's start; the scene must be rounded and valid. Warns of bounds=off, of a large bounding box, of an
  /// r that is large for the edges of a body or the thickness of a solid, and of curved rest shapes with isometric
  /// bending. Also warns if IPC's tolerance allows a larger speed at the end of a step than gravity adds per step, and
  /// of first keyframes that differ from their body's start.
  explicit Warnings(const compare::Scene& scene, Solver solver = Solver::vbd);
  /// Checks a step for three kinds of warning: the guess loop did all its rounds and lost much of the motion,
  /// prescribed vertices lag, or bounds held all vertices in most_held_steps steps in a row. `momentum_lost`:
  /// MomentumShare::lost; empty if it is not known. Returns each kind of warning only once, for its first step; `list`
  /// names the worst step.
  std::vector<std::string> look_at(const compare::StepMetrics& row, std::optional<double> momentum_lost);
  /// Returns the forces that the steps left so far.
  const ForcesLeft& forces_left() const { return forces_left_; }
  /// Returns the warnings about all steps together, for the end of the run.
  std::vector<std::string> look_back() const;
  /// Returns all warnings so far, one text for each kind: what, where, how much, and the remedy.
  std::vector<std::string> list() const;

 private:
  /// Holds the worst step of one kind of warning.
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
  double settled_move_ = 0;
  std::int64_t free_ = 0;  ///< number of vertices that only forces move
  /// number of consecutive steps up to now that ended with all free vertices cut, and the largest such number
  std::int64_t held_ = 0, longest_held_ = 0;
  std::optional<Worst> momentum_, lag_;
  ForcesLeft forces_left_;
};

}  // namespace ogc::experiments
