#include "experiments/program/runs/resume.hpp"

#include <charconv>

#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "compare/record/steps_csv.hpp"
#include "experiments/program/version.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

std::string text_in(const compare::Provenance& provenance, const std::string& key, const std::string& otherwise) {
  const auto entry = provenance.extra.find(key);
  return entry == provenance.extra.end() ? otherwise : entry->second;
}

namespace {

using compare::Provenance;

bool says_yes(const Provenance& provenance, const std::string& key) { return text_in(provenance, key) == "yes"; }

std::int64_t repeats_in(const std::string& folder, const Provenance& provenance) {
  const std::string text = text_in(provenance, "time_repeats");
  std::int64_t repeats = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), repeats);
  if (!text.empty() && (error != std::errc{} || end != text.data() + text.size() || repeats < 1))
    throw compare::InputError(folder + "/run.json: time_repeats is '" + compare::shown(text) +
                              "', which is no number of repetitions: it was changed by hand or is damaged");
  return repeats;
}

void check_end(const std::string& folder, const compare::RunReader& run) {
  if (run.provenance().status != "finished") return;
  throw compare::InputError(folder + ": is a finished run (" + std::to_string(run.scene().settings.steps) +
                            " steps), there is nothing to resume. For more steps " +
                            "begin a new run from its last frame: ogc run … --steps N --from-state " + folder +
                            "/frames/" + compare::frame_name(run.frame_step(run.frame_count() - 1)) + ".h5");
}

/// Throws if commit, compiler or toolkit differ, because other versions may compute other bits. Only warns of
/// uncommitted changes, because they have no version to compare.
void check_program(const std::string& folder, const Provenance& run) {
  const BuildInfo build = build_info();
  const auto same = [&](const std::string& what, const std::string& theirs, const std::string& ours) {
    if (theirs != ours)
      throw compare::InputError(folder + ": was computed by another program (" + what + " " + theirs +
                                ", this one: " + ours +
                                "), which may give other bits. Resume it with that one, or begin a new run from its "
                                "last frame with --from-state");
  };
  same("commit", run.commit, build.commit);
  same("with uncommitted changes:", run.dirty ? "yes" : "no", build.dirty ? "yes" : "no");
  same("compiler", run.compiler, build.compiler);
  same("CUDA", run.cuda, build.cuda);
  if (build.dirty)
    log_line(
        "the program was built with changes that are not committed: that they are those of the interrupted run can't "
        "be checked");
}

/// Throws if the CUDA device differs. The CPU and its number of threads may differ, because they change no bit.
void check_device(const std::string& folder, const Provenance& run) {
  if (run.backend != "cuda") return;
  const fast::BackendInfo here = fast::backend_info(fast::Backend::cuda);
  const std::string begin = folder + ": was computed on " + run.device + ", ",
                    remedy = "begin a new run from its last frame with --from-state";
  if (!here.usable)
    throw compare::ResourceError(begin + "and here " + here.description + ". Resume it there, or " + remedy +
                                 " and --backend cpu");
  if (!run.device.starts_with(here.description))  // how many devices divide the run follows, and changes no bit
    throw compare::InputError(begin + "this is " + here.description +
                              ": another device or driver may give other bits. Resume it there, or " + remedy);
}

/// Throws unless there is a row for each step up to the checkpoint, because the totals of the summary are counted from
/// these rows.
void check_rows(const std::filesystem::path& folder, std::int64_t step) {
  const std::vector<compare::StepMetrics> rows = compare::read_steps(folder, step).rows;
  bool whole = rows.empty() || rows.back().step == step;
  for (std::size_t i = 1; i < rows.size(); ++i) whole &= rows[i].step == rows[i - 1].step + 1;
  if (!whole)
    throw compare::InputError(
        (folder / "steps.csv").string() + ": has not every row up to the checkpoint's step " + std::to_string(step) +
        ": it was changed by hand or is damaged; begin a new run from the last frame with --from-state");
}

}  // namespace

ResumedRun resumed_run(const std::filesystem::path& folder) {
  const compare::Manifest manifest = compare::read_manifest(folder);
  if (manifest.provenance.status != "finished") {
    check_program(folder.string(), manifest.provenance);
    check_device(folder.string(), manifest.provenance);
    compare::expect_no_appender(folder / "steps.csv");
  }
  const compare::RunReader run(folder);
  const Provenance& provenance = run.provenance();
  check_end(folder.string(), run);
  ResumedRun resumed;
  resumed.options.solver = provenance.solver;
  resumed.options.backend = provenance.backend;
  resumed.options.iterations = says_yes(provenance, "iteration_rows");
  resumed.options.condition = says_yes(provenance, "condition_numbers");
  resumed.options.residual = says_yes(provenance, "residuals");
  resumed.options.ledger = says_yes(provenance, "ledger");
  resumed.options.repeats = repeats_in(folder.string(), provenance);
  RunRequest& request = resumed.request;
  request.scene = run.scene();
  request.tolerate_start = says_yes(provenance, "tolerate_start");
  request.scale = text_in(provenance, "scale");
  request.solver = provenance.solver;
  request.backend = provenance.backend;
  request.audit = audit_mode(text_in(provenance, "audit"));
  request.audit_beside = provenance.backend == "cuda";
  request.profile = !run.stage_names().empty();
  request.iterations = resumed.options.iterations;
  request.condition = resumed.options.condition;
  request.residual = resumed.options.residual;
  request.ledger = resumed.options.ledger;
  request.repeats = resumed.options.repeats;
  if (const std::string steps = text_in(provenance, "meetings"); !steps.empty())
    resumed.options.audit_meetings = text_of(request.meetings.emplace(step_range(steps)));
  request.folder = folder;
  request.resume = compare::read_checkpoint(folder, compare::scene_digest(folder));
  check_rows(folder, request.resume->state.step);
  return resumed;
}

}  // namespace ogc::experiments
