#include "experiments/resume.hpp"

#include "compare/problem/error.hpp"
#include "experiments/version.hpp"

namespace ogc::experiments {

namespace {

using compare::Provenance;

std::string text_in(const Provenance& provenance, const std::string& key) {
  const auto entry = provenance.extra.find(key);
  return entry == provenance.extra.end() ? "" : entry->second;
}

bool says_yes(const Provenance& provenance, const std::string& key) { return text_in(provenance, key) == "yes"; }

void check_end(const std::string& folder, const compare::RunReader& run) {
  if (run.provenance().status != "finished") return;
  throw compare::InputError(folder + ": is a finished run (" + std::to_string(run.scene().settings.steps) + " steps), there is nothing to resume. For more steps " +
                            "begin a new run from its last frame: ogc run … --steps N --from-state " + folder + "/frames/" +
                            compare::frame_name(run.frame_step(run.frame_count() - 1)) + ".h5");
}

/// Another commit, compiler or toolkit may compute other bits. Changes that are not committed have no name: they are told.
void check_program(const std::string& folder, const Provenance& run) {
  const BuildInfo build = build_info();
  const auto same = [&](const std::string& what, const std::string& theirs, const std::string& ours) {
    if (theirs != ours)
      throw compare::InputError(folder + ": was computed by another program (" + what + " " + theirs + ", this one: " + ours +
                                "), which may give other bits. Resume it with that one, or begin a new run from its last frame with --from-state");
  };
  same("commit", run.commit, build.commit);
  same("with uncommitted changes:", run.dirty ? "yes" : "no", build.dirty ? "yes" : "no");
  same("compiler", run.compiler, build.compiler);
  same("CUDA", run.cuda, build.cuda);
  if (build.dirty) log_line("the program was built with changes that are not committed: that they are those of the interrupted run can't be checked");
}

}  // namespace

ResumedRun resumed_run(const std::filesystem::path& folder) {
  const compare::RunReader run(folder);
  const Provenance& provenance = run.provenance();
  check_end(folder.string(), run);
  check_program(folder.string(), provenance);
  ResumedRun resumed;
  resumed.options.solver = provenance.solver;
  resumed.options.backend = provenance.backend;
  resumed.options.iterations = says_yes(provenance, "iteration_rows");
  resumed.options.condition = says_yes(provenance, "condition_numbers");
  resumed.options.residual = says_yes(provenance, "residuals");
  RunRequest& request = resumed.request;
  request.scene = run.scene();
  request.scale = text_in(provenance, "scale");
  request.solver = provenance.solver;
  request.backend = provenance.backend;
  request.audit = audit_mode(text_in(provenance, "audit"));
  request.audit_beside = provenance.backend == "cuda";
  request.profile = !run.stage_names().empty();
  request.iterations = resumed.options.iterations;
  request.condition = resumed.options.condition;
  request.residual = resumed.options.residual;
  request.folder = folder;
  request.resume = compare::read_checkpoint(folder, compare::scene_digest(folder));
  return resumed;
}

}  // namespace ogc::experiments
