// steps.csv: one row a step, one column a quantity, the unit behind its name. One table serves writing and reading, so
// they can't disagree.
#pragma once

#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "compare/contestant.hpp"

namespace ogc::compare {

/// One column: "name [unit]" in the header.
struct StepColumn {
  std::string_view name, unit;  ///< of the heading: "wall_ms", "ms"
  /// the quantity
  std::variant<double StepMetrics::*, std::int64_t StepMetrics::*, std::uint32_t StepMetrics::*> field;
  std::string_view former_name{};  ///< in run format 1, where it is another one; read, never written
};

/// All columns but those of groups and stages, in the order of the file.
std::span<const StepColumn> step_columns();

/// Which groups of columns stand behind those, in this order: of scenes with solids `inverted_tetrahedra`; of scenes
/// with volumes `volume_contacts`, `vertices_inside`, `deepest`; of those with volumes of tetrahedra, which lie in
/// sheets, `depth_unresolved`; of scenes with rods `smallest_contact_distance`, `mean_stretch`, `largest_stretch`; of
/// runs that were asked `meetings`; `last_motion`, `left_residual`, `left_rounding`, `left_held`, which a file may
/// lack; of runs with a ledger its columns.
struct StepGroups {
  bool solids = false, volumes = false, sheets = false, rods = false, meetings = false, convergence = false,
       ledger = false;
  friend bool operator==(const StepGroups&, const StepGroups&) = default;
};

/// The header line; stages become "stage_NAME [ms]".
std::string step_header(std::span<const std::string> stage_names, const StepGroups& groups = {});

/// One line a row; numbers read back as the same double, "nan" where a quantity was not asked for. Rows without times
/// by stage get "nan" in each stage's column, rows without a ledger in each of its. Throws std::invalid_argument where
/// a row has times for another number of stages.
std::string step_lines(std::span<const StepMetrics> rows, std::size_t stage_count, const StepGroups& groups = {});

/// What steps.csv holds so far.
struct StepTable {
  std::vector<std::string> stage_names;  ///< columns of `--profile`
  std::vector<StepMetrics> rows{};       ///< in the order of the steps
  StepGroups groups{};                   ///< which columns there are
};

/// Reads steps.csv of a run up to the row of step `last`. A last line without its end (the run was killed) is left out.
/// Throws InputError that names the file and the line.
StepTable read_steps(const std::filesystem::path& folder, std::int64_t last = std::numeric_limits<std::int64_t>::max());

}  // namespace ogc::compare
