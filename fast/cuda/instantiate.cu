// Instantiates the stages, the resident simulation and the engines of outside solvers for the device. They share one
// source, because they run the same kernels, which two sources would compile twice. update_vertices.cu has the updates
// of vertices, which take longest to compile.
#include <memory>

#include "fast/cuda/backend.cuh"
#include "fast/cuda/check.cuh"
#include "fast/cuda/cuda.hpp"
#include "fast/probes/contact_engine.hpp"
#include "fast/probes/contact_force_engine.hpp"
#include "fast/probes/guard_engine.hpp"
#include "fast/probes/probes.hpp"
#include "fast/stages/parted.hpp"
#include "fast/stages/simulation.hpp"

namespace ogc::fast {

compare::Contestant cuda_contestant(const LaunchShape& shape) {
  compare::Contestant contestant = probe_contestant("cuda", std::make_shared<CudaBackend>(shape),
                                                    [shape] { return CudaBackend(shape); });
  contestant.start = [parts = shape.devices](const compare::Scene& scene, const compare::SimulationOptions& options) {
    return parts > 1 ? start_cuda_parts(scene, options, parts) : start_cuda(scene, options);
  };
  return contestant;
}

namespace {

/// Makes a device current in the calling thread. The current device is the first part's.
struct EnterDevice {
  int first = 0, devices = 1;
  void operator()(int part) const { OGC_CUDA_CHECK(cudaSetDevice((first + part) % devices)); }
};

}  // namespace

std::unique_ptr<compare::Simulation> start_cuda_parts(const compare::Scene& scene,
                                                      const compare::SimulationOptions& options, int parts,
                                                      int list_capacity) {
  const BackendInfo info = cuda_info();
  if (!info.usable) throw compare::ResourceError(info.description + "; run with --backend cpu");
  EnterDevice enter;
  OGC_CUDA_CHECK(cudaGetDevice(&enter.first));
  OGC_CUDA_CHECK(cudaGetDeviceCount(&enter.devices));
  if (parts > enter.devices)
    throw compare::ResourceError(std::to_string(parts) + " devices are asked for, and this machine shows " +
                                 std::to_string(enter.devices) + ": ask for at most so many");
  return std::make_unique<PartedSimulation<CudaBackend, EnterDevice>>(
      parts, enter, [](int) { return CudaBackend{}; }, scene, options,
      info.description + ", " + std::to_string(parts) + " devices", list_capacity);
}

std::unique_ptr<compare::Simulation> start_cuda(const compare::Scene& scene, const compare::SimulationOptions& options,
                                                int list_capacity) {
  return std::make_unique<ResidentSimulation<CudaBackend>>(CudaBackend{}, scene, options, cuda_info().description,
                                                           list_capacity);
}

namespace {

/// A contact engine with its own backend, because an outside solver has none.
class CudaContactEngine : public ContactEngine {
 public:
  CudaContactEngine(const compare::Topology& topology, const compare::ExclusionView& exclusions)
      : engine_(backend_, topology, exclusions) {}

  ContactSets find(std::span<const compare::Vec3f> positions, const ContactQuery& query) override {
    return engine_.find(positions, query);
  }
  ContactView find_resident(const compare::Vec3f* positions, const ContactQuery& query) override {
    require_readable(backend_.device(), "positions", positions);
    return engine_.find_resident(positions, query);
  }
  ContactColumns find_columns(std::span<const compare::Vec3f> positions, const ContactQuery& query) override {
    return engine_.find_columns(positions, query);
  }
  ContactColumns find_columns_resident(const compare::Vec3f* positions, const ContactQuery& query) override {
    require_readable(backend_.device(), "positions", positions);
    return engine_.find_columns_resident(positions, query);
  }

 private:
  CudaBackend backend_;
  BackendContactEngine<CudaBackend> engine_;
};

/// The backend of an engine below: a base, so that it exists before the engine that refers to it.
struct OwnBackend {
  CudaBackend backend;
};

/// A guard engine with its own backend.
class CudaGuardEngine : OwnBackend, public BackendGuardEngine<CudaBackend> {
 public:
  CudaGuardEngine(const Mesh& mesh, const GuardOptions& options) : BackendGuardEngine(backend, mesh, options) {}

  void reset_resident(const compare::Vec3f* positions) override {
    require_readable(backend.device(), "positions", positions);
    BackendGuardEngine::reset_resident(positions);
  }
  GuardReport step_resident(const compare::Vec3f* positions, const compare::Vec3f* moves,
                            compare::Vec3f* out) override {
    require_readable(backend.device(), "positions", positions);
    require_readable(backend.device(), "moves", moves);
    require_readable(backend.device(), "out", out);
    return BackendGuardEngine::step_resident(positions, moves, out);
  }
};

/// An engine for forces of contacts with its own backend.
class CudaContactForceEngine : OwnBackend, public BackendContactForceEngine<CudaBackend> {
 public:
  CudaContactForceEngine(const Mesh& mesh, std::span<const compare::Vec3f> rest, const ContactForceOptions& options,
                         std::span<const compare::Index> colours)
      : BackendContactForceEngine(backend, mesh, rest, options, colours) {}

  ContactEnergy evaluate_resident(const FoundContacts& contacts, const compare::Vec3f* positions,
                                  const SlidingResident& sliding, const ContactForceArrays& out) override {
    require_readable(backend.device(), "detected_at", contacts.detected_at);
    require_readable(backend.device(), "positions", positions);
    require_readable(backend.device(), "start", sliding.start);
    require_readable(backend.device(), "force", out.force);
    require_readable(backend.device(), "friction", out.friction);
    require_readable(backend.device(), "block", out.block);
    return BackendContactForceEngine::evaluate_resident(contacts, positions, sliding, out);
  }
};

}  // namespace

std::unique_ptr<ContactEngine> cuda_contact_engine(const compare::Topology& topology,
                                                   const compare::ExclusionView& exclusions) {
  return std::make_unique<CudaContactEngine>(topology, exclusions);
}

std::unique_ptr<GuardEngine> cuda_guard_engine(const Mesh& mesh, const GuardOptions& options) {
  return std::make_unique<CudaGuardEngine>(mesh, options);
}

std::unique_ptr<ContactForceEngine> cuda_contact_force_engine(const Mesh& mesh, std::span<const compare::Vec3f> rest,
                                                              const ContactForceOptions& options,
                                                              std::span<const compare::Index> colours) {
  return std::make_unique<CudaContactForceEngine>(mesh, rest, options, colours);
}

}  // namespace ogc::fast
