// Renumbers a mesh and arrays by vertex, edge or triangle. Contact sets and bounds must not depend on the numbers of
// vertices and triangles.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "compare/judge/cases/random.hpp"
#include "compare/problem/mesh.hpp"

namespace ogc::compare {

/// A random order of vertices, triangles and each triangle's corners.
class Renumbering {
 public:
  Renumbering(Random& random, const Topology& from);

  /// Returns the same mesh with the new indices.
  const std::shared_ptr<const Topology>& topology() const { return topology_; }
  /// Return entries by vertex, edge or triangle in the new order.
  template <class T>
  std::vector<T> by_vertex(const std::vector<T>& old) const {
    return renumbered(old, vertex_);
  }
  template <class T>
  std::vector<T> by_edge(const std::vector<T>& old) const {
    return renumbered(old, edge_);
  }
  template <class T>
  std::vector<T> by_triangle(const std::vector<T>& old) const {
    return renumbered(old, triangle_);
  }
  /// `vertex` returns the new index of a vertex; `face` returns a face with its new index.
  Index vertex(Index v) const { return vertex_[static_cast<std::size_t>(v)]; }
  Face face(const Face& f) const {
    const std::vector<Index>& to = f.kind == FaceKind::vertex ? vertex_ : f.kind == FaceKind::edge ? edge_ : triangle_;
    return {f.kind, to[static_cast<std::size_t>(f.index)]};
  }

 private:
  Edge renamed(const Edge& e) const {
    return {std::min(vertex(e[0]), vertex(e[1])), std::max(vertex(e[0]), vertex(e[1]))};
  }
  template <class T>
  static std::vector<T> renumbered(const std::vector<T>& old, const std::vector<Index>& to) {
    std::vector<T> all(old.size());
    for (std::size_t i = 0; i < old.size() && i < to.size(); ++i) all[static_cast<std::size_t>(to[i])] = old[i];
    return all;
  }

  std::vector<Index> vertex_, triangle_, edge_;
  std::shared_ptr<const Topology> topology_;
};

}  // namespace ogc::compare
