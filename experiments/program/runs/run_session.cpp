#include "experiments/program/runs/run_session.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/problem/dust.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/validate.hpp"
#include "compare/record/steps_csv.hpp"
#include "experiments/bench/rank_test.hpp"
#include "experiments/program/audits/offenders.hpp"
#include "experiments/program/interrupt.hpp"
#include "experiments/program/progress.hpp"
#include "experiments/program/runs/resume.hpp"
#include "experiments/program/version.hpp"

namespace ogc::experiments {

namespace {

using compare::Snapshot;
using compare::StepMetrics;

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

constexpr std::int64_t any_step = std::numeric_limits<std::int64_t>::max();

}  // namespace

std::int64_t frame_steps(const compare::Settings& settings) {
  if (settings.frame_steps > 0) return settings.frame_steps;
  return std::max<std::int64_t>(1, std::llround(1 / (60 * settings.time_step)));
}

void check_scene(compare::Scene& scene, const compare::MeshSources& sources) {
  compare::round_to_single(scene);
  // A scene from a file contains no dust (tiny numbers in place of 0). Dust in the positions of a stored frame is kept.
  if (const std::string dust = describe(clear_dust(scene)); !dust.empty()) log_line("ogc: " + scene.name + ": " + dust);
  const std::string problems = compare::describe(compare::validate(scene, 10, compare::ElementNames(scene, sources)));
  if (!problems.empty()) throw compare::InputError("the scene '" + scene.name + "' can't be run:\n" + problems);
}

RunRequest checked(RunRequest request) {
  check_scene(request.scene, request.sources);
  if (!request.resume) compare::expect_new_run_folder(request.folder);
  return request;
}

compare::Provenance provenance(const RunRequest& request, const std::string& device) {
  const BuildInfo build = build_info();
  compare::Provenance run;
  run.solver = request.solver;
  run.backend = request.backend;
  run.device = device;
  run.command = request.command_line;
  run.version = build.version;
  run.commit = build.commit;
  run.compiler = build.compiler;
  run.cuda = build.cuda;
  run.dirty = build.dirty;
  run.origin = request.origin;
  run.status = "running";
  run.extra["scale"] = request.scale;
  run.extra["audit"] = name_of(request.audit);
  run.extra["iteration_rows"] = request.iterations ? "yes" : "no";
  run.extra["condition_numbers"] = request.condition ? "yes" : "no";
  run.extra["residuals"] = request.residual ? "yes" : "no";
  if (request.ledger) run.extra["ledger"] = "yes";
  if (request.repeats > 0) run.extra["time_repeats"] = std::to_string(request.repeats);
  if (request.meetings) run.extra["meetings"] = text_of(*request.meetings);
  if (request.tolerate_start) run.extra["tolerate_start"] = "yes";
  if (request.from_state) run.extra["from_state"] = request.from_state->string();
  if (request.jitter.largest > 0) {
    run.extra["jitter"] = compare::shortest(request.jitter.largest);
    run.extra["jitter_seed"] = std::to_string(request.jitter.seed);
  }
  return run;
}

static std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string step_failure(const StepMetrics& row) {
  const std::string where = " in step " + std::to_string(row.step);
  if (row.status & compare::step_not_finite)
    return "a position became infinite or not a number" + where +
           "; the last good state is kept. Try a smaller time_step, more iterations, or softer materials";
  if (row.status & compare::step_bound_violated)
    return "a vertex moved further than its bound" + where +
           ": the guarantee is broken; the last good state is kept. Please report it";
  if (row.status & compare::step_met)
    return counted(static_cast<std::size_t>(row.meetings), "pair") + " of faces met on the way" + where +
           ": the guarantee is broken; the last good state is kept. Please report it:\n" + joined(row.notes);
  if (row.status & compare::step_indefinite)
    return "Newton's matrix is not positive definite" + where +
           "; the last good state is kept. Set projection to clamp or absolute, or a smaller time_step";
  if (row.status & compare::step_not_converged && !row.notes.empty())
    return "the solver came to a standstill" + where + " (" + row.notes.back() +
           "); the last good state is kept. Try a smaller time_step";
  if (row.status & compare::step_not_converged)
    return "Newton's method did not converge" + where + ": residual " + number(row.residual) + " after " +
           counted(static_cast<std::size_t>(row.iterations), "iteration") +
           "; the last good state is kept. Try more newton_iterations, a larger newton_tolerance (0: do all iterations "
           "and go on), or a smaller time_step";
  return "";
}

RunSession::RunSession(RunRequest request, compare::Contestant contestant)
    : request_(checked(std::move(request))),
      settings_(request_.scene.settings),
      contestant_(std::move(contestant)),
      warnings_(request_.scene, parse_solver(request_.solver)),
      momentum_(request_.scene) {
  frame_steps_ = frame_steps(settings_);
  start_state();
  if (request_.tolerate_start) name_pairs();
  judge_with_pairs();
  summary_.has_volumes = judge_->has_volumes();
  if (!request_.resume) check_start();
}

void RunSession::open_folder() {
  start_simulation();
  if (request_.from_state || request_.resume || request_.jitter.largest > 0) simulation_->restore(start_);
  summary_.scene = request_.scene.name;
  summary_.scale = request_.scale;
  summary_.solver = request_.solver;
  summary_.backend = request_.backend;
  summary_.device = simulation_->device();
  summary_.folder = request_.folder.string();
  summary_.left_out_of_audits = left_out_of_audits(request_.scene);
  summary_.audit = request_.audit;
  summary_.asks_meetings = request_.meetings.has_value();
  summary_.is_unbounded = !traits_of(settings_.bounds).certifies;
  summary_.first_step = summary_.last_step = step_;
  summary_.smallest_distance = std::numeric_limits<double>::infinity();
  auditor_ = std::make_unique<Auditor>(*judge_, request_.audit_beside);
  last_good_ = start_;
  for (const std::string& warning : warnings_.list()) log_line("warning: " + warning);
  if (request_.resume) return reopen_folder();
  begin_folder();
}

void RunSession::begin_folder() {
  last_good_.bounds.assign(start_.positions.size(), 0);
  momentum_.begin_after(start_.step, start_.velocities);
  compare::Provenance origin = provenance(request_, summary_.device);
  origin.warnings = warnings_.list();
  writer_ = std::make_unique<compare::RunWriter>(
      request_.folder, request_.scene, origin,
      request_.profile ? simulation_->stage_names() : std::vector<std::string>{});
}

/// Continues the existing folder. The totals of the earlier part are counted from its rows.
void RunSession::reopen_folder() {
  writer_ = std::make_unique<compare::RunWriter>(request_.folder, request_.scene, step_,
                                                 request_.backend == "cpu" ? ", " + summary_.device : "");
  const std::vector<StepMetrics> rows = compare::read_steps(request_.folder).rows;
  if (!rows.empty()) summary_.first_step = rows.front().step - 1;
  // An interruption may have stored a frame that an uninterrupted run does not have.
  writer_->keep_frames([this](std::int64_t step) {
    return step == summary_.first_step || step % frame_steps_ == 0 || step == settings_.steps;
  });
  // The checkpoint's own frame is in the folder, with measures that a checkpoint does not have.
  if (is_frame(step_)) last_frame_ = step_;
  remember_starts(rows);
  count(rows);
  summary_.audited_states = static_cast<std::size_t>(request_.resume->audited_states);
  if (summary_.audited_states > 0) summary_.guarantee_kept = true;
  log_line("goes on after step " + std::to_string(step_) + " of " + std::to_string(settings_.steps));
}

/// Reads the velocities at the start of each step that follows a stored frame and did all guess rounds. Only in these
/// steps is the loss of momentum measured (MomentumShare). Reading every frame would take long.
void RunSession::remember_starts(const std::vector<StepMetrics>& rows) {
  const compare::RunReader reader(request_.folder);
  for (std::size_t i = 0; i < reader.frame_count(); ++i) {
    const auto next = std::ranges::find(rows, reader.frame_step(i) + 1, &StepMetrics::step);
    if (next != rows.end() && next->guess_rounds >= settings_.guess_rounds)
      momentum_.begin_after(reader.frame_step(i), reader.frame(i).velocities);
  }
}

RunSummary RunSession::run() {
  open_folder();
  try {
    if (!request_.resume) store_frame(last_good_);
    if (pairs_) write_pairs();
    save_checkpoint();
    writer_->flush();
    summary_.seconds.start = since_begun();
    simulate();
    finish();
  } catch (const std::exception& error) {
    summary_.status = std::string("failed: ") + error.what();
    try {
      writer_->give_up(summary_.status);
    } catch (const std::exception&) {
      // The first error is reported. Finished frames are readable whatever run.json contains.
    }
    throw;
  }
  return summary_;
}

/// Returns the number of steps until the next frame, audit or end, at most pace_.steps(). The division into chunks
/// changes no bit of the results.
std::int64_t RunSession::chunk() const {
  const std::int64_t to_state = request_.audit == AuditMode::every ? 1 : frame_steps_ - step_ % frame_steps_;
  return std::min({to_state, settings_.steps - step_, pace_.steps()});
}

bool RunSession::is_frame(std::int64_t step) const { return step % frame_steps_ == 0 || step == settings_.steps; }

/// Returns whether every run, also an uninterrupted one, submits the state of this step for an audit. Checkpoints and
/// early ends submit further states.
bool RunSession::is_planned(std::int64_t step) const { return request_.audit == AuditMode::every || is_frame(step); }

bool RunSession::is_checkpoint_due() const { return seconds_since(saved_at_) >= request_.checkpoint_seconds; }

void RunSession::simulate() {
  Progress progress(step_, settings_.steps, "step");
  while (step_ < settings_.steps && !failed() && !interrupted()) {
    if (!one_chunk()) break;
    const double recent = step_times_.empty() ? 0 : step_times_.back();
    const auto contacts = static_cast<std::size_t>(summary_.last_vertex_facet_contacts +
                                                   summary_.last_edge_edge_contacts);
    progress.show(step_, number(recent) + " ms a step, " + counted(contacts, "contact") +
                             ", frames written up to step " + std::to_string(writer_->written().last_step) +
                             (pairs_ ? ", " + std::to_string(pairs_->open()) + " of " +
                                           counted(pairs_->named(), "start pair") + " open"
                                     : ""));
  }
  progress.end();
  if (interrupted() && !failed()) {
    log_line("stops after step " + std::to_string(step_) +
             "; once more ends the program at once, and leaves what is written");
    offer_state(any_step);
  }
  const Clock::time_point begin = Clock::now();
  const std::vector<Verdict> verdicts = auditor_->finish();
  summary_.seconds.audits += seconds_since(begin);
  collect(verdicts);
}

/// Runs one chunk; returns false if the simulation can't continue.
bool RunSession::one_chunk() {
  const Clock::time_point begin = Clock::now();
  const std::vector<StepMetrics> rows = simulation_->advance(chunk());
  pace_.measured(static_cast<std::int64_t>(rows.size()), seconds_since(begin));
  add_rows(rows);
  const std::string broken = rows.empty() ? "the simulation did no step; please report it" : step_failure(rows.back());
  if (broken.empty()) {
    step_ = rows.back().step;
    // If another state still waits for its verdict, a due checkpoint does not cause a further audit: the waiting state
    // is saved when its verdict arrives.
    if (is_planned(step_) || (is_checkpoint_due() && offered_.empty())) offer_state(any_step);
  } else if (!rows.empty()) {
    // A failed step may or may not be committed, so the state after it is not offered.
    offer_state(rows.back().step);
  }
  collect(auditor_->take());
  if (!broken.empty() && !failed()) summary_.failure = broken;
  if (pairs_ && !failed() && is_frame(step_)) close_pairs();
  return !failed();
}

/// Offers the current state for an audit if it is new, finite and from a step before `before`.
void RunSession::offer_state(std::int64_t before) {
  Snapshot snapshot = simulation_->snapshot();
  step_ = snapshot.step;
  if (step_ <= offered_step_ || step_ >= before || !finite(snapshot)) return;
  offered_step_ = step_;
  if (is_frame(step_) || interrupted()) measures_[step_] = vertex_measures(*simulation_);
  // The loss of momentum is measured only in steps after a frame. An interrupted run has the same frames as an
  // uninterrupted run, so both runs report the same loss.
  if (is_frame(step_)) momentum_.begin_after(step_, snapshot.velocities);
  offer(std::move(snapshot));
}

void RunSession::add_rows(const std::vector<StepMetrics>& rows) {
  writer_->add_steps(rows);
  for (const StepMetrics& row : rows) {
    for (const std::string& note : row.notes) log_line(note);
    summary_.seconds.steps += row.wall_ms / 1000;
  }
  count(rows);
}

void RunSession::count(const std::vector<StepMetrics>& rows) {
  for (const StepMetrics& row : rows) {
    const std::optional<double> lost = momentum_.lost(row);
    if (lost) summary_.largest_momentum_lost = std::max(*lost, summary_.largest_momentum_lost.value_or(0));
    for (const std::string& warning : warnings_.look_at(row, lost)) log_line("warning: " + warning);
    step_times_.push_back(row.wall_ms);
    if (row.wall_ms > summary_.worst_ms) summary_.worst_ms = row.wall_ms, summary_.worst_step = row.step;
    summary_.last_vertex_facet_contacts = row.vertex_facet_contacts;
    summary_.last_edge_edge_contacts = row.edge_edge_contacts;
    summary_.most_contacts = std::max(summary_.most_contacts, row.vertex_facet_contacts + row.edge_edge_contacts);
    summary_.detections += row.broad_phases;
    summary_.discrete_detections += row.discrete_detections;
    summary_.continuous_detections += row.continuous_detections;
    summary_.guess_rounds += row.guess_rounds;
    summary_.iterations += row.iterations;
    summary_.repeats += row.repeats;
    summary_.largest_share_cut = std::max(summary_.largest_share_cut, row.share_cut);
    summary_.largest_lag = std::max(summary_.largest_lag, row.largest_lag);
    summary_.most_unresolved = std::max(summary_.most_unresolved, row.depth_unresolved);
    // The smallest distance is larger than all floats if no vertex has a bound, as in scenes with only volumes.
    if (row.smallest_distance < double{std::numeric_limits<float>::max()})
      summary_.smallest_distance = std::min(summary_.smallest_distance, row.smallest_distance);
    if (row.status & (compare::step_bound_violated | compare::step_met)) summary_.guarantee_kept = false;
    if (!(row.meetings > 0)) continue;
    if (summary_.first_meeting < 0) summary_.first_meeting = row.step;
    summary_.meetings += static_cast<std::int64_t>(row.meetings);
  }
}

void RunSession::offer(Snapshot snapshot) {
  if (request_.audit == AuditMode::off || (request_.audit == AuditMode::end && snapshot.step != settings_.steps))
    return accept(std::move(snapshot));
  submit(snapshot);
  offered_.push_back(std::move(snapshot));
}

/// Submits a state for its audit. On the CPU the audit is complete when this function returns. If the simulation runs
/// on a device, the function may wait for an earlier audit.
void RunSession::submit(const Snapshot& snapshot) {
  const Clock::time_point begin = Clock::now();
  auditor_->submit(snapshot);
  summary_.seconds.audits += seconds_since(begin);
}

void RunSession::accept(Snapshot snapshot) {
  last_good_ = std::move(snapshot);
  if (is_frame(last_good_.step)) store_frame(last_good_);
  if (is_checkpoint_due()) save_checkpoint();
}

/// Saves a checkpoint after the rows and frames up to its step, so that a run that continues from it misses none.
void RunSession::save_checkpoint() {
  if (last_good_.step == saved_step_) return;
  writer_->save({last_good_, static_cast<std::int64_t>(summary_.audited_states)});
  saved_step_ = last_good_.step;
  saved_at_ = Clock::now();
}

void RunSession::collect(const std::vector<Verdict>& verdicts) {
  for (const Verdict& verdict : verdicts) {
    Snapshot snapshot = std::move(offered_.front());
    offered_.pop_front();
    if (summary_.failed_states > 0) continue;
    ++(is_planned(snapshot.step) ? summary_.audited_states : unplanned_audits_);
    if (!summary_.guarantee_kept) summary_.guarantee_kept = true;
    count(verdict.volumes, verdict.step);
    const bool is_too_deep = request_.deepest && verdict.volumes.deepest > *request_.deepest;
    if (verdict.kept() && !is_too_deep) {
      accept(std::move(snapshot));
    } else {
      reject(verdict, snapshot);
    }
  }
}

void RunSession::count(const compare::VolumePenetration& penetration, std::int64_t step) {
  summary_.most_inside = std::max(summary_.most_inside, penetration.vertices_inside);
  summary_.most_edges_meeting = std::max(summary_.most_edges_meeting, penetration.edges_meeting);
  if (penetration.deepest <= summary_.deepest) return;
  summary_.deepest = penetration.deepest;
  summary_.deepest_step = step;
}

void RunSession::reject(const Verdict& verdict, const Snapshot& snapshot) {
  if (!verdict.kept()) summary_.guarantee_kept = false;
  ++summary_.failed_states;
  summary_.intersections += verdict.intersections.count;
  summary_.certificate_violations += verdict.motion.violations;
  summary_.unsafe_bounds += verdict.unsafe_bounds;
  compare::Mesh mesh = request_.scene.mesh;
  mesh.positions = compare::to_double(snapshot.positions);
  const std::filesystem::path file = request_.folder / ("failed_step_" + std::to_string(verdict.step) + ".ply");
  compare::write_mesh(file, mesh);
  const std::string state = "step_" + std::to_string(verdict.step);
  const std::string shown = verdict.intersections.count == 0
                                ? ""
                                : "\nintersections " + show(state, snapshot, verdict.intersections);
  summary_.failure = "the audit of step " + std::to_string(verdict.step) + " failed (" + file.string() +
                     "); the last good state is kept:" + shown + "\n" + judge_->describe(verdict);
  if (request_.deepest && verdict.volumes.deepest > *request_.deepest)
    summary_.failure += judge_->describe(verdict.volumes) + ", where --deepest allows " + number(*request_.deepest) +
                        " m\n";
}

void RunSession::store_frame(const Snapshot& snapshot) {
  if (snapshot.step == last_frame_) return;
  VertexMeasures measures = std::exchange(measures_[snapshot.step], {});
  measures_.erase(measures_.begin(), measures_.upper_bound(snapshot.step));
  writer_->add_frame({snapshot.step, static_cast<double>(snapshot.step) * settings_.time_step, snapshot.positions,
                      snapshot.velocities, snapshot.bounds, snapshot.orientations, std::move(measures.residual),
                      std::move(measures.cut)});
  last_frame_ = snapshot.step;
}

double RunSession::since_begun() const { return seconds_since(request_.begun); }

/// Copies the times to the summary and to run.json. The times exclude the last writing of run.json.
void RunSession::take_times() {
  RunSeconds& seconds = summary_.seconds;
  seconds.writing = writer_->waited_seconds();
  seconds.whole = since_begun();
  writer_->set_extra("whole_seconds", number(seconds.whole, 6));
  writer_->set_extra("start_seconds", number(seconds.start, 6));
  writer_->set_extra("step_seconds", number(seconds.steps, 6));
  writer_->set_extra("audit_seconds", number(seconds.audits, 6));
  writer_->set_extra("writing_seconds", number(seconds.writing, 6));
}

void RunSession::finish() {
  store_frame(last_good_);
  save_checkpoint();
  // A complete run counts only planned audits, so that interruptions do not change the count. A run that ends early
  // counts all.
  if (last_good_.step < settings_.steps) summary_.audited_states += unplanned_audits_;
  summary_.last_step = last_good_.step;
  summary_.final_hash = state_hash(last_good_.positions);
  summary_.was_interrupted = !failed() && step_ < settings_.steps;
  const std::string first_line = summary_.failure.substr(0, summary_.failure.find('\n'));
  summary_.status = failed() ? "failed: " + first_line : summary_.was_interrupted ? "interrupted" : "finished";
  summary_.median_ms = median(step_times_);
  if (step_times_.empty()) summary_.worst_ms = summary_.median_ms;
  for (const std::string& warning : warnings_.look_back()) log_line("warning: " + warning);
  const ForcesLeft& left = warnings_.forces_left();
  summary_.measured_steps = left.steps();
  summary_.left_residual = left.median_residual();
  summary_.left_held = left.median_held();
  summary_.warnings = warnings_.list();
  if (left.steps() > 0) writer_->set_extra("left_residual", number(left.median_residual(), 6));
  writer_->set_warnings(summary_.warnings);
  writer_->set_extra("final_hash", summary_.final_hash);
  if (pairs_) summary_.start_pairs = pairs_->named(), summary_.open_pairs = pairs_->open();
  writer_->set_extra("guarantee_kept", guarantee_text(summary_));
  writer_->set_extra("audited_states", std::to_string(summary_.audited_states));
  if (summary_.has_volumes) {
    writer_->set_extra("vertices_inside_at_start", std::to_string(summary_.inside_at_start));
    const auto checked = [&](std::string most) { return summary_.audited_states > 0 ? most : "not checked"; };
    writer_->set_extra("most_vertices_inside", checked(std::to_string(summary_.most_inside)));
    writer_->set_extra("deepest_m", checked(number(summary_.deepest, 6)));
    writer_->set_extra("most_edges_meeting_volumes", checked(std::to_string(summary_.most_edges_meeting)));
    writer_->set_extra("most_depth_unresolved", std::to_string(summary_.most_unresolved));
  }
  writer_->close();
  take_times();
  writer_->finish(summary_.status);
}

}  // namespace ogc::experiments
