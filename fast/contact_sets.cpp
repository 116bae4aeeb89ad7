// Implements the public interface to contact sets: checks the input, then calls the backend's engine.
#include "fast/contact_sets.hpp"

#include <string>
#include <utility>

#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "fast/cpu/cpu.hpp"
#if defined(OGC_HAS_CUDA)
#include "fast/cuda/cuda.hpp"
#endif

namespace ogc::fast {

namespace {

void check(const ContactQuery& query) {
  if (!(query.contact_radius > 0 && query.query_radius <= most_query_radius &&
        query.query_radius >= query.contact_radius)) {
    const auto text = [](float value) { return compare::shortest(compare::as_typed(static_cast<double>(value))); };
    throw compare::InputError("contact query: 0 < contact_radius <= query_radius <= " + text(most_query_radius) +
                              " is needed, not " + text(query.contact_radius) + " and " + text(query.query_radius));
  }
  if (!(query.bounds_relaxation > 0 && query.bounds_relaxation < 0.5F)) {
    throw compare::InputError("contact query: bounds_relaxation must lie between 0 and 0.5, not at " +
                              std::to_string(query.bounds_relaxation));
  }
}

std::unique_ptr<ContactEngine> make_engine(Backend backend, const compare::Topology& topology,
                                           const compare::ExclusionView& exclusions) {
  if (backend == Backend::cpu) return cpu_contact_engine(topology, exclusions);
#if defined(OGC_HAS_CUDA)
  return cuda_contact_engine(topology, exclusions);
#else
  throw compare::ResourceError("ContactFinder: " + backend_info(Backend::cuda).description +
                               ", or ask for Backend::cpu");
#endif
}

}  // namespace

ContactFinder::ContactFinder(Mesh mesh, Backend backend)
    : mesh_(std::move(mesh)), engine_(make_engine(backend, mesh_.topology(), mesh_.exclusions())) {}

ContactSets ContactFinder::find(std::span<const compare::Vec3f> positions, const ContactQuery& query) {
  check(query);
  mesh_.check("positions", positions);
  return engine_->find(positions, query);
}

ContactView ContactFinder::find_resident(const compare::Vec3f* positions, const ContactQuery& query) {
  check(query);
  return engine_->find_resident(positions, query);
}

ContactSets ContactFinder::find_at_resident(const compare::Vec3f* positions, const ContactQuery& query) {
  check(query);
  return engine_->find_at_resident(positions, query);
}

}  // namespace ogc::fast
