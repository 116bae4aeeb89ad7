#include "experiments/program/runs/solvers.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "compare/problem/error.hpp"
#include "compare/problem/readers.hpp"
#include "fast/contestant.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {
namespace {

constexpr std::array<std::string_view, 5> names{"vbd", "newton", "reference_vbd", "ipc", "penalty"};

/// Returns the colours of the fast path, from the trace of a step with one iteration. With these colours the
/// reference's VBD visits the vertices in the same order.
std::vector<compare::Index> fast_colours(const compare::Scene& scene) {
  compare::Scene once = scene;
  once.settings.iterations = once.settings.guess_rounds = 1;
  const compare::Topology topology = build_topology(once);
  return fast::contestant(fast::Backend::cpu).step({&once, &topology}).colour;
}

}  // namespace

std::span<const std::string_view> solver_names() { return names; }

Solver parse_solver(std::string_view name) {
  const auto found = std::ranges::find(names, name);
  if (found == names.end())
    throw compare::InputError("--solver " + std::string(name) +
                              " does not exist; there are: vbd (Vertex Block Descent with OGC contact), newton "
                              "(Newton's method with OGC contact), "
                              "ipc (Incremental Potential Contact), reference_vbd (vbd in double, slow), "
                              "penalty (Newton's method without bounds, line search or guarantee: a baseline)");
  return static_cast<Solver>(found - names.begin());
}

SolverOptions options_of(Solver solver) {
  switch (solver) {
    case Solver::vbd: return {.has_backends = true, .has_measured_residual = true, .has_traced_rows = true};
    case Solver::newton: return {.has_condition = true, .has_measured_residual = true};
    case Solver::reference_vbd: return {.has_measured_residual = true};
    case Solver::penalty: return {.has_measured_residual = true, .is_penalty = true};
    case Solver::ipc: break;
  }
  return {};
}

void require_settings(Solver solver, std::span<const std::string> assigned, compare::Settings& settings) {
  const std::string_view name = names[static_cast<std::size_t>(solver)];
  for (const compare::RequiredSetting& own : compare::required_settings()) {
    if (own.solver != name) continue;
    const std::string key(own.setting), given = key + "=" + std::string(own.value);
    for (const std::string& assignment : assigned)
      if (assignment.starts_with(key + "=") && assignment != given)
        throw compare::InputError("--set " + assignment + ": --solver " + std::string(name) + " has " + given +
                                  "; leave it out, or take --solver newton");
    compare::set_setting(settings, key, own.value);
  }
  compare::refuse_unread(settings, name);
}

compare::Contestant contestant_of(Solver solver, bool on_device, int devices) {
  switch (solver) {
    case Solver::vbd: break;
    case Solver::newton: return reference::newton();
    case Solver::reference_vbd: return reference::vbd(fast_colours);
    case Solver::ipc: return reference::ipc();
    case Solver::penalty: return reference::penalty();
  }
  return fast::contestant(on_device ? fast::Backend::cuda : fast::Backend::cpu, {.devices = devices});
}

}  // namespace ogc::experiments
