// Declares the generators of cases, one table for each stage. A case is a pure function of (stage, generator, seed,
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
  double share;           ///< weight of the row among a stage's cases
  bool generic;  ///< true if cases are random, not near a degeneracy: few decisions may be grey (grey_share_limit)
  CaseData (*make)(Random&);
  /// The row is used only in runs with at least this many cases. In a smaller run, one mesh of the row would have too
  /// large a share of the cases.
  std::uint64_t least = 0;
  /// Another stage that the contestant must have: `tetrahedron` for solids, `plane` for half-spaces, `volume_depth` for
  /// volumes, `orientation` for rods.
  std::optional<Stage> also_needs = std::nullopt;
  bool has_cavities = false;  ///< makes volumes with cavities, for contestants that support them
  bool divides = false;       ///< has displacements, for contestants whose planes divide gaps by them (dat)
};

/// Returns the generators of a stage, except the two that need real states: `states` and `mutated`
/// (compare/judge/cases/mutate.hpp).
std::span<const Generator> generators(Stage stage);

/// Returns the row of a generator, including `states` and `mutated`. Throws InputError that lists the known names.
const Generator& find_generator(Stage stage, std::string_view name);

/// Makes a case. Throws InputError if the generator is `states` or `mutated` and `states` is null.
TestCase generate(const CaseName& name, const States* states = nullptr);
/// Makes a case from `generator`, the row that `name.generator` names.
TestCase generate(const Generator& generator, CaseName name, const States* states = nullptr);

/// Largest share of grey decisions that generic generators may have (compare/README.md, "The verdict").
inline constexpr double grey_share_limit = 1e-5;

/// Return the tables that compare/judge/cases/generate_*.cpp define; compare/judge/stages defines all other tables.
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

/// Adds a rod near one of the case's vertices (compare/judge/cases/rods/): a chain, a ring or branches. In some cases
/// vertices of the rod are held.
SweepCase with_rod(Random& random, SweepCase test);

/// Returns a case that holds one rod, or two near each other, and nothing else.
SweepCase rods_alone(Random& random);

}  // namespace ogc::compare
