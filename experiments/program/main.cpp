// The program `ogc`.
#include "experiments/plugins/worker.hpp"
#include "experiments/program/entry.hpp"

namespace {

using namespace ogc;
using experiments::CommandContext;

void add_commands(CLI::App& app, CommandContext& context) {
  experiments::add_scenes_command(app, context);
  experiments::add_run_command(app, context);
  experiments::add_ablate_command(app, context);
  experiments::add_contacts_command(app, context);
  experiments::add_audit_command(app, context);
  experiments::add_suggest_command(app, context);
  experiments::add_laws_command(app, context);
  experiments::add_compare_command(app, context);
  experiments::add_bench_command(app, context);
  experiments::add_export_command(app, context);
  experiments::add_view_command(app, context);
  experiments::add_illustrate_command(app, context);
  experiments::add_plugin_worker_command(app, context);
}

}  // namespace

int main(int count, char** words) {
  return experiments::run_program(
      count, words,
      {"ogc",
       "OGC Testbed: a reference and a fast path for Offset Geometric Contact, and a judge between them.\n"
       "Not the release of the paper's authors.",
       "Exit status: 0 success, 1 a check failed (mismatch, penetration), 2 wrong usage or bad input, 3 out of a "
       "resource,\n"
       "130 interrupted.\n\nStart with: ogc run cloth_on_sphere --scale smoke",
       add_commands});
}
