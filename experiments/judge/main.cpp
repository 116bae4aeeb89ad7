// The program `ogc-judge`, which the Python package starts: `ogc compare` without the reference's solvers, so that it
// needs no CHOLMOD.
#include "experiments/plugins/worker.hpp"
#include "experiments/program/entry.hpp"

namespace {

using namespace ogc::experiments;

void add_commands(CLI::App& app, CommandContext& context) {
  add_compare_command(app, context);
  add_plugin_worker_command(app, context);
}

}  // namespace

int main(int count, char** words) {
  return run_program(count, words,
                     {"ogc-judge", "OGC Testbed: the judge of stages of Offset Geometric Contact.",
                      "Start with: ogc-judge compare truncate --plugin mine.py", add_commands});
}
