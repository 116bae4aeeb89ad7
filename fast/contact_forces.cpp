// Implements the public interface to forces of contacts: checks the input, then calls the backend's engine.
#include "fast/contact_forces.hpp"

#include <cmath>
#include <limits>
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

std::string number_text(double value) { return compare::shortest(compare::as_typed(value)); }

void check(const ContactForceOptions& options) {
  const auto need_positive = [](const char* name, double value, const char* unit) {
    if (!(value > 0 && std::isfinite(value)))
      throw compare::InputError(std::string("contact forces: ") + name + " is " + number_text(value) +
                                ", but a positive number " + unit + " is needed");
  };
  need_positive("contact_radius", options.contact_radius, "[m]");
  need_positive("contact_stiffness", options.contact_stiffness, "[N/m]");
  need_positive("friction_velocity", options.friction_velocity, "[m/s]");
  if (!(options.friction >= 0 && std::isfinite(options.friction)))
    throw compare::InputError("contact forces: friction is " + number_text(options.friction) +
                              ", but 0 or a positive number is needed");
}

void check_colours(std::span<const compare::Index> colours, compare::Index vertices) {
  if (colours.empty()) return;
  if (colours.size() != static_cast<std::size_t>(vertices))
    throw compare::InputError("colours: " + std::to_string(colours.size()) + " numbers for " +
                              std::to_string(vertices) + " vertices: give one for each vertex, or none at all");
  for (std::size_t v = 0; v < colours.size(); ++v)
    if (colours[v] < 0)
      throw compare::InputError("colours: vertex " + std::to_string(v) + " has " + std::to_string(colours[v]) +
                                ", but a colour is 0 or positive");
}

void check_contacts(const FoundContacts& contacts, compare::Index vertices) {
  if (vertices > 0 && (contacts.view.incidence_offsets == nullptr || contacts.detected_at == nullptr))
    throw compare::InputError(
        "contacts: no contacts of a detection: pass those of ContactFinder::find_resident or Guard::contacts, and the "
        "positions of their detection");
}

/// ε_v h must be a normal float, because forces are divided by it.
void check_step(double time_step, double friction_velocity) {
  const double limit = friction_velocity * time_step;
  if (!(time_step > 0 && limit >= std::numeric_limits<float>::min() && limit <= std::numeric_limits<float>::max()))
    throw compare::InputError("time_step is " + number_text(time_step) +
                              ", but with start positions a positive time [s] is needed, and its product with "
                              "friction_velocity, " +
                              number_text(friction_velocity) + ", must be a normal float");
}

std::unique_ptr<ContactForceEngine> make_engine(Backend backend, const Mesh& mesh, std::span<const compare::Vec3f> rest,
                                                const ContactForceOptions& options,
                                                std::span<const compare::Index> colours) {
  if (backend == Backend::cpu) return cpu_contact_force_engine(mesh, rest, options, colours);
#if defined(OGC_HAS_CUDA)
  return cuda_contact_force_engine(mesh, rest, options, colours);
#else
  throw compare::ResourceError("ContactForces: " + backend_info(Backend::cuda).description +
                               ", or ask for Backend::cpu");
#endif
}

}  // namespace

ContactForces::ContactForces(Mesh mesh, std::span<const compare::Vec3f> rest, const ContactForceOptions& options,
                             Backend backend, std::span<const compare::Index> colours)
    : mesh_(std::move(mesh)), options_(options) {
  check(options_);
  mesh_.check("rest", rest);
  check_colours(colours, mesh_.vertex_count());
  engine_ = make_engine(backend, mesh_, rest, options_, colours);
}

ContactForceSums ContactForces::evaluate(const FoundContacts& contacts, std::span<const compare::Vec3f> positions,
                                         const Sliding& sliding) {
  check_contacts(contacts, mesh_.vertex_count());
  mesh_.check("positions", positions);
  if (!sliding.start.empty()) {
    mesh_.check("start", sliding.start);
    check_step(sliding.time_step, options_.friction_velocity);
  }
  return engine_->evaluate(contacts, positions, sliding);
}

ContactEnergy ContactForces::evaluate_resident(const FoundContacts& contacts, const compare::Vec3f* positions,
                                               const SlidingResident& sliding, const ContactForceArrays& out) {
  check_contacts(contacts, mesh_.vertex_count());
  if (sliding.start != nullptr) check_step(sliding.time_step, options_.friction_velocity);
  return engine_->evaluate_resident(contacts, positions, sliding, out);
}

}  // namespace ogc::fast
