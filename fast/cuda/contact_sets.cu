// ContactFinder's engine on the device.
#include "fast/cuda/backend.cuh"
#include "fast/cuda/cuda.hpp"
#include "fast/probes/contact_engine.hpp"

namespace ogc::fast {

namespace {

/// Brings its own backend, as other people's solvers have none of ours.
class CudaContactEngine : public ContactEngine {
 public:
  CudaContactEngine(const compare::Topology& topology, const compare::ExclusionView& exclusions)
      : engine_(backend_, topology, exclusions) {}

  ContactSets find(std::span<const compare::Vec3f> positions, const ContactQuery& query) override {
    return engine_.find(positions, query);
  }
  ContactView find_resident(const compare::Vec3f* positions, const ContactQuery& query) override {
    return engine_.find_resident(positions, query);
  }

 private:
  CudaBackend backend_;
  BackendContactEngine<CudaBackend> engine_;
};

}  // namespace

std::unique_ptr<ContactEngine> cuda_contact_engine(const compare::Topology& topology,
                                                   const compare::ExclusionView& exclusions) {
  return std::make_unique<CudaContactEngine>(topology, exclusions);
}

}  // namespace ogc::fast
