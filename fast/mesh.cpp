// Checks the connectivity that a solver outside this project gives, and the vectors that it passes later.
#include "fast/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

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

void check_exclusions(const compare::ExclusionView& exclusions, compare::Index vertex_count) {
  const auto check_rows = [&](const char* what, std::size_t rows) {
    if (rows != 0 && rows != static_cast<std::size_t>(vertex_count))
      throw compare::InputError(std::string(what) + " has " + std::to_string(rows) + " entries for " +
                                std::to_string(vertex_count) + " vertices: give one for each, or none at all");
  };
  check_rows("exclusions: groups", exclusions.groups.size());
  if (exclusions.partners == nullptr) return;
  check_rows("exclusions: partners", exclusions.partners->rows());
  for (const compare::Index v : exclusions.partners->items)
    if (v < 0 || v >= vertex_count)
      throw compare::InputError("exclusions: partners names vertex " + std::to_string(v) + ", but the mesh has " +
                                std::to_string(vertex_count) + " vertices");
}

std::string number_text(float c) { return compare::shortest(compare::as_typed(static_cast<double>(c))); }

/// Throws compare::InputError for the first vector with a coordinate that is not `good`.
template <class Good>
void refuse_first(std::string_view argument, std::span<const compare::Vec3f> vectors, Good good,
                  const std::string& why) {
  const auto bad = std::find_if_not(vectors.begin(), vectors.end(),
                                    [good](const compare::Vec3f& a) { return good(a.x) && good(a.y) && good(a.z); });
  if (bad != vectors.end())
    throw compare::InputError(std::string(argument) + ": vertex " + std::to_string(bad - vectors.begin()) + " has (" +
                              number_text(bad->x) + ", " + number_text(bad->y) + ", " + number_text(bad->z) + "), " +
                              why);
}

}  // namespace

Mesh::Mesh(compare::Index vertex_count, std::span<const compare::Triangle> triangles,
           std::span<const compare::Edge> loose_edges, const compare::ExclusionView& exclusions) {
  if (vertex_count < 0)
    throw compare::InputError("mesh: the number of vertices is " + std::to_string(vertex_count) +
                              ", but it cannot be negative");
  check_primitives(triangles, vertex_count, "triangle");
  check_primitives(loose_edges, vertex_count, "loose edge");
  check_exclusions(exclusions, vertex_count);
  compare::Exclusions own{.groups = {exclusions.groups.begin(), exclusions.groups.end()}};
  if (exclusions.partners != nullptr) own.partners = *exclusions.partners;
  data_ = std::make_shared<const Data>(
      Data{compare::build_topology(vertex_count, triangles, loose_edges), std::move(own)});
}

void Mesh::check(std::string_view argument, std::span<const compare::Vec3f> vectors) const {
  if (vectors.size() != static_cast<std::size_t>(vertex_count()))
    throw compare::InputError(std::string(argument) + ": " + std::to_string(vectors.size()) + " vectors for " +
                              std::to_string(vertex_count()) + " vertices: give one for each vertex");
  refuse_first(
      argument, vectors, [](float c) { return std::isfinite(c); }, "which is not finite");
}

void Mesh::check_positions(std::string_view argument, std::span<const compare::Vec3f> positions) const {
  check(argument, positions);
  refuse_first(
      argument, positions, [](float c) { return std::abs(c) <= most_coordinate; },
      "but coordinates from " + number_text(-most_coordinate) + " to " + number_text(most_coordinate) +
          " m are needed");
}

}  // namespace ogc::fast
