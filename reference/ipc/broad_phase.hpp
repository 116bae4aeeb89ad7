// Preselects pairs by boxes. A box that holds both ends of a primitive's straight motion holds the whole motion.
#pragma once

#include <algorithm>

#include <tbb/parallel_for.h>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/box_tree.hpp"
#include "reference/solvers/potential.hpp"

namespace ogc::reference {

/// Returns the box that holds the motion of a primitive (given by its vertices), widened by `margin` [m].
template <class Vertices>
Box swept_box(const Vertices& vertices, const State& from, const State& to, double margin) {
  Box box;
  for (const compare::Index v : vertices)
    for (const State* x : {&from, &to})
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double c = (*x)[static_cast<std::size_t>(v)][axis];
        box.low[axis] = std::min(box.low[axis], c);
        box.high[axis] = std::max(box.high[axis], c);
      }
  return widened(box, margin);
}

/// Returns swept_box of each primitive.
template <class Primitives>
std::vector<Box> swept_boxes(const Primitives& primitives, const State& from, const State& to, double margin) {
  std::vector<Box> boxes(primitives.size());
  tbb::parallel_for(std::size_t{0}, boxes.size(),
                    [&](std::size_t i) { boxes[i] = swept_box(primitives[i], from, to, margin); });
  return boxes;
}

/// Returns whether two primitives form a candidate pair. They must share no vertex, they must not be in the same rigid
/// group, and the scene must not exclude the pair.
template <class First, class Second>
bool is_pair(const compare::ExclusionView& exclusions, const First& first, const Second& second) {
  return std::find_first_of(first.begin(), first.end(), second.begin(), second.end()) == first.end() &&
         !is_excluded(exclusions, first, second);
}

/// Returns the items that `count` queries find, in the order of the queries; query(i, found) appends the items of query
/// i to `found`. The result does not depend on the number of threads.
template <class Item, class Query>
std::vector<Item> found_by(std::size_t count, Query query) {
  constexpr std::size_t grain = 256;
  std::vector<std::vector<Item>> parts((count + grain - 1) / grain);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t part) {
    for (std::size_t i = part * grain; i < std::min(count, (part + 1) * grain); ++i) {
      const auto begin = static_cast<std::ptrdiff_t>(parts[part].size());
      query(static_cast<compare::Index>(i), parts[part]);
      std::sort(parts[part].begin() + begin, parts[part].end());
    }
  });
  std::vector<Item> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace ogc::reference
