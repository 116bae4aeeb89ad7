// Implements the public interface to a guard: checks the input, then calls the backend's engine.
#include "fast/guard.hpp"

#include <cmath>
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

std::string text_of(double value) { return compare::shortest(compare::as_typed(value)); }

void check(const GuardOptions& options) {
  const auto need = [](bool holds, const std::string& what) {
    if (!holds) throw compare::InputError("guard: " + what);
  };
  const float r = options.contact_radius, r_q = options.query_radius;
  need(r == 0 || (r >= least_radius && std::isfinite(r)),
       "contact_radius is " + text_of(r) + ", but 0 or a length of at least " + text_of(least_radius) + " m is needed");
  need(r_q >= least_radius && r_q <= most_query_radius, "query_radius is " + text_of(r_q) + ", but a length from " +
                                                            text_of(least_radius) + " to " +
                                                            text_of(most_query_radius) + " m is needed");
  need(r_q >= r, "query_radius is " + text_of(r_q) + ", but at least contact_radius, " + text_of(r) + ", is needed");
  need(options.bounds_relaxation > 0 && options.bounds_relaxation < 0.5F,
       "bounds_relaxation is " + text_of(options.bounds_relaxation) + ", but it must lie between 0 and 0.5");
  need(options.detection_fraction >= 0 && options.detection_fraction <= 1,
       "detection_fraction is " + text_of(options.detection_fraction) + ", but a share from 0 to 1 is needed");
  const compare::BoundsTraits bounds = compare::traits_of(options.bounds);
  need(bounds.certifies, "bounds 'off' prove nothing: choose ball or planes");
  need(!bounds.divides, "bounds 'dat' need displacements before each detection: choose ball or planes");
}

void check_proposals(std::span<const compare::Vec3f> positions, std::span<const compare::Vec3f> moves) {
  for (std::size_t v = 0; v < positions.size(); ++v) {
    const compare::Vec3f &x = positions[v], &d = moves[v];
    if (!std::isfinite(x.x + d.x) || !std::isfinite(x.y + d.y) || !std::isfinite(x.z + d.z))
      throw compare::InputError("moves: vertex " + std::to_string(v) + " has (" + text_of(d.x) + ", " + text_of(d.y) +
                                ", " + text_of(d.z) + "), which leads beyond the largest float");
  }
}

std::unique_ptr<GuardEngine> make_engine(Backend backend, const Mesh& mesh, const GuardOptions& options) {
  if (backend == Backend::cpu) return cpu_guard_engine(mesh, options);
#if defined(OGC_HAS_CUDA)
  return cuda_guard_engine(mesh, options);
#else
  throw compare::ResourceError("Guard: " + backend_info(Backend::cuda).description + ", or ask for Backend::cpu");
#endif
}

}  // namespace

Guard::Guard(Mesh mesh, std::span<const compare::Vec3f> positions, const GuardOptions& options, Backend backend)
    : mesh_(std::move(mesh)), options_(options) {
  check(options_);
  mesh_.check_positions("positions", positions);
  engine_ = make_engine(backend, mesh_, options_);
  engine_->reset(positions);
}

GuardReport Guard::step(std::span<const compare::Vec3f> positions, std::span<const compare::Vec3f> moves,
                        std::span<compare::Vec3f> out) {
  mesh_.check("positions", positions);
  mesh_.check("moves", moves);
  if (out.size() != positions.size())
    throw compare::InputError("out: room for " + std::to_string(out.size()) + " vectors, but the mesh has " +
                              std::to_string(positions.size()) + " vertices");
  check_proposals(positions, moves);
  return engine_->step(positions, moves, out);
}

GuardReport Guard::step_resident(const compare::Vec3f* positions, const compare::Vec3f* moves, compare::Vec3f* out) {
  return engine_->step_resident(positions, moves, out);
}

void Guard::detect() { engine_->detect(); }

void Guard::reset(std::span<const compare::Vec3f> positions) {
  mesh_.check_positions("positions", positions);
  engine_->reset(positions);
}

void Guard::reset_resident(const compare::Vec3f* positions) { engine_->reset_resident(positions); }

std::vector<compare::Vec3f> Guard::positions() const { return engine_->positions(); }

const compare::Vec3f* Guard::positions_resident() const { return engine_->positions_resident(); }

int Guard::device_number() const { return engine_->device_number(); }

void Guard::wait_for_device() { engine_->wait_for_device(); }

ContactView Guard::contacts() const { return engine_->contacts(); }

const compare::Vec3f* Guard::detected_at_resident() const { return engine_->detected_at_resident(); }

}  // namespace ogc::fast
