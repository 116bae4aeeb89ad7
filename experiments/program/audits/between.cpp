#include "experiments/program/audits/between.hpp"

#include <tbb/task_arena.h>

#include <algorithm>

#include "compare/problem/error.hpp"

namespace ogc::experiments {
namespace {

Json to_json(const compare::Meeting& meeting, const compare::Topology& topology, const std::string& text) {
  const auto edge = [&](compare::Index e) { return topology.edges[static_cast<std::size_t>(e)]; };
  if (meeting.kind == compare::MeetingKind::edge_edge)
    return {{"kind", "edge_edge"},
            {"time", meeting.time},
            {"edge", meeting.first},
            {"edge_vertices", edge(meeting.first)},
            {"other_edge", meeting.second},
            {"other_edge_vertices", edge(meeting.second)},
            {"text", text}};
  return {{"kind", "vertex_triangle"},
          {"time", meeting.time},
          {"vertex", meeting.first},
          {"triangle", meeting.second},
          {"triangle_vertices", topology.triangles[static_cast<std::size_t>(meeting.second)]},
          {"text", text}};
}

}  // namespace

void WaysBetween::announce(const AuditedState& from, const AuditedState& to) const {
  const std::size_t ways = source_.size() - 1;
  const compare::MeetingsCost cost = compare::meetings_cost(*to.topology, from.positions, to.positions,
                                                            source_.exclusions());
  const double seconds = cost.seconds * static_cast<double>(ways);
  log_line("ogc: " + counted(ways, "straight way") + " between " + counted(ways + 1, "state") + " will take about " +
           (seconds < 90 ? number(seconds, 2) + " s" : number(seconds / 60, 2) + " minutes") + " on " +
           counted(static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()), "thread") + " and " +
           number(std::max(1., static_cast<double>(cost.bytes) / 0x1p20), 2) +
           " MiB, judged by a sample of the first (" + number(cost.pairs, 2) + " pairs of faces)");
}

void WaysBetween::look_at(const AuditedState& state) {
  const AuditedState before = std::move(before_);
  before_ = {state.name, state.topology, state.positions, {}, {}, state.names, ""};
  if (!before.topology) return;
  if (before.topology != state.topology)
    throw compare::InputError(state.name + " has other triangles than " + before.name +
                              ": no way leads from one to the other; leave --between out, or name frames of one mesh");
  if (ways_.empty()) announce(before, state);
  Way way{.from = before.name,
          .to = state.name,
          .found = compare::meetings(*state.topology, before.positions, state.positions, source_.exclusions(), limit_),
          .json = {},
          .text = {}};
  way.json = {{"from", way.from},
              {"to", way.to},
              {"count", way.found.count},
              {"pairs_tested", way.found.pairs_tested},
              {"meetings", Json::array()}};
  for (const compare::Meeting& meeting : way.found.meetings) {
    const std::string text = describe(meeting, *state.topology, state.names);
    way.text += text + "\n";
    way.json["meetings"].push_back(to_json(meeting, *state.topology, text));
  }
  if (way.found.count > way.found.meetings.size())
    way.text += "and " + std::to_string(way.found.count - way.found.meetings.size()) + " more\n";
  ways_.push_back(std::move(way));
}

std::size_t WaysBetween::meetings() const {
  std::size_t sum = 0;
  for (const Way& way : ways_) sum += way.found.count;
  return sum;
}

std::string WaysBetween::headline() const {
  std::string text = counted(ways_.size(), "straight way") + " between them asked exactly, " +
                     counted(meetings(), "meeting");
  const auto meet = [](const Way& way) { return way.found.count > 0; };
  const auto first = std::ranges::find_if(ways_, meet);
  if (first != ways_.end())
    text += " on " + std::to_string(std::ranges::count_if(ways_, meet)) + " of them, the first from " + first->from +
            " to " + first->to;
  return text;
}

}  // namespace ogc::experiments
