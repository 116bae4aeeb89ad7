#include "experiments/python/contacts.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "compare/problem/error.hpp"

namespace ogc::python {
namespace {

constexpr const char* no_cuda =
    "this package has no CUDA; install ogc-testbed-cu13 in place of ogc-testbed (experiments/python/wheels cuda makes "
    "it), or, with nvcc, in a checkout: pip install . -C cmake.define.OGC_CUDA=ON";

fast::Backend parse_backend(std::string_view name) {
  if (name == "cpu") return fast::Backend::cpu;
  if (name == "cuda") return fast::Backend::cuda;
  throw compare::InputError("backend: there is no '" + std::string(name) + "'; give \"cpu\" or \"cuda\"");
}

template <class Primitive>
compare::Index after_last(compare::Index count, std::span<const Primitive> primitives) {
  for (const Primitive& primitive : primitives) {
    const compare::Index last = std::ranges::max(primitive);
    if (last == std::numeric_limits<compare::Index>::max())
      throw compare::InputError("vertex number " + std::to_string(last) + " came; a mesh has at most as many vertices");
    count = std::max(count, last + 1);
  }
  return count;
}

}  // namespace

fast::BackendInfo backend_info(std::string_view name) {
  fast::BackendInfo info = fast::backend_info(parse_backend(name));
  if (!info.built) info.description = no_cuda;
  return info;
}

fast::Backend usable_backend(std::string_view name) {
  const fast::Backend backend = parse_backend(name);
  static const bool has_cuda = fast::backend_info(fast::Backend::cuda).built;
  if (backend == fast::Backend::cuda && !has_cuda) throw compare::ResourceError(std::string("backend: ") + no_cuda);
  return backend;
}

std::string in_terms_of_python(std::string message) {
  for (const auto& [name, ours] : {std::pair<std::string_view, const char*>{"positions: ", "x: "},
                                   {"moves: ", "dx: "},
                                   {"time_step ", "dt "},
                                   {"contact_radius", "radius"},
                                   {"bounds_relaxation", "relaxation"}}) {
    const std::size_t at = message.find(name);
    if (at == 0 || (at != std::string::npos && message[at - 1] == ' ')) message.replace(at, name.size(), ours);
  }
  return message;
}

fast::ContactColumns ContactFinder::find(std::span<const compare::Vec3f> positions, const fast::ContactQuery& query) {
  const std::lock_guard lock(busy_);
  return finder_.find_columns(positions, query).copied_to_host();
}

fast::ContactColumns ContactFinder::find_on_device(std::span<const compare::Vec3f> positions,
                                                   const fast::ContactQuery& query) {
  const std::lock_guard lock(busy_);
  expect_vertices("x", positions.size(), finder_.mesh());
  return finder_.find_columns_resident(positions.data(), query);
}

void expect_vertices(const char* argument, std::size_t count, const fast::Mesh& mesh) {
  if (count != compare::at(mesh.vertex_count()))
    throw compare::InputError(std::string(argument) + ": " + std::to_string(count) + " rows came for " +
                              std::to_string(mesh.vertex_count()) + " vertices");
}

Mesh::Mesh(std::span<const compare::Triangle> triangles, std::span<const compare::Edge> loose_edges,
           std::span<const compare::Index> groups, std::optional<compare::Index> vertex_count)
    : mesh_(vertex_count ? *vertex_count : after_last(after_last(0, triangles), loose_edges), triangles, loose_edges,
            groups) {}

ContactFinder& Mesh::finder(fast::Backend backend) {
  const std::lock_guard lock(making_);
  std::unique_ptr<ContactFinder>& finder = finders_[static_cast<std::size_t>(backend)];
  if (!finder) finder = std::make_unique<ContactFinder>(mesh_, backend);
  return *finder;
}

}  // namespace ogc::python
