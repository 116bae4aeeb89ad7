#include "compare/judge/report/page.hpp"

#include <algorithm>
#include <cmath>

#include "compare/judge/report/report.hpp"
#include "compare/judge/report/svg.hpp"

namespace ogc::compare {

namespace {

constexpr const char* style =
    "body{font:15px/1.45 sans-serif;margin:2em auto;max-width:90em;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;margin:.5em 0 1.5em}th,td{padding:.15em .7em;text-align:right;border-bottom:1px "
    "solid #ddd;white-space:nowrap}"
    "th{border-bottom:2px solid #888}td:first-child,th:first-child,td.words,th.words{text-align:left}"
    ".wrong{background:#fdd}.loose{background:#ffd}code{font-size:13px}figure{display:inline-block;margin:0 2em 1em "
    "0}figcaption{font-size:13px;color:#555}";

// Readers do not need to distinguish errors below 2⁻¹⁰ units.
constexpr int lowest_octave = -10;
constexpr double plot_height = 120, bar_width = 14, left = 34, below = 34;

std::string cell(const std::string& text, const std::string& kind = "") {
  return "<td" + (kind.empty() ? "" : " class=\"" + kind + "\"") + ">" + escaped(text) + "</td>";
}

std::string row_html(const StageReport& report, const ReportRow& row, bool loose) {
  std::string html = report.passed() || report.skipped ? "<tr>" : "<tr class=\"wrong\">";
  for (std::size_t c = 0; c < row.size(); ++c) html += cell(row[c], c == 6 ? "words" : c == 11 && loose ? "loose" : "");
  return html + "</tr>\n";
}

std::string main_table(std::span<const StageReport> reports) {
  std::string html = "<table>\n<tr>";
  const ReportRow columns = report_columns();
  for (std::size_t c = 0; c < columns.size(); ++c)
    html += (c == 6 ? "<th class=\"words\">" : "<th>") + escaped(columns[c]) + "</th>";
  html += "</tr>\n";
  for (const StageReport& report : reports) {
    const auto infos = metrics(report.tally.stage);
    const std::vector<ReportRow> rows = report_rows(report);
    for (std::size_t i = 0; i < rows.size(); ++i)
      html += row_html(report, rows[i], i < infos.size() && report.tally.metrics[i].is_loose(infos[i]));
  }
  return html + "</table>\n";
}

/// Draws one bar for each octave, with heights on a logarithmic scale, and a line at the tolerance.
std::string histogram(const Histogram& errors, double tolerance, const std::string& name) {
  const auto octaves = errors.octaves(lowest_octave);
  const int first = octaves.front().exponent, last = std::max(octaves.back().exponent, std::ilogb(tolerance));
  Svg svg(left + bar_width * (last - first + 1) + 40, plot_height + below);
  svg.title(name + ": number of errors by size, logarithmic");
  const double most = std::log10(1.0 + static_cast<double>(errors.count()));
  for (const auto& octave : octaves) {
    const double height = (plot_height - 14) * std::log10(1.0 + static_cast<double>(octave.count)) / most;
    svg.rectangle({left + bar_width * (octave.exponent - first), plot_height - height}, bar_width - 2, height,
                  "fill:#4477aa");
  }
  const double at = left + bar_width * (std::log2(tolerance) - first);
  svg.line({at, 6}, {at, plot_height}, "stroke:#cc3311;stroke-dasharray:3 2");
  svg.line({left - 4, plot_height}, {left + bar_width * (last - first + 1), plot_height}, "stroke:#888");
  for (int e = first; e <= last; ++e)
    if ((e - first) % 4 == 0)
      svg.text({left + bar_width * (e - first), plot_height + 14},
               (e == lowest_octave ? "≤2^" : "2^") + std::to_string(e), "font:10px sans-serif");
  svg.text({2, 12}, std::to_string(errors.count()), "font:10px sans-serif");
  return svg.finish();
}

std::string metrics_html(const Tally& tally) {
  std::string html;
  const auto infos = metrics(tally.stage);
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (tally.metrics[i].errors.count() == 0) continue;
    const std::string name = std::string(infos[i].name) + " [" + std::string(infos[i].unit) + "]";
    html += "<figure>" + histogram(tally.metrics[i].errors, infos[i].tolerance, name) + "<figcaption>" + escaped(name) +
            "<br>worst: <code>" + escaped(print_problem(tally.metrics[i].worst)) + "</code></figcaption></figure>\n";
  }
  return html;
}

std::string generators_html(const Tally& tally) {
  std::string html =
      "<details><summary>generators</summary><table>\n<tr><th>generator</th><th>cases</th><th>decisions</th><th>grey</"
      "th><th>not exact</th><th>near</th>"
      "<th>mismatches</th></tr>\n";
  for (const auto& [name, row] : tally.generators)
    html += "<tr>" + cell(name) + cell(std::to_string(row.cases)) + cell(std::to_string(row.decisions)) +
            cell(std::to_string(row.grey)) + cell(std::to_string(row.not_exact)) + cell(std::to_string(row.near)) +
            cell(std::to_string(row.mismatches)) + "</tr>\n";
  return html + "</table></details>\n";
}

std::string mismatches_html(const Tally& tally) {
  if (tally.mismatches.empty()) return {};
  std::string html = "<ul>\n";
  for (const Mismatch& item : tally.mismatches)
    html += "<li><code>" + escaped(print_problem(item.name)) + "</code><br>" + escaped(item.message) + "</li>\n";
  return html + "</ul>\n";
}

}  // namespace

std::string report_page(std::span<const StageReport> reports, const std::string& heading) {
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + escaped(heading) +
                     "</title><style>";
  html += std::string(style) + "</style></head><body>\n<h1>" + escaped(heading) + "</h1>\n" + main_table(reports);
  html += "<p>" + escaped(report_total(reports)) +
          "</p>\n<p>Grey share: decisions of the generic generators that lie within 16 u of a boundary. Not exact: "
          "grey decisions of all generators that are answered otherwise than exactly. Near share: cases within "
          "2<sup>10</sup> ulp of one. "
          "Room: how many times what is accepted exceeds the largest error; marked where loose, above 50. Histograms "
          "count errors by powers of two of "
          "their unit, on a logarithmic scale; the dashed line is what is accepted.</p>\n";
  for (const StageReport& report : reports) {
    if (report.skipped) continue;
    html += "<h2>" + std::string(stage_name(report.tally.stage)) + ": " + escaped(verdict(report)) + "</h2>\n";
    if (!report.note.empty()) html += "<p>" + escaped(report.note) + "</p>\n";
    if (report.diagnosis) html += "<p>" + escaped(diagnosis_text(*report.diagnosis)) + "</p>\n";
    html += mismatches_html(report.tally) + metrics_html(report.tally) + generators_html(report.tally);
  }
  return html + "</body></html>\n";
}

}  // namespace ogc::compare
