// Defines laws of motion: small scenes whose motion is known in closed form, the answer, and its tolerance. A law reads
// only states and rows of steps, and does not know which solver ran. compare/laws.md lists the laws.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// State at the start or at the end of a step. A solver that stores doubles gives its doubles; otherwise its floats are
/// converted to double.
struct LawState {
  std::vector<Vec3> positions, velocities;  ///< by vertex [m], [m/s]
};

/// Properties of a solver that change the answers or tolerances of laws.
struct Answerer {
  bool is_solved = false;           ///< steps are solved to a tolerance, in double; otherwise `iterations` sweeps
  bool has_contact_energy = false;  ///< contacts are springs within r (method.md §4.2); otherwise they are barriers
};

/// The motion of one scene.
struct Trajectory {
  Scene scene;                    ///< the law's scene, rounded to single precision
  Answerer by;                    ///< properties of the solver that computed the motion
  std::vector<LawState> states;   ///< the start, then the end of each step
  std::vector<StepMetrics> rows;  ///< rows[n − 1] describes the step that ends in states[n]
};

/// How a number is compared with the answer.
enum class Side {
  both,     ///< |measured − answer| ≤ tolerance
  at_most,  ///< measured ≤ answer + tolerance
};

/// One number of a law, with its answer.
struct Reading {
  std::string what, unit;  ///< "way down the slope", "m"
  double measured = 0;     ///< from the trajectories; not-a-number breaks the law
  double answer = 0;       ///< in closed form
  double tolerance = 0;    ///< in the same unit; the law's file derives it
  Side side = Side::both;  ///< whether a reading below the answer is right as well
  /// Derived upper limit of the error that the method itself may cause; 0: no limit is derived.
  double limit = 0;
  std::string why{};  ///< reason of the limit, and the setting that changes it
};

/// Verdict about a reading, or about all readings of a law.
enum class Verdict {
  holds,   ///< within the tolerance
  limit,   ///< beyond the tolerance, within the derived limit
  broken,  ///< beyond the tolerance and the limit
};

/// Judges a reading by tolerance and limit.
Verdict verdict(const Reading& reading);
/// Returns the worst verdict; Verdict::holds if there are no readings.
Verdict verdict(std::span<const Reading> readings);
/// Returns the reading with the largest error in units of its tolerance; null if there are no readings.
const Reading* worst(std::span<const Reading> readings);

/// Selects what is run: only the scenes that are needed to show a broken law (for CI), or all scenes.
enum class LawSize { least, whole };

/// A law with its name, scenes and readings.
struct Law {
  std::string_view name, group;  ///< "slope_slides", "slopes"
  std::string_view meaning;      ///< a clause: what the law tests
  std::string_view answer;       ///< a line: the closed answer
  /// Whether the law needs a solver with contact energy (Answerer). Other solvers are not tested by the law, and the
  /// report states so.
  bool needs_springs = false;
  /// Returns the scenes to run; settings.steps gives the length.
  std::vector<Scene> (*scenes)(LawSize size) = nullptr;
  /// Returns the readings; runs[i] is the trajectory of the i-th scene.
  std::vector<Reading> (*read)(std::span<const Trajectory> runs) = nullptr;
};

/// Returns all laws, group by group.
std::span<const Law> laws();
/// Returns the law of this name. Throws InputError that lists all names.
const Law& find_law(std::string_view name);

}  // namespace ogc::compare
