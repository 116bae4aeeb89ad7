#include "compare/record/steps_csv.hpp"

#include <array>
#include <charconv>
#include <limits>
#include <stdexcept>

#include "compare/files/bytes.hpp"
#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

constexpr std::array<StepColumn, 23> columns{{
    {"step", "1", &StepMetrics::step},
    {"wall", "ms", &StepMetrics::wall_ms},
    {"vertex_facet_contacts", "1", &StepMetrics::vertex_facet_contacts},
    {"edge_edge_contacts", "1", &StepMetrics::edge_edge_contacts},
    {"broad_phases", "1", &StepMetrics::broad_phases},
    {"discrete_detections", "1", &StepMetrics::discrete_detections},
    {"continuous_detections", "1", &StepMetrics::continuous_detections},
    {"guess_rounds", "1", &StepMetrics::guess_rounds},
    {"iterations", "1", &StepMetrics::iterations},
    {"vertices_cut", "1", &StepMetrics::vertices_cut, "vertices_at_bound"},
    {"share_cut", "1", &StepMetrics::share_cut, "share_at_bound"},
    {"momentum_lost_guess", "1", &StepMetrics::momentum_lost_guess},
    {"momentum_lost_end", "1", &StepMetrics::momentum_lost_end},
    {"largest_lag", "m", &StepMetrics::largest_lag},
    {"query_radius", "m", &StepMetrics::query_radius},
    {"residual", "1", &StepMetrics::residual},
    {"kinetic_energy", "J", &StepMetrics::kinetic_energy},
    {"elastic_energy", "J", &StepMetrics::elastic_energy},
    {"contact_energy", "J", &StepMetrics::contact_energy},
    {"gravity_energy", "J", &StepMetrics::gravity_energy},
    {"smallest_distance", "m", &StepMetrics::smallest_distance},
    {"repeats", "1", &StepMetrics::repeats},
    {"status", "bits", &StepMetrics::status},
}};

/// Groups of columns that only some runs have. They follow `columns` in this order: tetrahedra, volumes, volumes of
/// tetrahedra, rods, meetings, convergence.
constexpr std::array<StepColumn, 1> solid_columns{{
    {"inverted_tetrahedra", "1", &StepMetrics::inverted_tetrahedra},
}};
constexpr std::array<StepColumn, 3> volume_columns{{
    {"volume_contacts", "1", &StepMetrics::volume_contacts},
    {"vertices_inside", "1", &StepMetrics::vertices_inside},
    {"deepest", "m", &StepMetrics::deepest},
}};
constexpr std::array<StepColumn, 1> sheet_columns{{
    {"depth_unresolved", "1", &StepMetrics::depth_unresolved},
}};
constexpr std::array<StepColumn, 3> rod_columns{{
    {"smallest_contact_distance", "m", &StepMetrics::smallest_contact_distance},
    {"mean_stretch", "1", &StepMetrics::mean_stretch},
    {"largest_stretch", "1", &StepMetrics::largest_stretch},
}};
constexpr std::array<StepColumn, 1> meeting_columns{{
    {"meetings", "1", &StepMetrics::meetings},
}};

constexpr std::array<StepColumn, 4> convergence_columns{{
    {"last_motion", "1", &StepMetrics::last_motion},
    {"left_residual", "1", &StepMetrics::left_residual},
    {"left_rounding", "1", &StepMetrics::left_rounding},
    {"left_held", "1", &StepMetrics::left_held},
}};

/// Returns all columns except those of a ledger.
std::vector<StepColumn> common_columns(const StepGroups& groups) {
  std::vector<StepColumn> all(columns.begin(), columns.end());
  if (groups.solids) all.insert(all.end(), solid_columns.begin(), solid_columns.end());
  if (groups.volumes) all.insert(all.end(), volume_columns.begin(), volume_columns.end());
  if (groups.sheets) all.insert(all.end(), sheet_columns.begin(), sheet_columns.end());
  if (groups.rods) all.insert(all.end(), rod_columns.begin(), rod_columns.end());
  if (groups.meetings) all.insert(all.end(), meeting_columns.begin(), meeting_columns.end());
  if (groups.convergence) all.insert(all.end(), convergence_columns.begin(), convergence_columns.end());
  return all;
}

struct LedgerColumn {
  std::string_view name, unit;
  double& (*of)(StepLedger& row);
};

/// Columns of runs with a ledger, which come after all others.
constexpr std::array<LedgerColumn, 25> ledger_columns{{
    {"energy_start", "J", [](StepLedger& l) -> double& { return l.energy_start; }},
    {"energy_guess", "J", [](StepLedger& l) -> double& { return l.energy_guess; }},
    {"energy_detection", "J", [](StepLedger& l) -> double& { return l.energy_detection; }},
    {"energy_sweep", "J", [](StepLedger& l) -> double& { return l.energy_sweep; }},
    {"energy_truncation", "J", [](StepLedger& l) -> double& { return l.energy_truncation; }},
    {"energy_commit", "J", [](StepLedger& l) -> double& { return l.energy_commit; }},
    {"momentum_start_x", "kg m/s", [](StepLedger& l) -> double& { return l.momentum_start.x; }},
    {"momentum_start_y", "kg m/s", [](StepLedger& l) -> double& { return l.momentum_start.y; }},
    {"momentum_start_z", "kg m/s", [](StepLedger& l) -> double& { return l.momentum_start.z; }},
    {"momentum_guess_x", "kg m/s", [](StepLedger& l) -> double& { return l.momentum_guess.x; }},
    {"momentum_guess_y", "kg m/s", [](StepLedger& l) -> double& { return l.momentum_guess.y; }},
    {"momentum_guess_z", "kg m/s", [](StepLedger& l) -> double& { return l.momentum_guess.z; }},
    {"momentum_sweep_x", "kg m/s", [](StepLedger& l) -> double& { return l.momentum_sweep.x; }},
    {"momentum_sweep_y", "kg m/s", [](StepLedger& l) -> double& { return l.momentum_sweep.y; }},
    {"momentum_sweep_z", "kg m/s", [](StepLedger& l) -> double& { return l.momentum_sweep.z; }},
    {"momentum_truncation_x", "kg m/s", [](StepLedger& l) -> double& { return l.momentum_truncation.x; }},
    {"momentum_truncation_y", "kg m/s", [](StepLedger& l) -> double& { return l.momentum_truncation.y; }},
    {"momentum_truncation_z", "kg m/s", [](StepLedger& l) -> double& { return l.momentum_truncation.z; }},
    {"motion_proposed", "kg m/s", [](StepLedger& l) -> double& { return l.motion_proposed; }},
    {"motion_taken", "kg m/s", [](StepLedger& l) -> double& { return l.motion_taken; }},
    {"motion_taken_tangential", "kg m/s", [](StepLedger& l) -> double& { return l.motion_taken_tangential; }},
    {"motion_taken_leaving", "kg m/s", [](StepLedger& l) -> double& { return l.motion_taken_leaving; }},
    {"motion_taken_unpaired", "kg m/s", [](StepLedger& l) -> double& { return l.motion_taken_unpaired; }},
    {"vertices_still", "1", [](StepLedger& l) -> double& { return l.vertices_still; }},
    {"vertices_held", "1", [](StepLedger& l) -> double& { return l.vertices_held; }},
}};

constexpr std::string_view stage_prefix = "stage_", stage_unit = " [ms]";

template <class T>
void print(std::string& text, T value) {
  if (value != value) {
    text += "nan";  // std::to_chars would print the sign of not-a-number
    return;
  }
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> parts;
  for (std::size_t comma = 0; comma != std::string_view::npos; line.remove_prefix(comma + 1)) {
    comma = line.find(',');
    parts.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) break;
  }
  return parts;
}

template <class T>
bool parse(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

std::string title_of(std::string_view name, std::string_view unit) {
  return std::string(name) + " [" + std::string(unit) + "]";
}

template <class Column>
std::string column_title(const Column& column) {
  return title_of(column.name, column.unit);
}

bool is_titled(const StepColumn& column, std::string_view title) {
  return title == column_title(column) ||
         (!column.former_name.empty() && title == title_of(column.former_name, column.unit));
}

/// Returns the table of a header, without rows.
StepTable parse_header(const std::string& file, std::string_view line) {
  const std::vector<std::string_view> titles = split(line);
  const auto refuse = [&](std::size_t i, const std::string& expected) {
    throw InputError(file + ": line 1: column " + std::to_string(i + 1) + " is '" +
                     (i < titles.size() ? std::string(titles[i]) : "") + "' where '" + expected +
                     "' is expected: the run was written by another version of the program; read it with that one");
  };
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (i >= titles.size() || !is_titled(columns[i], titles[i])) refuse(i, column_title(columns[i]));
  StepTable table;
  const auto begins = [&](std::size_t i, const std::string& title) { return i < titles.size() && titles[i] == title; };
  std::size_t common = columns.size();
  table.groups.solids = begins(common, column_title(solid_columns.front()));
  const auto find_group = [&](bool& is_there, std::span<const StepColumn> group) {
    common = common_columns(table.groups).size();
    is_there = begins(common, column_title(group.front()));
    for (std::size_t i = 0; is_there && i < group.size(); ++i)
      if (!begins(common + i, column_title(group[i]))) refuse(common + i, column_title(group[i]));
  };
  find_group(table.groups.volumes, volume_columns);
  find_group(table.groups.sheets, sheet_columns);
  find_group(table.groups.rods, rod_columns);
  find_group(table.groups.meetings, meeting_columns);
  find_group(table.groups.convergence, convergence_columns);
  common = common_columns(table.groups).size();
  table.groups.ledger = begins(common, column_title(ledger_columns.front()));
  if (table.groups.ledger)
    for (std::size_t i = 0; i < ledger_columns.size(); ++i)
      if (const std::string title = column_title(ledger_columns[i]);
          common + i >= titles.size() || titles[common + i] != title)
        refuse(common + i, title);
  for (std::size_t i = common + (table.groups.ledger ? ledger_columns.size() : 0); i < titles.size(); ++i) {
    if (!titles[i].starts_with(stage_prefix) || !titles[i].ends_with(stage_unit)) refuse(i, "stage_NAME [ms]");
    table.stage_names.emplace_back(
        titles[i].substr(stage_prefix.size(), titles[i].size() - stage_prefix.size() - stage_unit.size()));
  }
  return table;
}

std::size_t width_of(const StepTable& table) {
  return common_columns(table.groups).size() + (table.groups.ledger ? ledger_columns.size() : 0) +
         table.stage_names.size();
}

/// Returns false if the line is not a row of this table.
bool parse_row(std::string_view line, const StepTable& table, StepMetrics& row) {
  const std::vector<std::string_view> parts = split(line);
  if (parts.size() != width_of(table)) return false;
  const auto read = [&](std::size_t i, const StepColumn& column) {
    return std::visit([&](auto field) { return parse(parts[i], row.*field); }, column.field);
  };
  const std::vector<StepColumn> own = common_columns(table.groups);
  for (std::size_t i = 0; i < own.size(); ++i)
    if (!read(i, own[i])) return false;
  const std::size_t common = own.size();
  if (table.groups.ledger) row.ledger.emplace();
  for (std::size_t i = 0; table.groups.ledger && i < ledger_columns.size(); ++i)
    if (!parse(parts[common + i], ledger_columns[i].of(*row.ledger))) return false;
  const std::size_t stage_count = table.stage_names.size(), first = parts.size() - stage_count;
  row.stage_ms.resize(stage_count);
  for (std::size_t i = 0; i < stage_count; ++i)
    if (!parse(parts[first + i], row.stage_ms[i])) return false;
  return true;
}

}  // namespace

std::span<const StepColumn> step_columns() { return columns; }

std::string step_header(std::span<const std::string> stage_names, const StepGroups& groups) {
  std::string text;
  for (const StepColumn& column : common_columns(groups)) {
    if (!text.empty()) text += ',';
    text += column_title(column);
  }
  if (groups.ledger)
    for (const LedgerColumn& column : ledger_columns) text += "," + column_title(column);
  for (const std::string& name : stage_names) text.append(",").append(stage_prefix).append(name).append(stage_unit);
  text += '\n';
  return text;
}

std::string step_lines(std::span<const StepMetrics> rows, std::size_t stage_count, const StepGroups& groups) {
  const std::vector<StepColumn> common = common_columns(groups);
  std::string text;
  for (const StepMetrics& row : rows) {
    if (!row.stage_ms.empty() && row.stage_ms.size() != stage_count)
      throw std::invalid_argument("steps.csv: a row with times for another number of stages");
    for (const StepColumn& column : common) {
      if (&column != &common.front()) text += ',';
      std::visit([&](auto field) { print(text, row.*field); }, column.field);
    }
    StepLedger ledger = row.ledger.value_or(StepLedger{});
    for (std::size_t i = 0; groups.ledger && i < ledger_columns.size(); ++i) {
      text += ',';
      print(text, row.ledger ? ledger_columns[i].of(ledger) : std::numeric_limits<double>::quiet_NaN());
    }
    for (std::size_t i = 0; i < stage_count; ++i) {
      text += ',';
      print(text, row.stage_ms.empty() ? std::numeric_limits<double>::quiet_NaN() : row.stage_ms[i]);
    }
    text += '\n';
  }
  return text;
}

StepTable read_steps(const std::filesystem::path& folder, std::int64_t last) {
  const std::filesystem::path path = folder / "steps.csv";
  if (!std::filesystem::exists(path))
    throw InputError(path.string() + ": is missing: name a folder that `ogc run` has written");
  const std::string text = read_bytes(path);
  StepTable table;
  std::size_t number = 0;
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string_view line(text.data() + begin, end - begin);
    std::int64_t step = 0;
    if (number > 0 && std::from_chars(line.data(), line.data() + line.size(), step).ec == std::errc{} && step > last)
      break;
    if (++number == 1)
      table = parse_header(path.string(), line);
    else if (!parse_row(line, table, table.rows.emplace_back()))
      throw InputError(path.string() + ": line " + std::to_string(number) + ": is no row of " +
                       std::to_string(width_of(table)) +
                       " numbers: the file was changed by hand or is damaged; remove the line");
  }
  if (number == 0)
    throw InputError(path.string() + ": has no header: the run was killed before it began; run it again");
  return table;
}

}  // namespace ogc::compare
