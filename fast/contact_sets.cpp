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
  const auto text = [](float value) { return compare::shortest(compare::as_typed(static_cast<double>(value))); };
  const auto need = [text](const char* name, float value, float least, float most) {
    if (!(value >= least && value <= most))
      throw compare::InputError(std::string(name) + " is " + text(value) + ", but a length from " + text(least) +
                                " to " + text(most) + " m is needed");
  };
  need("query_radius", query.query_radius, least_radius, most_query_radius);
  need("contact_radius", query.contact_radius, least_radius, query.query_radius);
  if (!(query.bounds_relaxation > 0 && query.bounds_relaxation < 0.5F))
    throw compare::InputError("bounds_relaxation is " + text(query.bounds_relaxation) +
                              ", but it must lie between 0 and 0.5");
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
  mesh_.check_positions("positions", positions);
  return engine_->find(positions, query);
}

ContactView ContactFinder::find_resident(const compare::Vec3f* positions, const ContactQuery& query) {
  check(query);
  return engine_->find_resident(positions, query);
}

ContactColumns ContactFinder::find_columns(std::span<const compare::Vec3f> positions, const ContactQuery& query) {
  check(query);
  mesh_.check_positions("positions", positions);
  return engine_->find_columns(positions, query);
}

ContactColumns ContactFinder::find_columns_resident(const compare::Vec3f* positions, const ContactQuery& query) {
  check(query);
  return engine_->find_columns_resident(positions, query);
}

}  // namespace ogc::fast
