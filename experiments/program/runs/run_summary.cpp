// Describes the result of a run as text and as JSON.
#include <cmath>

#include <nlohmann/json.hpp>

#include "experiments/program/runs/run_session.hpp"

namespace ogc::experiments {

namespace {

std::string integer(std::int64_t value) { return std::to_string(value); }

/// Returns the reason why no state was audited; a run may end before its first state to audit.
std::string not_checked(const RunSummary& summary) {
  if (summary.audit == AuditMode::off) return "not checked (audit off)";
  return "not checked (audit " + name_of(summary.audit) + ", but the run came to no state to audit)";
}

/// Returns in words which pairs the guarantee excludes because they intersected at the start; empty if none.
std::string but_for(const RunSummary& summary) {
  if (summary.start_pairs == 0) return "";
  return "but for " + counted(summary.start_pairs, "pair") + " of vertices that met at the start, " +
         std::to_string(summary.open_pairs) + " still open";
}

std::string guarantee(const RunSummary& summary) {
  if (!summary.guarantee_kept) return not_checked(summary) + (summary.start_pairs == 0 ? "" : "; " + but_for(summary));
  if (!*summary.guarantee_kept) return "NO";
  if (summary.start_pairs > 0 && !summary.is_unbounded)
    return "kept " + but_for(summary) + " (" + counted(summary.audited_states, "state") + " audited exactly)";
  if (summary.is_unbounded)
    return "no guarantee (bounds=off); " + counted(summary.audited_states, "state") + " audited";
  return "yes (" + counted(summary.audited_states, "state") + " audited exactly)";
}

std::string momentum_lost(const RunSummary& summary) {
  if (!summary.largest_momentum_lost)
    return "none by truncation: no guess loop that was looked at needed all its rounds";
  return "at most " + number(100 * *summary.largest_momentum_lost) + " % of what a step was to move, in the guess loop";
}

std::string force_left(const RunSummary& summary) {
  if (summary.measured_steps == 0) return "not measured (too few steps, no forces, or no solver that sweeps)";
  return number(100 * summary.left_residual, 3) + " % of free vertices' force in the median of " +
         counted(summary.measured_steps, "step") + "; bounds held " + number(summary.left_held) + " more";
}

std::string per_step(std::int64_t count, std::int64_t steps) {
  return steps > 0 ? number(static_cast<double>(count) / static_cast<double>(steps)) + " a step" : "none";
}

std::string wall_time(const RunSeconds& seconds) {
  return number(seconds.whole) + " s: start " + number(seconds.start) + " s, steps " + number(seconds.steps) +
         " s; waited for audits " + number(seconds.audits) + " s, for the disk " + number(seconds.writing) + " s";
}

}  // namespace

std::string guarantee_text(const RunSummary& summary) {
  if (!summary.guarantee_kept) return "not checked";
  if (!*summary.guarantee_kept) return "no";
  return summary.start_pairs == 0 ? "yes" : but_for(summary);
}

Json to_json(const RunSummary& summary) {
  Json json{{"scene", summary.scene}};
  json["scale"] = summary.scale.empty() ? Json(nullptr) : Json(summary.scale);
  json["solver"] = summary.solver;
  json["backend"] = summary.backend;
  json["device"] = summary.device;
  json["folder"] = summary.folder;
  json["status"] = summary.status;
  const bool is_whole = summary.start_pairs == 0 || summary.guarantee_kept == false;
  json["guarantee_kept"] = summary.guarantee_kept && is_whole ? Json(*summary.guarantee_kept) : Json(nullptr);
  if (summary.start_pairs > 0) json["start_pairs"] = {{"named", summary.start_pairs}, {"open", summary.open_pairs}};
  json["final_hash"] = summary.final_hash;
  const RunSeconds& seconds = summary.seconds;
  json["seconds"] = {{"whole", seconds.whole},
                     {"start", seconds.start},
                     {"steps", seconds.steps},
                     {"audits", seconds.audits},
                     {"writing", seconds.writing}};
  json["first_step"] = summary.first_step;
  json["last_step"] = summary.last_step;
  json["step_ms"] = {{"median", summary.median_ms}, {"worst", summary.worst_ms}, {"worst_step", summary.worst_step}};
  json["contacts"] = {{"vertex_facet", summary.last_vertex_facet_contacts},
                      {"edge_edge", summary.last_edge_edge_contacts},
                      {"most", summary.most_contacts}};
  json["detections"] = {{"broad_phases", summary.detections},
                        {"discrete", summary.discrete_detections},
                        {"continuous", summary.continuous_detections}};
  json["guess_rounds"] = summary.guess_rounds;
  json["iterations"] = summary.iterations;
  json["repeats"] = summary.repeats;
  json["largest_share_cut"] = summary.largest_share_cut;
  json["largest_momentum_lost"] = summary.largest_momentum_lost ? Json(*summary.largest_momentum_lost) : Json(nullptr);
  json["left"] = summary.measured_steps == 0 ? Json(nullptr)
                                             : Json{{"steps", summary.measured_steps},
                                                    {"median_residual", summary.left_residual},
                                                    {"median_held", summary.left_held}};
  json["largest_lag_m"] = summary.largest_lag;
  json["smallest_distance_m"] = summary.smallest_distance;
  json["audit"] = {{"mode", name_of(summary.audit)},
                   {"states", summary.audited_states},
                   {"failed_states", summary.failed_states},
                   {"intersections", summary.intersections},
                   {"beyond_bound", summary.certificate_violations},
                   {"unsafe_bounds", summary.unsafe_bounds}};
  if (summary.asks_meetings) {
    json["audit"]["meetings"] = summary.meetings;
    json["audit"]["first_meeting"] = summary.first_meeting < 0 ? Json(nullptr) : Json(summary.first_meeting);
  }
  if (summary.has_volumes) {
    const auto checked = [&](Json most) { return summary.audited_states > 0 ? most : Json(nullptr); };
    json["volumes"] = {{"inside_at_start", summary.inside_at_start},
                       {"most_inside", checked(summary.most_inside)},
                       {"deepest_m", checked(summary.deepest)},
                       {"deepest_step", checked(summary.deepest_step)},
                       {"most_edges_meeting", checked(summary.most_edges_meeting)},
                       {"most_unresolved", summary.most_unresolved}};
  }
  if (!summary.left_out_of_audits.empty()) json["audit"]["left_out"] = summary.left_out_of_audits;
  if (!summary.failure.empty()) json["failure"] = summary.failure;
  json["warnings"] = summary.warnings;
  return json;
}

std::string describe(const RunSummary& summary) {
  const std::int64_t steps = summary.last_step - summary.first_step;
  std::vector<std::vector<std::string>> rows{
      {"run folder", summary.folder},
      {"status", summary.status},
      {"computed by", summary.solver + " on " + summary.backend + ", " + summary.device},
      {"steps", integer(steps) + " (state " + integer(summary.first_step) + " to " + integer(summary.last_step) + ")"},
      {"time a step", "median " + number(summary.median_ms) + " ms, worst " + number(summary.worst_ms) + " ms (step " +
                          integer(summary.worst_step) + ")"},
      {"wall time", wall_time(summary.seconds)},
      {"contacts", "last " + integer(summary.last_vertex_facet_contacts) + " vertex-facet + " +
                       integer(summary.last_edge_edge_contacts) + " edge-edge, most " + integer(summary.most_contacts)},
      {"detections", per_step(summary.discrete_detections, steps) + " discrete, " +
                         per_step(summary.continuous_detections, steps) + " continuous"},
      {"guess rounds", per_step(summary.guess_rounds, steps)},
      {"repeated steps", integer(summary.repeats) + " (a list grew)"},
      {"vertices cut", "at most " + number(100 * summary.largest_share_cut) + " % after a step's last iteration"},
      {"momentum lost", momentum_lost(summary)},
      {"force left", force_left(summary)},
      {"largest lag", number(summary.largest_lag) + " m of prescribed vertices"},
      {"smallest distance",
       std::isfinite(summary.smallest_distance) ? number(summary.smallest_distance) + " m" : "not measured"},
      {"guarantee kept", guarantee(summary)},
      {"final state", summary.final_hash + " (FNV-1a of the positions' bits)"},
  };
  if (summary.has_volumes)
    rows.insert(rows.end() - 1, {"inside volumes", summary.audited_states == 0
                                                       ? not_checked(summary)
                                                       : "at most " + counted(summary.most_inside, "vertex position") +
                                                             ", the deepest " + number(summary.deepest) + " m (state " +
                                                             integer(summary.deepest_step) + "); at most " +
                                                             counted(summary.most_edges_meeting, "edge") + " through"});
  if (summary.asks_meetings)
    rows.insert(rows.end() - 1, {"meetings on the way",
                                 summary.meetings == 0 ? "none"
                                                       : counted(static_cast<std::size_t>(summary.meetings), "pair") +
                                                             ", the first in step " + integer(summary.first_meeting)});
  if (!summary.left_out_of_audits.empty()) rows.insert(rows.end() - 1, {"not audited", summary.left_out_of_audits});
  std::string warnings;
  for (const std::string& warning : summary.warnings) warnings += (warnings.empty() ? "warnings: " : "; ") + warning;
  return table(rows, 2) + warnings + (warnings.empty() ? "" : "\n");
}

}  // namespace ogc::experiments
