#include "experiments/plugins/report.hpp"

#include <nlohmann/json.hpp>

namespace ogc::experiments {

namespace {

double ours_of(const Times& times, std::string_view stage) {
  const auto at = times.find(stage);
  return at == times.end() ? 0 : at->second;
}

/// Returns the time for one case [ns]; not-a-number if no case was judged.
double nanoseconds(double seconds, const compare::StageReport& report) {
  return 1e9 * seconds / static_cast<double>(report.tally.total().cases);
}

}  // namespace

std::string plugin_text(const PluginSeen& seen, std::span<const compare::StageReport> reports) {
  std::vector<std::vector<std::string>> rows{
      {"time", seen.name + " [s]", seen.backend + " [s]", "[ns/case]", "[ns/case]"}};
  for (const compare::StageReport& report : reports) {
    const std::string stage(compare::stage_name(report.tally.stage));
    if (report.skipped || report.tally.total().cases == 0) continue;
    const double mine = report.tally.contestant_seconds, other = ours_of(seen.ours, stage);
    rows.push_back(
        {stage, number(mine), number(other), number(nanoseconds(mine, report)), number(nanoseconds(other, report))});
  }
  std::string text = table(rows, 1) + "(" + seen.name + ": its functions alone; " + seen.backend +
                     ": with copies to and from the backend)\n";
  for (const auto& [output, count] : seen.notes.not_a_number)
    text += seen.name + " returned NaN: " + counted(count, "element") + " of " + output + "\n";
  for (const auto& [output, count] : seen.notes.unwritten)
    text += seen.name + " left unwritten: " + counted(count, "element") + " of " + output + "\n";
  return text;
}

Json plugin_json(const PluginSeen& seen, std::span<const compare::StageReport> reports) {
  Json json{{"name", seen.name},
            {"beside", seen.backend},
            {"times", Json::array()},
            {"not_a_number", Json::object()},
            {"unwritten", Json::object()}};
  for (const compare::StageReport& report : reports) {
    const std::string stage(compare::stage_name(report.tally.stage));
    json["times"].push_back({{"stage", stage},
                             {"plugin_seconds", report.tally.contestant_seconds},
                             {"our_seconds", ours_of(seen.ours, stage)}});
  }
  for (const auto& [output, count] : seen.notes.not_a_number) json["not_a_number"][output] = count;
  for (const auto& [output, count] : seen.notes.unwritten) json["unwritten"][output] = count;
  return json;
}

}  // namespace ogc::experiments
