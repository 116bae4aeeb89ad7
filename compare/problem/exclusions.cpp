#include "compare/problem/exclusions.hpp"

#include <algorithm>

namespace ogc::compare {

CompressedRows partner_rows(std::size_t count, std::span<const std::array<Index, 2>> pairs) {
  CompressedRows rows;
  if (pairs.empty()) return rows;
  std::vector<std::array<Index, 2>> both;
  for (const auto& [a, b] : pairs) both.insert(both.end(), {{a, b}, {b, a}});
  std::sort(both.begin(), both.end());
  both.erase(std::unique(both.begin(), both.end()), both.end());
  rows.offsets.assign(count + 1, 0);
  for (const auto& [a, b] : both) {
    ++rows.offsets[static_cast<std::size_t>(a) + 1];
    rows.items.push_back(b);
  }
  for (std::size_t v = 0; v < count; ++v) rows.offsets[v + 1] += rows.offsets[v];
  return rows;
}

std::vector<std::array<Index, 2>> pairs_of(const CompressedRows& partners) {
  std::vector<std::array<Index, 2>> pairs;
  for (std::size_t v = 0; v < partners.rows(); ++v)
    for (const Index w : partners[v])
      if (static_cast<Index>(v) < w) pairs.push_back({static_cast<Index>(v), w});
  return pairs;
}

}  // namespace ogc::compare
