// Where cases come from. Each stage has a table of generators; a case is a pure function of (stage, generator, seed,
// index). At least half of all cases lie close to a decision boundary (lattice, ladder.*).
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "compare/judge/cases/cases.hpp"
#include "compare/judge/cases/random.hpp"

namespace ogc::compare {

class States;

/// One row of a stage's table.
struct Generator {
  std::string_view name;  ///< "uniform", "ladder.parallel"
  double share;           ///< of a stage's cases, relative to the other rows
  bool generic;           ///< no degeneracy is sought: the share of grey decisions must stay below grey_share_limit
  CaseData (*make)(Random&);
  /// runs of fewer cases than this leave the row out, as one of its meshes would be too large a share
  std::uint64_t least = 0;
  /// A stage that the contestant must have, too: `tetrahedron` for cases about solids, `plane` for half-spaces,
  /// `volume_depth` for volumes
  std::optional<Stage> also_needs = std::nullopt;
  bool has_cavities = false;  ///< volumes with cavities, which only a contestant that knows them is asked about
  bool divides = false;       ///< gaps that are divided by approach, likewise
};

/// The generators of a stage, without those that take real states: `states` as they are, `mutated`
/// (compare/judge/cases/mutate.hpp).
std::span<const Generator> generators(Stage stage);

/// The row of a generator, `states` and `mutated` included. Throws InputError that lists the known names.
const Generator& find_generator(Stage stage, std::string_view name);

/// Makes a case. `states` is needed (and throws InputError where it is null) for the generators `states` and `mutated`
/// alone.
TestCase generate(const CaseName& name, const States* states = nullptr);
/// The same where the row of `name.generator` is at hand.
TestCase generate(const Generator& generator, CaseName name, const States* states = nullptr);

/// Largest share of grey decisions in the generic generators (compare/README.md, "The verdict").
inline constexpr double grey_share_limit = 1e-5;

/// Tables of the stages whose generators fill files of their own, compare/judge/cases/generate_*.cpp; those of the
/// others stand in compare/judge/stages.
std::span<const Generator> rest_state_generators();
std::span<const Generator> block_generators();
std::span<const Generator> detect_generators();
std::span<const Generator> bound_generators();
std::span<const Generator> plane_generators();
std::span<const Generator> truncate_generators();
std::span<const Generator> contact_force_generators();
std::span<const Generator> friction_force_generators();
std::span<const Generator> membrane_generators();
std::span<const Generator> bending_generators();
std::span<const Generator> sweep_generators();
std::span<const Generator> step_generators();

// Rods in cases of the sweep (compare/judge/cases/rods/).

/// The case with a rod near one of its vertices: a chain, a ring or branches, with some of its vertices held now and
/// then, frames about its segments and neighbours.
SweepCase with_rod(Random& random, SweepCase test);

/// One or two rods and nothing else, near each other.
SweepCase rods_alone(Random& random);

}  // namespace ogc::compare
