// Implements the public interface to contact sets: checks the input, then calls the backend's engine.
#include "fast/contact_sets.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "compare/problem/error.hpp"
#include "fast/cpu/cpu.hpp"
#if defined(OGC_HAS_CUDA)
#include "fast/cuda/cuda.hpp"
#endif

namespace ogc::fast {

namespace {

template <std::size_t N>
void check_primitives(std::span<const std::array<compare::Index, N>> primitives, compare::Index vertex_count,
                      const std::string& kind) {
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    for (std::size_t k = 0; k < N; ++k) {
      const compare::Index v = primitives[i][k];
      if (v < 0 || v >= vertex_count) {
        throw compare::InputError(kind + " " + std::to_string(i) + " names vertex " + std::to_string(v) +
                                  ", but the mesh has " + std::to_string(vertex_count) + " vertices");
      }
      if (v == primitives[i][(k + 1) % N]) {
        throw compare::InputError(kind + " " + std::to_string(i) + " names vertex " + std::to_string(v) +
                                  " twice: remove it or merge differently");
      }
    }
  }
}

void check(const ContactQuery& query) {
  if (!(query.contact_radius > 0 && std::isfinite(query.query_radius) && query.query_radius >= query.contact_radius)) {
    throw compare::InputError("contact query: 0 < contact_radius <= query_radius < infinity is needed, not " +
                              std::to_string(query.contact_radius) + " and " + std::to_string(query.query_radius));
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

ContactFinder::ContactFinder(compare::Index vertex_count, std::span<const compare::Triangle> triangles,
                             std::span<const compare::Edge> loose_edges, Backend backend,
                             const compare::ExclusionView& exclusions) {
  check_primitives(triangles, vertex_count, "triangle");
  check_primitives(loose_edges, vertex_count, "loose edge");
  const auto check_rows = [&](const char* what, std::size_t rows) {
    if (rows != 0 && rows != static_cast<std::size_t>(vertex_count))
      throw compare::InputError(std::string(what) + " has " + std::to_string(rows) + " entries for " +
                                std::to_string(vertex_count) + " vertices: give one for each, or none at all");
  };
  check_rows("exclusions: groups", exclusions.groups.size());
  if (exclusions.partners != nullptr) check_rows("exclusions: partners", exclusions.partners->rows());
  topology_ = std::make_unique<const compare::Topology>(compare::build_topology(vertex_count, triangles, loose_edges));
  engine_ = make_engine(backend, *topology_, exclusions);
}

ContactSets ContactFinder::find(std::span<const compare::Vec3f> positions, const ContactQuery& query) {
  check(query);
  if (positions.size() != static_cast<std::size_t>(topology_->vertex_count)) {
    throw compare::InputError("contact query: " + std::to_string(positions.size()) + " positions for " +
                              std::to_string(topology_->vertex_count) + " vertices");
  }
  const auto bad = std::find_if_not(positions.begin(), positions.end(), [](const compare::Vec3f& x) {
    return std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z);
  });
  if (bad != positions.end()) {
    throw compare::InputError("contact query: the position of vertex " + std::to_string(bad - positions.begin()) +
                              " is not finite");
  }
  return engine_->find(positions, query);
}

ContactView ContactFinder::find_resident(const compare::Vec3f* positions, const ContactQuery& query) {
  check(query);
  return engine_->find_resident(positions, query);
}

}  // namespace ogc::fast
