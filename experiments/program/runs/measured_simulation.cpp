#include "experiments/program/runs/measured_simulation.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "compare/oracle/meetings.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/rods.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/volumes.hpp"
#include "compare/way.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {
namespace {

using compare::Snapshot;
using compare::StepEvent;
using compare::StepEventKind;
using compare::StepMetrics;

constexpr double not_asked = std::numeric_limits<double>::quiet_NaN();

/// Returns the row whose time is the median, the shorter one of two. `rows`: the same step, repeated.
StepMetrics median_of(std::vector<StepMetrics> rows) {
  const auto middle = rows.begin() + static_cast<std::ptrdiff_t>((rows.size() - 1) / 2);
  std::ranges::nth_element(rows, middle, {}, &StepMetrics::wall_ms);
  return std::move(*middle);
}

/// Gives the times of the events of a step, in the order of its trace: not-a-number if they were not measured.
class EventTimes {
 public:
  explicit EventTimes(const StepMetrics& row)
      : detections_(row.detection_ends_ms), iterations_(row.iteration_ends_ms) {}

  double of_next_detection() { return next(detections_, detection_); }
  /// Returns first the time of the state before all iterations.
  double of_next_iteration() { return next(iterations_, iteration_); }

 private:
  static double next(const std::vector<double>& ends, std::size_t& at) {
    if (ends.empty()) return not_asked;
    if (at == ends.size()) throw std::logic_error("a trace has more events than the step of which times were measured");
    return ends[at++];
  }

  const std::vector<double>&detections_, &iterations_;
  std::size_t detection_ = 0, iteration_ = 0;
};

class MeasuredSimulation : public compare::Simulation {
 public:
  MeasuredSimulation(const compare::Scene& scene, std::unique_ptr<Simulation> inner, compare::Contestant contestant,
                     const Measured& what)
      : scene_(scene),
        names_(scene),
        topology_(build_topology(scene)),
        exclusions_(exclusions(scene)),
        inner_(std::move(inner)),
        teller_(dynamic_cast<compare::WayTeller*>(inner_.get())),
        contestant_(std::move(contestant)),
        has_rows_(what.iterations),
        repeats_(what.repeats),
        meetings_(what.meetings) {
    if (what.residual || what.iterations) meter_.emplace(scene);
    if (what.ledger && compare::has_volumes(scene))
      throw compare::InputError("--ledger knows no volumes; leave it out, or the bodies surfaces");
    if (what.ledger && compare::has_rods(scene)) throw compare::InputError("--ledger knows no rods; leave it out");
    if (what.ledger) ledger_.emplace(scene);
  }

  std::vector<StepMetrics> advance(std::int64_t steps) override {
    std::vector<StepMetrics> rows;
    for (std::int64_t k = 0; k < steps; ++k) {
      const Snapshot before = inner_->snapshot();
      const bool asks_meetings = meetings_ && meetings_->holds(before.step + 1);
      const bool is_told = asks_meetings && teller_ != nullptr && !has_rows_ && !ledger_;
      std::vector<std::vector<compare::Vec3f>> way;
      for (StepMetrics& row : is_told ? teller_->advance_telling(way) : inner_->advance(1))
        rows.push_back(std::move(row));
      const Snapshot after = inner_->snapshot();
      if (after.step == before.step) break;
      if (repeats_ > 0) repeat(before, after, rows.back());
      if (meter_) {
        meter_->begin_step(before.positions, before.velocities, after.step, before.orientations);
        reference::Residual left = meter_->at(after.positions, after.orientations);
        rows.back().residual = left.share;
        vertices_.residual = std::move(left.shares);
      }
      if (is_told)
        add_meetings(way, after.positions, rows.back());
      else if (has_rows_ || ledger_ || (asks_meetings && contestant_.step))
        add_from_trace(before, after, rows.back());
      else if (asks_meetings)
        add_meetings(before.positions, after.positions, rows.back());
      if (rows.back().status & compare::step_met) break;
    }
    return rows;
  }

  Snapshot snapshot() override { return inner_->snapshot(); }
  void restore(const Snapshot& snapshot) override {
    inner_->restore(snapshot);
    vertices_ = {};
  }
  std::vector<std::string> stage_names() const override { return inner_->stage_names(); }
  std::string device() const override { return inner_->device(); }
  const VertexMeasures& vertices() const { return vertices_; }

 private:
  /// Returns the scene whose first step is the step after `before`, because a trace always covers the first step of a
  /// scene. Each motion becomes two keyframes: its targets at the start and the end of the step. Rotating motions keep
  /// their axis and angular velocity, which also rotate the orientations of rods.
  compare::Scene scene_at(const Snapshot& before) const {
    compare::Scene scene = scene_;
    const double h = scene.settings.time_step, now = static_cast<double>(before.step) * h;
    const double end = static_cast<double>(before.step + 1) * h;
    for (std::size_t i = 0; i < scene.motions.size(); ++i) {
      const compare::PrescribedMotion& motion = scene_.motions[i];
      compare::Keyframes keyframes{.times = {0, h}, .positions = prescribed_targets(scene_, motion, now)};
      const std::vector<compare::Vec3f> targets = prescribed_targets(scene_, motion, end);
      keyframes.positions.insert(keyframes.positions.end(), targets.begin(), targets.end());
      scene.motions[i] = {.name = motion.name, .vertices = motion.vertices, .keyframes = std::move(keyframes)};
      if (!compare::says_turn(motion)) continue;
      scene.motions[i].axis = motion.axis;
      scene.motions[i].angular_velocity = motion.angular_velocity;
      scene.motions[i].keyframes.is_rigid = true;
      scene.motions[i].start = motion.start - now;
      scene.motions[i].end = motion.end - now;
    }
    scene.mesh.positions = compare::to_double(before.positions);
    scene.velocities = compare::to_double(before.velocities);
    scene.orientations = before.orientations;
    return scene;
  }

  /// Repeats a step after it was done once, which warmed up the caches, and replaces its times by those of the
  /// repetition whose time is the median.
  void repeat(const Snapshot& before, const Snapshot& after, StepMetrics& row) {
    std::vector<StepMetrics> again;
    for (std::int64_t i = 0; i < repeats_; ++i) {
      inner_->restore(before);
      again.push_back(std::move(inner_->advance(1).at(0)));
      if (inner_->snapshot().positions != after.positions)
        throw std::logic_error("step " + std::to_string(row.step) + " ends in another state when it is repeated");
    }
    StepMetrics median = median_of(std::move(again));
    row.wall_ms = median.wall_ms;
    row.stage_ms = std::move(median.stage_ms);
    row.detection_ends_ms = std::move(median.detection_ends_ms);
    row.iteration_ends_ms = std::move(median.iteration_ends_ms);
  }

  void add_from_trace(const Snapshot& before, const Snapshot& after, StepMetrics& step) {
    const compare::Scene scene = scene_at(before);
    const compare::StepOut trace = contestant_.step({&scene, &topology_});
    if (trace.position != after.positions)
      throw std::logic_error("the trace of step " + std::to_string(step.step) + " ends in another state than the step");
    if (ledger_) {
      step.ledger = ledger_->of(before.positions, before.velocities, trace, contacts_at(after.positions));
      vertices_.cut.assign(ledger_->cut().begin(), ledger_->cut().end());
    }
    if (has_rows_) add_iterations(trace, step);
    if (meetings_ && meetings_->holds(step.step)) add_meetings(detected_at(trace), trace.position, step);
  }

  static std::vector<std::vector<compare::Vec3f>> detected_at(const compare::StepOut& trace) {
    std::vector<std::vector<compare::Vec3f>> states;
    for (const StepEvent& event : trace.events)
      if (event.kind == StepEventKind::detection) states.push_back(event.position);
    return states;
  }

  /// Adds the meetings (pairs that touch during a straight motion) from each detection of a step to the next, and from
  /// the last detection to the step's end. Bounds hold on each of these motions, so that each meeting violates them.
  void add_meetings(const std::vector<std::vector<compare::Vec3f>>& states, const std::vector<compare::Vec3f>& end,
                    StepMetrics& step) {
    for (std::size_t k = 0; k < states.size(); ++k)
      add_meetings(states[k], k + 1 < states.size() ? states[k + 1] : end, step);
    if (step.meetings > 0 && traits_of(scene_.settings.bounds).certifies) step.status |= compare::step_met;
  }

  void add_meetings(const std::vector<compare::Vec3f>& from, const std::vector<compare::Vec3f>& to, StepMetrics& step) {
    const compare::MeetingsResult found = compare::meetings(topology_, compare::to_double(from), compare::to_double(to),
                                                            exclusions_, most_named - named_);
    if (std::isnan(step.meetings)) step.meetings = 0;
    step.meetings += static_cast<double>(found.count);
    for (const compare::Meeting& meeting : found.meetings)
      step.notes.push_back("step " + std::to_string(step.step) + ": " + describe(meeting, topology_, names_));
    named_ += found.meetings.size();
    if (!found.meetings.empty() && named_ == most_named)
      step.notes.push_back("further meetings are counted, not named");
  }

  /// Returns the contacts that the contestant detects at these positions.
  reference::ContactSets contacts_at(const std::vector<compare::Vec3f>& positions) const {
    const auto radius = static_cast<float>(scene_.settings.contact_radius);
    const compare::DetectIn in{&topology_, exclusions_, positions, radius, radius};
    return {contestant_.detect_vertex_facet(in).contacts, contestant_.detect_edge_edge(in).contacts};
  }

  void add_iterations(const compare::StepOut& trace, StepMetrics& step) {
    EventTimes times(step);
    const auto begin = std::ranges::find(trace.events, StepEventKind::sweep, &StepEvent::kind);
    for (auto event = trace.events.begin(); event != trace.events.end(); ++event) {
      const bool detects = event->kind == StepEventKind::detection;
      const double detected = detects ? times.of_next_detection() : not_asked;
      if (detects) {
        contacts_ = {event->vertex_facet.contacts, event->edge_edge.contacts, event->volumes.contacts};
        previous_ = event->position;
      }
      if (event + 1 == begin) add_row(*event, times.of_next_iteration(), step);
      if (event < begin) continue;
      if (detects) {
        step.iteration_rows.pop_back();
        add_row(*event, detected, step);
        step.iteration_rows.back().detected = 1;
        continue;
      }
      step.iteration_rows.back().vertices_cut = event->cut;
      add_row(*event, times.of_next_iteration(), step);
    }
  }

  void add_row(const StepEvent& event, double now, StepMetrics& step) {
    const reference::Residual measured = meter_->with(contacts_, previous_, event.position, event.orientation);
    compare::IterationMetrics row;
    row.step = step.step;
    row.iteration = static_cast<std::int64_t>(step.iteration_rows.size());
    row.wall_ms = now;
    row.residual = measured.share;
    row.energy = measured.energy;
    row.largest_change = row.condition_number = not_asked;
    row.condition_without_friction = row.condition_without_contact = not_asked;
    row.share = 1;
    step.iteration_rows.push_back(row);
  }

  compare::Scene scene_;
  compare::ElementNames names_;
  compare::Topology topology_;
  compare::Exclusions exclusions_;
  std::unique_ptr<Simulation> inner_;
  compare::WayTeller* teller_;  ///< inner_ if it is a WayTeller; otherwise null
  compare::Contestant contestant_;
  bool has_rows_;
  std::int64_t repeats_;  ///< of each step, after the first time
  std::optional<StepRange> meetings_;
  /// Largest number of meetings that notes name, because a run without bounds may have thousands of meetings.
  static constexpr std::size_t most_named = 10;
  std::size_t named_ = 0;  ///< number of meetings named so far
  std::optional<reference::ResidualMeter> meter_;
  std::optional<reference::LedgerWriter> ledger_;
  reference::ContactSets contacts_;       ///< contacts of the trace's last detection
  std::vector<compare::Vec3f> previous_;  ///< positions at that detection
  VertexMeasures vertices_;               ///< of the last step
};

}  // namespace

StepRange step_range(const std::string& text) {
  StepRange range;
  const char *begin = text.data(), *end = begin + text.size();
  const auto [colon, first_error] = std::from_chars(begin, end, range.first);
  if (first_error == std::errc{} && colon != end && *colon == ':') {
    const auto [rest, last_error] = std::from_chars(colon + 1, end, range.last);
    if (last_error == std::errc{} && rest == end && range.first >= 1 && range.first <= range.last) return range;
  }
  throw compare::InputError("'" + compare::shown(text) +
                            "' is no range of steps: give the first and the last one, from 1, as in 40:139");
}

std::string text_of(const StepRange& range) { return std::to_string(range.first) + ":" + std::to_string(range.last); }

const VertexMeasures& vertex_measures(const compare::Simulation& simulation) {
  static const VertexMeasures none;
  const auto* measured = dynamic_cast<const MeasuredSimulation*>(&simulation);
  return measured != nullptr ? measured->vertices() : none;
}

compare::Contestant measured(compare::Contestant contestant, const Measured& what) {
  compare::Contestant result = contestant;
  result.start = [contestant = std::move(contestant), what](const compare::Scene& scene,
                                                            const compare::SimulationOptions& options) {
    return std::make_unique<MeasuredSimulation>(scene, contestant.start(scene, options), contestant, what);
  };
  return result;
}

}  // namespace ogc::experiments
