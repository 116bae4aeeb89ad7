// Prepares the start of a run: its state, and pairs of faces that intersect there.
#include <algorithm>
#include <cmath>

#include "compare/files/bytes.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "experiments/program/audits/offenders.hpp"
#include "experiments/program/runs/run_session.hpp"

namespace ogc::experiments {

using compare::Snapshot;

namespace {

constexpr std::size_t most_told = 20;  ///< largest number of intersections that are listed for a tolerated start

}  // namespace

bool RunSession::finite(const Snapshot& snapshot) {
  return std::ranges::all_of(snapshot.positions, [](const compare::Vec3f& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  });
}

void RunSession::start_state() {
  start_.positions = compare::to_single(request_.scene.mesh.positions);
  start_.velocities = compare::to_single(request_.scene.velocities);
  start_.orientations = request_.scene.orientations;
  if (request_.from_state) {
    const std::string file = request_.from_state->string();
    compare::Frame frame = compare::read_frame(*request_.from_state);
    if (frame.positions.size() != start_.positions.size() || frame.velocities.size() != start_.positions.size())
      throw compare::InputError(file + ": holds " + std::to_string(frame.positions.size()) + " vertices, the scene '" +
                                request_.scene.name + "' has " + std::to_string(start_.positions.size()) +
                                "; give the scene and scale of the run that the frame comes from");
    if (frame.step >= settings_.steps)
      throw compare::InputError(file + ": is the state after step " + std::to_string(frame.step) +
                                ", and the run ends at step " + std::to_string(settings_.steps) +
                                "; give a larger --steps");
    start_.step = frame.step;
    start_.positions = std::move(frame.positions);
    start_.velocities = std::move(frame.velocities);
    start_.orientations = std::move(frame.orientations);
  }
  if (request_.resume)
    start_ = request_.resume->state;
  else
    add_jitter(request_.jitter, request_.scene, start_.positions);
  if (!finite(start_)) throw compare::InputError("the start holds a position that is not finite");
  step_ = offered_step_ = start_.step;
}

void RunSession::check_start() {
  const compare::AuditResult result = judge_->audit(start_.positions);
  if (judge_->has_volumes()) {
    const compare::VolumePenetration penetration = judge_->penetration(start_.positions);
    summary_.inside_at_start = penetration.vertices_inside;
    count(penetration, start_.step);
    if (penetration.vertices_inside > 0)
      log_line("ogc: " + request_.scene.name + " begins with " + judge_->describe(penetration) +
               "; they are pushed out");
  }
  if (pairs_) tell_pairs();
  if (result.count == 0) return;
  const std::string jittered = request_.jitter.largest > 0 ? ", moved by --jitter," : "";
  throw compare::InputError("the scene '" + request_.scene.name + "'" + jittered + " starts with " +
                            counted(result.count, "intersection") + " " + show("start", start_, result) +
                            "\nNo method that starts from a penetration can promise to have none. Move these apart, "
                            "or let them come apart by themselves with --tolerate-start:\n" +
                            judge_->describe(result));
}

void RunSession::tell_pairs() const {
  const compare::AuditResult& met = pairs_->at_start();
  if (met.count == 0) {
    log_line("ogc: " + request_.scene.name +
             " starts without an intersection: --tolerate-start has nothing to leave out");
    return;
  }
  compare::AuditResult listed = met;
  listed.intersections.resize(std::min(most_told, listed.intersections.size()));
  log_line("ogc: " + request_.scene.name + " starts with " + counted(met.count, "intersection") + " " +
           show("start", start_, met) + ". " + counted(pairs_->named(), "pair") +
           " of vertices are no contact, not bounded and not audited until they are apart:\n" +
           judge_->describe(listed));
}

/// Returns in words where a state's intersections lie, and either the .vtp file that shows them or the option that
/// writes it.
std::string RunSession::show(const std::string& name, const Snapshot& state, const compare::AuditResult& result) const {
  const compare::Topology topology = build_topology(request_.scene);
  const std::vector<compare::Vec3> positions = compare::to_double(state.positions);
  const std::string where = region_of(offenders_of(result, topology), topology, positions);
  if (request_.show.empty()) return where + " (to have them as a mesh add --show DIR)";
  return where + "\n" + show_offenders(request_.show, name, result, topology, positions);
}

/// Finds the pairs of vertices whose faces intersect at the start. If a run continues, reads its frames and closes the
/// pairs that have separated in one of them.
void RunSession::name_pairs() {
  if (!request_.resume) {
    pairs_.emplace(request_.scene, start_.positions);
    return count_pairs(start_.step);
  }
  const compare::RunReader run(request_.folder);
  for (std::size_t i = 0; i < run.frame_count() && run.frame_step(i) <= step_; ++i) {
    const std::int64_t step = run.frame_step(i);
    if (i > 0 && !is_frame(step)) continue;
    const compare::Frame frame = run.frame(i);
    if (i == 0)
      pairs_.emplace(request_.scene, frame.positions);
    else
      pairs_->close_apart(frame.positions);
    count_pairs(step);
  }
}

void RunSession::count_pairs(std::int64_t step) {
  pairs_csv_ += std::to_string(step) + "," + std::to_string(pairs_->open()) + "\n";
}

void RunSession::judge_with_pairs() {
  auditor_.reset();
  auto scene = pairs_ ? std::make_unique<compare::Scene>(pairs_->tolerant_scene()) : nullptr;
  judge_ = std::make_unique<StateJudge>(scene ? *scene : request_.scene, request_.sources);
  simulation_.reset();
  tolerant_scene_ = std::move(scene);
}

void RunSession::start_simulation() {
  simulation_ = contestant_.start(tolerant_scene_ ? *tolerant_scene_ : request_.scene,
                                  {.profile = request_.profile,
                                   .energies = true,
                                   .iterations = request_.iterations,
                                   .condition = request_.condition});
}

/// Closes the pairs that have separated at this frame. From the next step on, bounds prevent their faces from meeting.
void RunSession::close_pairs() {
  const Snapshot now = simulation_->snapshot();
  if (pairs_->close_apart(now.positions)) {
    collect(auditor_->finish());
    if (failed()) return;
    judge_with_pairs();
    start_simulation();
    simulation_->restore(now);
    auditor_ = std::make_unique<Auditor>(*judge_, request_.audit_beside);
  }
  count_pairs(step_);
  write_pairs();
}

/// Writes the whole file each time, so that it is readable if the run is killed.
void RunSession::write_pairs() const {
  compare::write_bytes(request_.folder / "start_pairs.csv", "step,open_pairs\n" + pairs_csv_);
}

}  // namespace ogc::experiments
