// Instantiates the stages, the resident simulation and the engines of outside solvers for the host's threads. They
// share one source, because they run the same kernels. update_vertices.cpp has the updates of vertices.
#include <string>
#include <utility>

#include <tbb/info.h>
#include <tbb/task_arena.h>

#include "fast/cpu/backend.hpp"
#include "fast/cpu/cpu.hpp"
#include "fast/cpu/simulation.hpp"
#include "fast/probes/contact_force_engine.hpp"
#include "fast/probes/guard_engine.hpp"
#include "fast/probes/probes.hpp"
#include "fast/stages/parted.hpp"
#include "fast/stages/simulation.hpp"

namespace ogc::fast {

BackendInfo cpu_info() { return {true, true, std::to_string(tbb::info::default_concurrency()) + " threads"}; }

compare::Contestant cpu_contestant(int parts) {
  compare::Contestant contestant = probe_contestant("cpu", std::make_shared<CpuBackend>());
  contestant.start = [parts](const compare::Scene& scene, const compare::SimulationOptions& options) {
    return parts > 1 ? start_cpu_parts(scene, options, parts) : start_cpu(scene, options);
  };
  return contestant;
}

namespace {

std::string threads_in_words() {
  const int threads = tbb::this_task_arena::max_concurrency();
  return std::to_string(threads) + (threads == 1 ? " thread" : " threads");
}

}  // namespace

std::unique_ptr<compare::Simulation> start_cpu_parts(const compare::Scene& scene,
                                                     const compare::SimulationOptions& options, int parts,
                                                     int list_capacity) {
  const auto enter = [](int) {};
  return std::make_unique<PartedSimulation<CpuBackend, decltype(enter)>>(
      parts, enter, [](int) { return CpuBackend{}; }, scene, options, threads_in_words(), list_capacity);
}

std::unique_ptr<compare::Simulation> start_cpu(const compare::Scene& scene, const compare::SimulationOptions& options,
                                               int list_capacity) {
  return std::make_unique<ResidentSimulation<CpuBackend>>(CpuBackend{}, scene, options, threads_in_words(),
                                                          list_capacity);
}

namespace {

/// Returns the backend of all engines of outside solvers. Several threads may use it, since no engine calls `replay`.
CpuBackend& shared_backend() {
  static CpuBackend backend;
  return backend;
}

}  // namespace

std::unique_ptr<ContactEngine> cpu_contact_engine(const compare::Topology& topology,
                                                  const compare::ExclusionView& exclusions) {
  return std::make_unique<BackendContactEngine<CpuBackend>>(shared_backend(), topology, exclusions);
}

std::unique_ptr<GuardEngine> cpu_guard_engine(const Mesh& mesh, const GuardOptions& options) {
  return std::make_unique<BackendGuardEngine<CpuBackend>>(shared_backend(), mesh, options);
}

std::unique_ptr<ContactForceEngine> cpu_contact_force_engine(const Mesh& mesh, std::span<const compare::Vec3f> rest,
                                                             const ContactForceOptions& options,
                                                             std::span<const compare::Index> colours) {
  return std::make_unique<BackendContactForceEngine<CpuBackend>>(shared_backend(), mesh, rest, options, colours);
}

}  // namespace ogc::fast
