// The stages instantiated for the device, for the judge and for ContactFinder.
#include "fast/stages/probes.hpp"

#include <memory>

#include "fast/cuda/backend.cuh"
#include "fast/cuda/cuda.hpp"

namespace ogc::fast {
namespace {

/// An engine with a backend, and so a stream, of its own.
class CudaContactEngine : public ContactEngine {
 public:
  CudaContactEngine(const compare::Topology& topology, std::span<const compare::Index> rigid_groups) : engine_(backend_, topology, rigid_groups) {}

  ContactSets find(std::span<const compare::Vec3f> positions, const ContactQuery& query) override { return engine_.find(positions, query); }
  ContactView find_resident(const compare::Vec3f* positions, const ContactQuery& query) override { return engine_.find_resident(positions, query); }

 private:
  CudaBackend backend_;
  BackendContactEngine<CudaBackend> engine_;
};

}  // namespace

compare::Contestant cuda_contestant() {
  compare::Contestant contestant = probe_contestant("cuda", std::make_shared<CudaBackend>());
  contestant.start = [](const compare::Scene& scene, const compare::SimulationOptions& options) { return start_cuda(scene, options); };
  return contestant;
}

std::unique_ptr<ContactEngine> cuda_contact_engine(const compare::Topology& topology, std::span<const compare::Index> rigid_groups) {
  return std::make_unique<CudaContactEngine>(topology, rigid_groups);
}

}  // namespace ogc::fast
