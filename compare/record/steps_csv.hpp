// Writes and reads steps.csv: one row for each step, one column for each quantity, whose unit follows its name. Writing
// and reading use the same table, so they can't disagree.
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
  std::string_view name, unit;  ///< parts of the heading: "wall_ms", "ms"
  /// member of StepMetrics with the quantity
  std::variant<double StepMetrics::*, std::int64_t StepMetrics::*, std::uint32_t StepMetrics::*> field;
  std::string_view former_name{};  ///< different name in run format 1; accepted when reading, never written
};

/// Returns all columns except those of groups and stages, in the order of the file.
std::span<const StepColumn> step_columns();

/// Optional groups of columns, in this order:
///
/// - `solids`: `inverted_tetrahedra`
/// - `volumes`: `volume_contacts`, `vertices_inside`, `deepest`
/// - `sheets` (volumes of tetrahedra): `depth_unresolved`
/// - `rods`: `smallest_contact_distance`, `mean_stretch`, `largest_stretch`
/// - `meetings` (runs that count them): `meetings`
/// - `convergence`: `last_motion`, `left_residual`, `left_rounding`, `left_held`; a file may lack them
/// - `ledger`: all columns of StepLedger
struct StepGroups {
  bool solids = false, volumes = false, sheets = false, rods = false, meetings = false, convergence = false,
       ledger = false;
  friend bool operator==(const StepGroups&, const StepGroups&) = default;
};

/// Returns the header line; stages become "stage_NAME [ms]".
std::string step_header(std::span<const std::string> stage_names, const StepGroups& groups = {});

/// Returns one line for each row. Numbers read back as the same double. "nan" means that a quantity was not requested,
/// or that the row lacks times of stages or a ledger. Throws std::invalid_argument if a row has times for another
/// number of stages.
std::string step_lines(std::span<const StepMetrics> rows, std::size_t stage_count, const StepGroups& groups = {});

/// The contents of steps.csv so far.
struct StepTable {
  std::vector<std::string> stage_names;  ///< columns of `--profile`
  std::vector<StepMetrics> rows{};       ///< in the order of the steps
  StepGroups groups{};                   ///< groups of columns in the file
};

/// Reads steps.csv of a run up to the row of step `last`. Ignores a last line without line end (the run was killed).
/// Throws InputError that names the file and the line.
StepTable read_steps(const std::filesystem::path& folder, std::int64_t last = std::numeric_limits<std::int64_t>::max());

}  // namespace ogc::compare
