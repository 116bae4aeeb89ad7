#include "experiments/program/runs/solvers.hpp"

#include <algorithm>
#include <array>

#include "compare/problem/error.hpp"
#include "fast/contestant.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {
namespace {

constexpr std::array<std::string_view, 4> names{"vbd", "newton", "reference_vbd", "ipc"};

/// The fast path's colours, so that both go through the vertices in one order: from the trace of a step of one
/// iteration.
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
                              "ipc (Incremental Potential Contact), reference_vbd (vbd in double, slow)");
  return static_cast<Solver>(found - names.begin());
}

SolverOptions options_of(Solver solver) {
  switch (solver) {
    case Solver::vbd: return {.has_backends = true, .has_measured_residual = true, .has_traced_rows = true};
    case Solver::newton: return {.has_condition = true, .has_measured_residual = true};
    case Solver::reference_vbd: return {.has_measured_residual = true};
    case Solver::ipc: break;
  }
  return {};
}

compare::Contestant contestant_of(Solver solver, bool on_device) {
  switch (solver) {
    case Solver::vbd: break;
    case Solver::newton: return reference::newton();
    case Solver::reference_vbd: return reference::vbd(fast_colours);
    case Solver::ipc: return reference::ipc();
  }
  return fast::contestant(on_device ? fast::Backend::cuda : fast::Backend::cpu);
}

}  // namespace ogc::experiments
