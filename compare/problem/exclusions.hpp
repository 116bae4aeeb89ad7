// Which pairs of faces are excluded (method.md §2.3): they are no contacts, do not enter d_min, and no audit looks at
// them. The rules stand here as data; detections and audits apply them.
#pragma once

#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"

namespace ogc::compare {

/// Which pairs of a mesh or scene are left out.
struct Exclusions {
  /// By vertex; may be empty. A pair whose vertices all carry one number ≥ 0 is left out.
  std::vector<Index> groups;
  /// By vertex, both ways; without rows where there are none. A pair is left out where a vertex of one side is a
  /// partner of a vertex of the other.
  CompressedRows partners{};
  friend bool operator==(const Exclusions& a, const Exclusions& b) {
    return a.groups == b.groups && a.partners.offsets == b.partners.offsets && a.partners.items == b.partners.items;
  }
};

/// The same, owned by somebody else, who must outlive it.
struct ExclusionView {
  std::span<const Index> groups;             ///< as in Exclusions
  const CompressedRows* partners = nullptr;  ///< null: there are none

  ExclusionView() = default;
  ExclusionView(std::span<const Index> by_group, const CompressedRows* by_partner = nullptr)
      : groups(by_group), partners(by_partner) {}
  ExclusionView(const std::vector<Index>& by_group) : groups(by_group) {}
  ExclusionView(const Exclusions& all)
      : groups(all.groups), partners(all.partners.rows() > 0 ? &all.partners : nullptr) {}
};

/// Rows of partners of `count` vertices, each pair both ways, ascending and without repetition; without rows where
/// there is no pair. Indices are valid.
CompressedRows partner_rows(std::size_t count, std::span<const std::array<Index, 2>> pairs);

/// The pairs of such rows, smaller vertex first, ascending.
std::vector<std::array<Index, 2>> pairs_of(const CompressedRows& partners);

}  // namespace ogc::compare
