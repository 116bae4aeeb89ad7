#include "compare/judge/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include <nlohmann/json.hpp>

#include "compare/judge/cases/stage_traits.hpp"
#include "compare/judge/engine/tally.hpp"

namespace ogc::compare {

namespace {

using Json = nlohmann::ordered_json;

std::string print(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

double speed(const StageReport& report) {
  return report.seconds > 0 ? static_cast<double>(report.tally.total().cases) / report.seconds : 0;
}

/// Returns the number of characters of UTF-8 text, by counting all bytes except continuation bytes.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string print_rows(const std::vector<ReportRow>& rows) {
  std::array<std::size_t, ReportRow{}.size()> widths{};
  for (const ReportRow& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  std::string text;
  for (const ReportRow& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string gap(widths[c] - width(row[c]), ' ');
      const bool is_text = c == 0 || c == 6;
      line += (c == 0 ? "" : "  ") + (is_text ? row[c] + gap : gap + row[c]);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

/// Returns text that names the generators with mismatches. The text is empty if too many generators have mismatches or
/// too few cases pass (Tally::confined_to).
std::string confinement(const Tally& tally) {
  const std::vector<std::string> names = tally.confined_to();
  std::string text;
  for (const std::string& name : names) {
    const GeneratorTally& row = tally.generators.at(name);
    text += (text.empty() ? "  all mismatches are in " : ", ") + name + " (" + std::to_string(row.mismatches) +
            " in its " + std::to_string(row.cases) + " cases)";
  }
  return text.empty() ? ""
                      : text + "; the other " + std::to_string(tally.generators.size() - names.size()) +
                            " groups of cases pass\n";
}

/// Lists the metrics whose tolerances are loose.
std::string loose_metrics(const StageReport& report) {
  std::string names;
  const auto infos = metrics(report.tally.stage);
  for (std::size_t i = 0; i < infos.size(); ++i)
    if (report.tally.metrics[i].is_loose(infos[i])) {
      const std::string_view reason = infos[i].loose_because;
      names += (names.empty() ? "" : ", ") + std::string(infos[i].name) +
               (reason.empty() ? "" : " (" + std::string(reason) + ")");
    }
  return names;
}

}  // namespace

std::string verdict(const StageReport& report) {
  if (report.skipped) return "skipped";
  if (report.passed()) return "passed";
  return report.tally.mismatched > 0 ? "mismatch" : "too many grey decisions";
}

ReportRow report_columns() {
  return {"stage",  "cases",  "mismatches", "grey share", "not exact", "near share", "error [unit]",
          "median", "99.9 %", "maximum",    "accepted",   "room",      "cases/s"};
}

std::vector<ReportRow> report_rows(const StageReport& report) {
  const Tally& tally = report.tally;
  std::vector<ReportRow> rows;
  const auto infos = metrics(tally.stage);
  for (std::size_t i = 0; i < std::max<std::size_t>(1, infos.size()); ++i) {
    ReportRow row;
    if (i == 0) {
      row[0] = stage_name(tally.stage);
      row[1] = std::to_string(tally.total().cases);
      row[2] = report.skipped ? "skipped" : std::to_string(tally.mismatched);
      row[3] = print("%.2g", tally.grey_share());
      row[4] = std::to_string(tally.total().not_exact);
      row[5] = stage_info(tally.stage).has_boundary ? print("%.2g", tally.near_share()) : "–";
      row[12] = print("%.3g", speed(report));
    }
    if (infos.empty()) return {row};  // all answers are discrete
    const MetricTally& metric = tally.metrics[i];
    row[6] = std::string(infos[i].name) + " [" + std::string(infos[i].unit) + "]";
    row[7] = print("%.3g", metric.errors.quantile(0.5));
    row[8] = print("%.3g", metric.errors.quantile(0.999));
    row[9] = print("%.3g", metric.errors.maximum());
    row[10] = print("%g", infos[i].tolerance);
    row[11] = metric.errors.count() == 0 ? "" : print("%.3g", metric.room(infos[i]));
    rows.push_back(row);
  }
  return rows;
}

Json report_json(const StageReport& report) {
  const Tally& tally = report.tally;
  const GeneratorTally total = tally.total();
  const Json near_share = stage_info(tally.stage).has_boundary ? Json(tally.near_share()) : Json();
  Json json{{"stage", stage_name(tally.stage)},
            {"verdict", verdict(report)},
            {"cases", total.cases},
            {"questions", tally.questions},
            {"mismatches", tally.mismatched},
            {"grey", total.grey},
            {"decisions", total.decisions},
            {"grey_not_exact", total.not_exact},
            {"grey_share_generic", tally.grey_share()},
            {"near", total.near},
            {"near_share", near_share},
            {"seconds", report.seconds},
            {"cases_per_second", speed(report)},
            {"contestant_seconds", tally.contestant_seconds},
            {"authority_seconds", tally.authority_seconds}};
  if (!report.note.empty()) json["note"] = report.note;
  if (const auto confined = tally.confined_to(); !confined.empty()) json["confined_to"] = confined;
  if (report.diagnosis) json["diagnosis"] = diagnosis_json(*report.diagnosis);
  const auto infos = metrics(tally.stage);
  json["metrics"] = Json::array();
  for (std::size_t i = 0; i < infos.size(); ++i) {
    const MetricTally& metric = tally.metrics[i];
    json["metrics"].push_back({{"name", infos[i].name},
                               {"unit", infos[i].unit},
                               {"tolerance", infos[i].tolerance},
                               {"median", metric.errors.quantile(0.5)},
                               {"p999", metric.errors.quantile(0.999)},
                               {"maximum", metric.errors.maximum()},
                               {"room", std::isfinite(metric.room(infos[i])) ? Json(metric.room(infos[i])) : Json()},
                               {"loose", metric.is_loose(infos[i])},
                               {"worst", metric.errors.count() ? print_problem(metric.worst) : ""}});
  }
  for (const auto& [name, row] : tally.generators)
    json["generators"].push_back({{"name", name},
                                  {"cases", row.cases},
                                  {"decisions", row.decisions},
                                  {"grey", row.grey},
                                  {"not_exact", row.not_exact},
                                  {"near", row.near},
                                  {"mismatches", row.mismatches}});
  json["listed"] = Json::array();
  for (const Mismatch& item : tally.mismatches)
    json["listed"].push_back({{"problem", print_problem(item.name)}, {"message", item.message}});
  return json;
}

std::string report_total(std::span<const StageReport> reports) {
  GeneratorTally sum;
  for (const StageReport& report : reports) {
    const GeneratorTally total = report.tally.total();
    sum.cases += total.cases;
    sum.near += total.near;
    sum.mismatches += report.tally.mismatched;
  }
  const double share = sum.cases > 0 ? static_cast<double>(sum.near) / static_cast<double>(sum.cases) : 0;
  return "all stages: " + std::to_string(sum.cases) + " cases, " + std::to_string(sum.mismatches) + " mismatches, " +
         print("%.3g", 100 * share) + " % of all cases within 2^10 ulp of a decision boundary";
}

std::string report_table(std::span<const StageReport> reports) {
  std::vector<ReportRow> rows{report_columns()};
  for (const StageReport& report : reports)
    for (const ReportRow& row : report_rows(report)) rows.push_back(row);
  std::string text = print_rows(rows) + "\n" + report_total(reports) + "\n";
  for (const StageReport& report : reports) {
    const std::string name(stage_name(report.tally.stage));
    if (report.skipped) {
      text += "\n" + name + ": skipped, for the contestant does not have this stage\n";
      continue;
    }
    text += "\n" + name + ": " + verdict(report) + "; worst cases:\n";
    if (!report.note.empty()) text += "  " + report.note + "\n";
    text += confinement(report.tally);
    if (report.diagnosis) text += "  " + diagnosis_text(*report.diagnosis);
    if (const std::string loose = loose_metrics(report); !loose.empty())
      text += "  loose, never within a factor of 50 of what is accepted: " + loose + "\n";
    const auto infos = metrics(report.tally.stage);
    for (std::size_t i = 0; i < infos.size(); ++i)
      if (report.tally.metrics[i].errors.count())
        text += "  " + std::string(infos[i].name) + ": " + print_problem(report.tally.metrics[i].worst) + "\n";
  }
  return text;
}

std::string report_mismatches(const StageReport& report, std::size_t limit) {
  std::string text;
  std::size_t shown = 0;
  std::map<std::string, std::size_t> by_generator;
  for (const Mismatch& item : report.tally.mismatches) {
    if (++by_generator[item.name.generator] > limit) continue;
    text += print_problem(item.name) + "\n  " + item.message + "\n";
    ++shown;
  }
  if (report.tally.mismatched > shown) text += "… and " + std::to_string(report.tally.mismatched - shown) + " more\n";
  return text;
}

}  // namespace ogc::compare
