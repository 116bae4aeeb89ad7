// A law of motion: small scenes whose motion is known in closed form, the answer, and what may be missing from it. A
// law sees states and rows of steps alone, and never who made them; compare/laws.md lists the laws.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// The end of a step, or the start. Of a solver whose state is in double the doubles, otherwise floats, widened.
struct LawState {
  std::vector<Vec3> positions, velocities;  ///< by vertex [m], [m/s]
};

/// What a law must know of whoever moved its scene.
struct Answerer {
  bool is_solved = false;           ///< steps are solved to a tolerance, in double; otherwise `iterations` sweeps
  bool has_contact_energy = false;  ///< contacts are springs within r (method.md §4.2); otherwise barriers
};

/// One scene, moved.
struct Trajectory {
  Scene scene;                    ///< as it was asked, rounded to single precision
  Answerer by;                    ///< who moved it
  std::vector<LawState> states;   ///< the start, then the end of each step
  std::vector<StepMetrics> rows;  ///< rows[n − 1] is of the step that states[n] ends
};

/// How a number is held against the answer.
enum class Side {
  both,     ///< |measured − answer| ≤ tolerance
  at_most,  ///< measured ≤ answer + tolerance
};

/// One number, beside what the law says.
struct Reading {
  std::string what, unit;  ///< "way down the slope", "m"
  double measured = 0;     ///< from the trajectories; not-a-number is broken
  double answer = 0;       ///< in closed form
  double tolerance = 0;    ///< same unit; the law's file derives it
  Side side = Side::both;  ///< whether less is right, too
  /// Where a limit of the method is derived, how far it lets a reading be off; 0: there is none.
  double limit = 0;
  std::string why{};  ///< of the limit, and the setting that moves it
};

/// What became of a reading, or of a whole row.
enum class Verdict {
  holds,   ///< within the tolerance
  limit,   ///< beyond it, within the derived limit
  broken,  ///< beyond both
};

/// By tolerance and limit.
Verdict verdict(const Reading& reading);
/// The worst of them; holds where there is none.
Verdict verdict(std::span<const Reading> readings);
/// The reading that is farthest out, in units of its tolerance; null where there is none.
const Reading* worst(std::span<const Reading> readings);

/// How much is asked: the least that can show the law broken, for CI, or all of it.
enum class LawSize { least, whole };

/// A law by name.
struct Law {
  std::string_view name, group;  ///< "slope_slides", "slopes"
  std::string_view meaning;      ///< what it proves, a clause
  std::string_view answer;       ///< the closed answer, a line
  bool needs_springs = false;    ///< only who has contact energy is asked (Answerer); of others the row says so
  /// What is to be moved, one after the other; settings.steps says how far.
  std::vector<Scene> (*scenes)(LawSize size) = nullptr;
  /// Reads the trajectories of these scenes, in their order, each whole.
  std::vector<Reading> (*read)(std::span<const Trajectory> runs) = nullptr;
};

/// All laws, group by group.
std::span<const Law> laws();
/// The law of this name. Throws InputError that lists what there is.
const Law& find_law(std::string_view name);

}  // namespace ogc::compare
