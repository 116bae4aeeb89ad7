#include "compare/oracle/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "compare/problem/error.hpp"

namespace ogc::compare {

namespace {

bool are_partners(std::span<const Index> first, std::span<const Index> second, const CompressedRows* partners) {
  if (partners == nullptr) return false;
  return std::any_of(first.begin(), first.end(), [&](Index v) {
    const std::span<const Index> row = (*partners)[static_cast<std::size_t>(v)];
    return std::any_of(second.begin(), second.end(),
                       [&](Index w) { return std::binary_search(row.begin(), row.end(), w); });
  });
}

}  // namespace

bool left_out(std::span<const Index> first, std::span<const Index> second, const ExclusionView& exclusions) {
  return std::find_first_of(first.begin(), first.end(), second.begin(), second.end()) != first.end() ||
         is_excluded(first, second, exclusions);
}

bool is_excluded(std::span<const Index> first, std::span<const Index> second, const ExclusionView& exclusions) {
  if (are_partners(first, second, exclusions.partners)) return true;
  if (exclusions.groups.empty()) return false;
  const auto group_of = [&](Index v) { return exclusions.groups[static_cast<std::size_t>(v)]; };
  const Index group = group_of(first[0]);
  const auto in_group = [&](Index v) { return group_of(v) == group; };
  return group >= 0 && std::all_of(first.begin(), first.end(), in_group) &&
         std::all_of(second.begin(), second.end(), in_group);
}

void check_state(const char* who, const Topology& topology, std::span<const Vec3> positions,
                 const ExclusionView& exclusions) {
  const auto expect = [&](std::size_t size, const char* what) {
    if (size != static_cast<std::size_t>(topology.vertex_count))
      throw InputError(std::string(who) + ": " + std::to_string(size) + " " + what + " for a mesh of " +
                       std::to_string(topology.vertex_count) + " vertices: pass one for each vertex");
  };
  expect(positions.size(), "positions");
  if (!exclusions.groups.empty()) expect(exclusions.groups.size(), "rigid groups");
  if (exclusions.partners != nullptr) expect(exclusions.partners->rows(), "rows of excluded partners");
  for (std::size_t v = 0; v < positions.size(); ++v)
    if (!std::isfinite(positions[v].x) || !std::isfinite(positions[v].y) || !std::isfinite(positions[v].z))
      throw InputError(
          std::string(who) + ": the position of vertex " + std::to_string(v) +
          " is not finite: NaN and infinity meet nothing and everything; take the last state that is finite");
}

}  // namespace ogc::compare
