// Declares the generators of cases. Each stage has a table of them; a case is a pure function of (stage, generator,
// seed, index). At least half of all cases lie close to a decision boundary (lattice, ladder.*).
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
  double share;           ///< share of a stage's cases, relative to the other rows
  bool generic;           ///< seeks no degeneracy: the share of grey decisions must stay below grey_share_limit
  CaseData (*make)(Random&);
  /// runs of fewer cases than this leave the row out, as one of its meshes would be too large a share
  std::uint64_t least = 0;
  /// a stage that the contestant must have, too: `tetrahedron` for cases about solids, `plane` for half-spaces,
  /// `volume_depth` for volumes
  std::optional<Stage> also_needs = std::nullopt;
  bool has_cavities = false;  ///< makes volumes with cavities; only a contestant that knows them is asked
  bool divides = false;       ///< divides gaps by approach; only a contestant that knows this is asked
};

/// Returns the generators of a stage, without those that take real states: `states` takes them as they are, `mutated`
/// changes them (compare/judge/cases/mutate.hpp).
std::span<const Generator> generators(Stage stage);

/// Returns the row of a generator, also of `states` and `mutated`. Throws InputError that lists the known names.
const Generator& find_generator(Stage stage, std::string_view name);

/// Makes a case. Only the generators `states` and `mutated` need `states`; throws InputError where it is null for them.
TestCase generate(const CaseName& name, const States* states = nullptr);
/// Makes the same case where the row of `name.generator` is at hand.
TestCase generate(const Generator& generator, CaseName name, const States* states = nullptr);

/// Largest share of grey decisions in the generic generators (compare/README.md, "The verdict").
inline constexpr double grey_share_limit = 1e-5;

/// Tables of the stages whose generators fill files of their own, compare/judge/cases/generate_*.cpp; the tables of the
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

/// Adds a rod near one of the case's vertices (compare/judge/cases/rods/): a chain, a ring or branches, with some of
/// its vertices held in some cases, and frames about its segments and neighbours.
SweepCase with_rod(Random& random, SweepCase test);

/// Returns a case of one or two rods near each other, and nothing else.
SweepCase rods_alone(Random& random);

}  // namespace ogc::compare
