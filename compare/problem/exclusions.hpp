// Defines which pairs of faces are excluded (method.md §2.3). Excluded pairs are no contacts, do not enter d_min, and
// are not audited. The rules are data here; detections and audits apply them.
#pragma once

#include <span>
#include <vector>

#include "compare/problem/mesh.hpp"

namespace ogc::compare {

/// The excluded pairs of a mesh or scene.
struct Exclusions {
  /// Group of each vertex; may be empty. A pair is excluded if all of its vertices have the same number ≥ 0.
  std::vector<Index> groups;
  /// Partners of each vertex: row a has b, and row b has a, for each pair of partners. No rows if there are no
  /// partners. A pair of faces is excluded if a vertex of one face is a partner of a vertex of the other.
  CompressedRows partners{};
  friend bool operator==(const Exclusions& a, const Exclusions& b) {
    return a.groups == b.groups && a.partners.offsets == b.partners.offsets && a.partners.items == b.partners.items;
  }
};

/// Refers to exclusions that another object owns, which must outlive the view.
struct ExclusionView {
  std::span<const Index> groups;             ///< Exclusions::groups
  const CompressedRows* partners = nullptr;  ///< Exclusions::partners; null if there are none

  ExclusionView() = default;
  ExclusionView(std::span<const Index> by_group, const CompressedRows* by_partner = nullptr)
      : groups(by_group), partners(by_partner) {}
  ExclusionView(const std::vector<Index>& by_group) : groups(by_group) {}
  ExclusionView(const Exclusions& all)
      : groups(all.groups), partners(all.partners.rows() > 0 ? &all.partners : nullptr) {}
};

/// Returns the partners of each of `count` vertices: row a has b, and row b has a, for each of `pairs`. Rows are
/// ascending, without repetition; there are no rows if there are no pairs. Indices must be valid.
CompressedRows partner_rows(std::size_t count, std::span<const std::array<Index, 2>> pairs);

/// Returns the pairs in rows of partners, smaller vertex first, ascending.
std::vector<std::array<Index, 2>> pairs_of(const CompressedRows& partners);

}  // namespace ogc::compare
