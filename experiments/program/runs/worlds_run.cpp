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

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Runs worlds and writes their folder.
class WorldsSession {
 public:
  WorldsSession(RunRequest request, std::vector<World> worlds)
      : request_(checked(std::move(request))), given_(std::move(worlds)) {
    expect_memory(given_.size());
    judges_.push_back(std::make_unique<StateJudge>(request_.scene, request_.sources));
    starts_.resize(given_.size());
    for (std::size_t w = 0; w < starts_.size(); ++w) {
      check_world(w);
      begin_world(w);
    }
  }

  WorldsSummary run() {
    worlds_ = fast::start_worlds(backend(), take_scenes());
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

  /// Checks the scene of a world that has settings of its own, and makes its judge, because bounds depend on settings.
  void check_world(std::size_t w) {
    World& world = given_[w];
    if (has_own_scene(w)) {
      try {
        check_scene(world.scene, request_.sources);
      } catch (const compare::InputError& error) {
        throw compare::InputError(world.name + ": " + error.what());
      }
      judges_.resize(w + 1);
      judges_[w] = std::make_unique<StateJudge>(world.scene, request_.sources);
    }
    const compare::Settings& settings = has_own_scene(w) ? world.scene.settings : request_.scene.settings;
    ends_.push_back(settings.steps);
    time_steps_.push_back(settings.time_step);
  }
  bool has_own_scene(std::size_t w) const { return !given_[w].settings.empty(); }
  const StateJudge& judge(std::size_t w) const { return *judges_[has_own_scene(w) ? w : 0]; }

  /// Returns the scenes of the worlds. Only the start reads them, so the worlds keep none.
  std::vector<compare::Scene> take_scenes() {
    std::vector<compare::Scene> scenes;
    for (std::size_t w = 0; w < given_.size(); ++w)
      scenes.push_back(has_own_scene(w) ? std::exchange(given_[w].scene, {}) : request_.scene);
    return scenes;
  }

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
    row.settings = given_[w].settings;
    if (request_.jitter.largest > 0) {
      const Jitter own{request_.jitter.largest, given_[w].jitter_seed};
      row.jitter_seed = own.seed;
      add_jitter(own, request_.scene, start.positions);
    } else if (w > 0) {
      return;  // the start of world 0
    }
    const compare::AuditResult result = judge(w).audit(start.positions);
    if (result.count > 0)
      throw compare::InputError("the scene '" + request_.scene.name + "' starts with " +
                                counted(result.count, "intersection") + " in " + given_[w].name +
                                "; no method that starts from a penetration can promise to have none. Move these "
                                "apart:\n" +
                                judge(w).describe(result));
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
    const std::int64_t last = std::ranges::max(ends_);
    Progress progress(0, last, "step");
    std::int64_t step = 0;
    while (step < last && !interrupted() && failed_ < starts_.size()) {
      const std::int64_t steps = chunk(step);
      const Clock::time_point begin = Clock::now();
      const auto rows = worlds_->advance(steps_of(step, steps));
      const double seconds = seconds_since(begin);
      summary_.step_seconds += seconds;
      step_ms_.push_back(1000 * seconds / static_cast<double>(steps));
      step += steps;
      for (std::size_t w = 0; w < rows.size(); ++w) add_rows(w, rows[w]);
      take_states(step);
      progress.show(step, number(step_ms_.back()) + " ms a step of all worlds" +
                              (failed_ > 0 ? ", " + counted(failed_, "world") + " failed" : ""));
    }
    progress.end();
    summary_.steps = step;
    summary_.was_interrupted = step < last && failed_ < starts_.size();
  }

  /// Returns the number of steps until the next audit or the next end of a world.
  std::int64_t chunk(std::int64_t step) const {
    const std::int64_t frame = frame_steps(request_.scene.settings);
    std::int64_t steps = request_.audit == AuditMode::every ? 1 : frame - step % frame;
    for (const std::int64_t end : ends_)
      if (end > step) steps = std::min(steps, end - step);
    return steps;
  }
  /// Returns whether the states of all worlds are audited after this step; each world's last state is audited, too.
  bool is_audited(std::int64_t step) const {
    if (request_.audit == AuditMode::every) return true;
    return request_.audit == AuditMode::frame && step % frame_steps(request_.scene.settings) == 0;
  }
  /// Returns for each world how many of the `steps` steps behind `step` it does.
  std::vector<std::int64_t> steps_of(std::int64_t step, std::int64_t steps) const {
    std::vector<std::int64_t> all;
    for (std::size_t w = 0; w < ends_.size(); ++w) {
      const compare::WorldRow& row = summary_.worlds[w];
      all.push_back(row.failure.empty() && !worlds_->has_failed(row.world) && step < ends_[w] ? steps : 0);
    }
    return all;
  }

  void add_rows(std::size_t w, const std::vector<StepMetrics>& rows) {
    compare::WorldRow& world = summary_.worlds[w];
    if (!world.failure.empty() || good_[w].step == ends_[w]) return;
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
    log_line("ogc: " + given_[static_cast<std::size_t>(world.world)].name + ": " + failure);
  }

  /// Takes the state of each world that goes on, if an audit of it is due after this step, or that ends with it.
  void take_states(std::int64_t step) {
    for (std::size_t w = 0; w < starts_.size(); ++w)
      if (summary_.worlds[w].failure.empty() && step <= ends_[w] &&
          (is_audited(step) || step == ends_[w] || interrupted()))
        take_state(w);
  }

  /// Takes the state of a world, after its audit, as its last good one.
  void take_state(std::size_t w) {
    compare::WorldRow& world = summary_.worlds[w];
    Snapshot state = worlds_->snapshot(world.world);
    if (state.step == good_[w].step) return;
    if (request_.audit != AuditMode::off) {
      const Clock::time_point begin = Clock::now();
      const Verdict verdict = judge(w).judge(state);
      summary_.audit_seconds += seconds_since(begin);
      ++summary_.audited_states;
      const bool is_too_deep = request_.deepest && verdict.volumes.deepest > *request_.deepest;
      if (!verdict.kept() || is_too_deep)
        return fail(world, "the audit of step " + std::to_string(state.step) +
                               " failed; the last good state is kept:\n" + judge(w).describe(verdict));
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
      world.status = !world.failure.empty() ? "failed" : end.step < ends_[w] ? "interrupted" : "finished";
      ends.push_back({end.step, static_cast<double>(end.step) * time_steps_[w], end.positions, end.velocities,
                      end.bounds, end.orientations});
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
  std::vector<World> given_;  ///< by world; without scenes once they have started
  /// by world if worlds have settings of their own; else one for all
  std::vector<std::unique_ptr<StateJudge>> judges_;
  std::vector<std::int64_t> ends_;       ///< by world: number of its steps
  std::vector<double> time_steps_;       ///< by world [s]
  std::vector<Snapshot> starts_, good_;  ///< by world; good: last good states
  std::unique_ptr<fast::Worlds> worlds_;
  std::optional<compare::WorldsWriter> writer_;
  std::vector<double> step_ms_;
  std::size_t failed_ = 0;
  WorldsSummary summary_;
};

}  // namespace

void check_worlds(const RunRequest& request) {
  const auto refuse = [](const std::string& option) {
    throw compare::InputError(option +
                              " belongs to a run of one world; leave it out, or --worlds and --world-settings");
  };
  if (request.solver != "vbd") refuse("--solver " + request.solver);
  if (request.profile) refuse("--profile");
  if (request.iterations) refuse("--iterations");
  if (request.residual) refuse("--residual");
  if (request.ledger) refuse("--ledger");
  if (request.repeats > 0) refuse("--repeats " + std::to_string(request.repeats));
  if (request.meetings) refuse("--audit-meetings");
  if (request.tolerate_start) refuse("--tolerate-start");
  if (request.from_state) refuse("--from-state");
  if (!request.show.empty()) refuse("--show");
}

WorldsSummary run_worlds(RunRequest request, std::vector<World> worlds) {
  check_worlds(request);
  return WorldsSession(std::move(request), std::move(worlds)).run();
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
    for (const auto& [name, value] : row.settings) world["settings"][name] = value;
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
      text += "  world " + std::to_string(row.world) + ", last good step " + std::to_string(row.last_step) + ": " +
              row.failure + "\n";
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
