#include "experiments/program/runs/worlds_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "compare/problem/error.hpp"
#include "experiments/bench/rank_test.hpp"
#include "experiments/program/interrupt.hpp"
#include "experiments/program/progress.hpp"
#include "fast/worlds.hpp"

namespace ogc::experiments {

namespace {

using compare::Snapshot;
using compare::StepMetrics;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

std::string name_of(int world) { return "world " + std::to_string(world); }

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Runs worlds and writes their folder.
class WorldsSession {
 public:
  WorldsSession(RunRequest request, int count)
      : request_(checked(std::move(request))), judge_(request_.scene, request_.sources) {
    expect_memory(static_cast<std::size_t>(count));
    starts_.resize(static_cast<std::size_t>(count));
    for (std::size_t w = 0; w < starts_.size(); ++w) begin_world(w);
  }

  WorldsSummary run() {
    worlds_ = fast::start_worlds(backend(), std::vector<compare::Scene>(starts_.size(), request_.scene));
    for (std::size_t w = 0; w < starts_.size(); ++w) worlds_->reset(static_cast<int>(w), starts_[w]);
    good_ = starts_;
    summary_.scene = request_.scene.name;
    summary_.scale = request_.scale;
    summary_.backend = request_.backend;
    summary_.device = worlds_->device();
    summary_.folder = request_.folder.string();
    compare::Provenance origin = provenance(request_, summary_.device);
    origin.extra["worlds"] = std::to_string(starts_.size());
    writer_.emplace(request_.folder, request_.scene, origin);
    summary_.start_seconds = seconds_since(request_.begun);
    try {
      simulate();
      finish();
    } catch (const std::exception& error) {
      writer_->give_up(std::string("failed: ") + error.what());
      throw;
    }
    return std::move(summary_);
  }

 private:
  fast::Backend backend() const { return request_.backend == "cuda" ? fast::Backend::cuda : fast::Backend::cpu; }

  /// Makes the start of a world, and audits it.
  void begin_world(std::size_t w) {
    Snapshot& start = starts_[w];
    start.positions = compare::to_single(request_.scene.mesh.positions);
    start.velocities = compare::to_single(request_.scene.velocities);
    start.orientations = request_.scene.orientations;
    start.bounds.assign(start.positions.size(), 0);
    compare::WorldRow& row = summary_.worlds.emplace_back();
    row.world = static_cast<int>(w);
    row.smallest_distance = std::numeric_limits<double>::infinity();
    if (request_.jitter.largest > 0) {
      Jitter own = request_.jitter;
      row.jitter_seed = own.seed += w;
      add_jitter(own, request_.scene, start.positions);
    } else if (w > 0) {
      return;  // the start of world 0
    }
    const compare::AuditResult result = judge_.audit(start.positions);
    if (result.count > 0)
      throw compare::InputError("the scene '" + request_.scene.name + "' starts with " +
                                counted(result.count, "intersection") + " in " + name_of(row.world) +
                                "; no method that starts from a penetration can promise to have none. Move these "
                                "apart:\n" +
                                judge_.describe(result));
  }

  /// Says how much memory the worlds need. Throws if it is not there.
  void expect_memory(std::size_t worlds) {
    summary_.megabytes = static_cast<double>(fast::world_bytes(request_.scene)) * static_cast<double>(worlds) / 1e6;
    log_line("ogc: " + counted(worlds, "world") + " of " + std::to_string(request_.scene.mesh.positions.size()) +
             " vertices need " + number(summary_.megabytes) + " MB of the " +
             (request_.backend == "cuda" ? "device's" : "machine's") + " memory at the start");
    fast::expect_room(backend(), request_.scene, worlds);
  }

  void simulate() {
    Progress progress(0, request_.scene.settings.steps, "step");
    std::int64_t step = 0;
    while (step < request_.scene.settings.steps && !interrupted() && failed_ < starts_.size()) {
      const std::int64_t steps = chunk(step);
      const Clock::time_point begin = Clock::now();
      const auto rows = worlds_->advance(steps_of(steps));
      const double seconds = seconds_since(begin);
      summary_.step_seconds += seconds;
      step_ms_.push_back(1000 * seconds / static_cast<double>(steps));
      step += steps;
      for (std::size_t w = 0; w < rows.size(); ++w) add_rows(w, rows[w]);
      if (is_audited(step) || step == request_.scene.settings.steps || interrupted()) take_states();
      progress.show(step, number(step_ms_.back()) + " ms a step of all worlds" +
                              (failed_ > 0 ? ", " + counted(failed_, "world") + " failed" : ""));
    }
    progress.end();
    summary_.steps = step;
    summary_.was_interrupted = step < request_.scene.settings.steps && failed_ < starts_.size();
  }

  /// Returns the number of steps until the next audit or the end.
  std::int64_t chunk(std::int64_t step) const {
    const std::int64_t frame = frame_steps(request_.scene.settings);
    const std::int64_t to_state = request_.audit == AuditMode::every ? 1 : frame - step % frame;
    return std::min(to_state, request_.scene.settings.steps - step);
  }
  bool is_audited(std::int64_t step) const {
    if (request_.audit == AuditMode::off) return false;
    return request_.audit != AuditMode::end || step == request_.scene.settings.steps;
  }
  std::vector<std::int64_t> steps_of(std::int64_t steps) const {
    std::vector<std::int64_t> all;
    for (const compare::WorldRow& row : summary_.worlds)
      all.push_back(row.failure.empty() && !worlds_->has_failed(row.world) ? steps : 0);
    return all;
  }

  void add_rows(std::size_t w, const std::vector<StepMetrics>& rows) {
    compare::WorldRow& world = summary_.worlds[w];
    if (!world.failure.empty()) return;
    writer_->add_steps(world.world, rows);
    for (const StepMetrics& row : rows) {
      world.detections += row.discrete_detections;
      world.iterations += row.iterations;
      world.repeats += row.repeats;
      world.vertex_facet_contacts = row.vertex_facet_contacts;
      world.edge_edge_contacts = row.edge_edge_contacts;
      world.largest_lag = std::max(world.largest_lag, row.largest_lag);
      world.largest_share_cut = std::max(world.largest_share_cut, row.share_cut);
      if (row.smallest_distance < double{std::numeric_limits<float>::max()})
        world.smallest_distance = std::min(world.smallest_distance, row.smallest_distance);
      world.kinetic_energy = row.kinetic_energy;
      world.elastic_energy = row.elastic_energy;
      world.contact_energy = row.contact_energy;
      world.gravity_energy = row.gravity_energy;
    }
    const std::string broken = rows.empty() ? "the simulation did no step; please report it"
                                            : step_failure(rows.back());
    if (broken.empty()) return;
    take_state(w);
    if (world.failure.empty()) fail(world, broken);
  }

  void fail(compare::WorldRow& world, const std::string& failure) {
    world.failure = first_line(failure);
    ++failed_;
    log_line("ogc: " + name_of(world.world) + ": " + failure);
  }

  /// Takes the state of each world that goes on.
  void take_states() {
    for (std::size_t w = 0; w < starts_.size(); ++w)
      if (summary_.worlds[w].failure.empty()) take_state(w);
  }

  /// Takes the state of a world, after its audit, as its last good one.
  void take_state(std::size_t w) {
    compare::WorldRow& world = summary_.worlds[w];
    Snapshot state = worlds_->snapshot(world.world);
    if (state.step == good_[w].step) return;
    if (request_.audit != AuditMode::off) {
      const Clock::time_point begin = Clock::now();
      const Verdict verdict = judge_.judge(state);
      summary_.audit_seconds += seconds_since(begin);
      ++summary_.audited_states;
      const bool is_too_deep = request_.deepest && verdict.volumes.deepest > *request_.deepest;
      if (!verdict.kept() || is_too_deep)
        return fail(world, "the audit of step " + std::to_string(state.step) +
                               " failed; the last good state is kept:\n" + judge_.describe(verdict));
      ++world.audited_states;
    }
    good_[w] = std::move(state);
  }

  void finish() {
    std::vector<compare::Frame> ends;
    for (std::size_t w = 0; w < starts_.size(); ++w) {
      const Snapshot& end = good_[w];
      compare::WorldRow& world = summary_.worlds[w];
      world.last_step = end.step;
      world.final_hash = state_hash(end.positions);
      world.status = !world.failure.empty() ? "failed" : summary_.was_interrupted ? "interrupted" : "finished";
      ends.push_back({end.step, static_cast<double>(end.step) * request_.scene.settings.time_step, end.positions,
                      end.velocities, end.bounds, end.orientations});
    }
    summary_.failed = failed_;
    summary_.step_ms = median(step_ms_);
    summary_.status = failed_ > 0 ? "failed: " + counted(failed_, "world") + " of " + std::to_string(starts_.size())
                      : summary_.was_interrupted ? "interrupted"
                                                 : "finished";
    summary_.whole_seconds = seconds_since(request_.begun);
    writer_->set_extra("memory_megabytes", number(summary_.megabytes, 6));
    writer_->set_extra("whole_seconds", number(summary_.whole_seconds, 6));
    writer_->set_extra("start_seconds", number(summary_.start_seconds, 6));
    writer_->set_extra("step_seconds", number(summary_.step_seconds, 6));
    writer_->set_extra("audit_seconds", number(summary_.audit_seconds, 6));
    writer_->set_extra("audited_states", std::to_string(summary_.audited_states));
    writer_->finish(summary_.worlds, ends, summary_.status);
  }

  RunRequest request_;
  StateJudge judge_;
  std::vector<Snapshot> starts_, good_;  ///< by world; good: last good states
  std::unique_ptr<fast::Worlds> worlds_;
  std::optional<compare::WorldsWriter> writer_;
  std::vector<double> step_ms_;
  std::size_t failed_ = 0;
  WorldsSummary summary_;
};

}  // namespace

void check_worlds(const RunRequest& request, int worlds) {
  const auto refuse = [](const std::string& option) {
    throw compare::InputError(option + " belongs to a run of one world; leave it or --worlds out");
  };
  if (worlds < 1) throw compare::InputError("--worlds " + std::to_string(worlds) + ": give at least 1");
  if (request.solver != "vbd") refuse("--solver " + request.solver);
  if (request.profile) refuse("--profile");
  if (request.iterations) refuse("--iterations");
  if (request.residual) refuse("--residual");
  if (request.ledger) refuse("--ledger");
  if (request.meetings) refuse("--audit-meetings");
  if (request.tolerate_start) refuse("--tolerate-start");
  if (request.from_state) refuse("--from-state");
  if (!request.show.empty()) refuse("--show");
}

WorldsSummary run_worlds(RunRequest request, int worlds) {
  check_worlds(request, worlds);
  return WorldsSession(std::move(request), worlds).run();
}

Json to_json(const WorldsSummary& summary) {
  Json worlds = Json::array();
  for (const compare::WorldRow& row : summary.worlds) {
    Json world{{"world", row.world},
               {"status", row.status},
               {"last_step", row.last_step},
               {"vertex_facet_contacts", row.vertex_facet_contacts},
               {"edge_edge_contacts", row.edge_edge_contacts},
               {"detections", row.detections},
               {"smallest_distance", row.smallest_distance},
               {"final_hash", row.final_hash}};
    if (row.jitter_seed > 0) world["jitter_seed"] = row.jitter_seed;
    if (!row.failure.empty()) world["failure"] = row.failure;
    worlds.push_back(std::move(world));
  }
  return {{"scene", summary.scene},
          {"scale", summary.scale},
          {"backend", summary.backend},
          {"device", summary.device},
          {"folder", summary.folder},
          {"status", summary.status},
          {"steps", summary.steps},
          {"failed", summary.failed},
          {"memory_megabytes", summary.megabytes},
          {"step_ms", summary.step_ms},
          {"audited_states", summary.audited_states},
          {"seconds",
           {{"whole", summary.whole_seconds},
            {"start", summary.start_seconds},
            {"steps", summary.step_seconds},
            {"audits", summary.audit_seconds}}},
          {"worlds", std::move(worlds)}};
}

std::string describe(const WorldsSummary& summary) {
  std::string text = counted(summary.worlds.size(), "world") + " of " + summary.scene + " on " + summary.device + ": " +
                     summary.status + " after step " + std::to_string(summary.steps) + "\n";
  for (const compare::WorldRow& row : summary.worlds)
    if (!row.failure.empty())
      text += "  " + name_of(row.world) + ", last good step " + std::to_string(row.last_step) + ": " + row.failure +
              "\n";
  std::int64_t least = std::numeric_limits<std::int64_t>::max(), most = 0;
  std::size_t kept = 0;
  for (const compare::WorldRow& row : summary.worlds) {
    const std::int64_t contacts = row.vertex_facet_contacts + row.edge_edge_contacts;
    least = std::min(least, contacts);
    most = std::max(most, contacts);
    kept += row.audited_states;
  }
  text += "  a step of all worlds: " + number(summary.step_ms) + " ms (median)\n" +
          "  contacts of a world at the end: " + std::to_string(least) + " to " + std::to_string(most) + "\n" +
          "  audits: " + std::to_string(kept) + " of " + counted(summary.audited_states, "state") +
          " without a finding\n" + "  seconds: " + number(summary.whole_seconds) + " in all, " +
          number(summary.start_seconds) + " until the first step, " + number(summary.step_seconds) + " steps, " +
          number(summary.audit_seconds) + " audits\n" + "  " + summary.folder + "/worlds.csv";
  return text;
}

}  // namespace ogc::experiments
