// Writes and reads steps.csv: one row for each step, one column for each quantity, with its unit after its name. One
// table serves writing and reading, so they can't disagree.
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
  /// the quantity
  std::variant<double StepMetrics::*, std::int64_t StepMetrics::*, std::uint32_t StepMetrics::*> field;
  std::string_view former_name{};  ///< name in run format 1 if it differs; read, never written
};

/// Returns all columns except those of groups and stages, in the order of the file.
std::span<const StepColumn> step_columns();

/// Optional groups of columns, in this order: with solids `inverted_tetrahedra`; with volumes `volume_contacts`,
/// `vertices_inside`, `deepest`; with volumes of tetrahedra, which have sheets, `depth_unresolved`; with rods
/// `smallest_contact_distance`, `mean_stretch`, `largest_stretch`; with counted meetings `meetings`; `last_motion`,
/// `left_residual`, `left_rounding`, `left_held`, which a file may lack; with a ledger its columns.
struct StepGroups {
  bool solids = false, volumes = false, sheets = false, rods = false, meetings = false, convergence = false,
       ledger = false;
  friend bool operator==(const StepGroups&, const StepGroups&) = default;
};

/// Returns the header line; stages become "stage_NAME [ms]".
std::string step_header(std::span<const std::string> stage_names, const StepGroups& groups = {});

/// Returns one line for each row; numbers read back as the same double, "nan" if a quantity was not requested. Rows
/// without times by stage get "nan" in each stage's column, rows without a ledger in each of its columns. Throws
/// std::invalid_argument if a row has times for another number of stages.
std::string step_lines(std::span<const StepMetrics> rows, std::size_t stage_count, const StepGroups& groups = {});

/// The contents of steps.csv so far.
struct StepTable {
  std::vector<std::string> stage_names;  ///< columns of `--profile`
  std::vector<StepMetrics> rows{};       ///< in the order of the steps
  StepGroups groups{};                   ///< groups of columns in the file
};

/// Reads steps.csv of a run up to the row of step `last`. A last line without its end (the run was killed) is ignored.
/// Throws InputError that names the file and the line.
StepTable read_steps(const std::filesystem::path& folder, std::int64_t last = std::numeric_limits<std::int64_t>::max());

}  // namespace ogc::compare
