// Builds adjacency by counting sorts: one pass counts a row's items, one fills them, and visiting items in ascending
// order leaves the rows sorted. A million vertices take about a second of memory traffic and no global sort.
#include "compare/problem/mesh.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "compare/problem/scene.hpp"

namespace ogc::compare {
namespace {

Index number(std::size_t i) { return static_cast<Index>(i); }

Edge ordered(Index a, Index b) { return a < b ? Edge{a, b} : Edge{b, a}; }

// Builds rows from `visit(emit)`, which calls emit(row, item) for every entry. Items of one row are stored in the order
// of these calls. `visit` runs twice and must do the same both times.
template <class Visit>
CompressedRows gather(std::size_t rows, const Visit& visit) {
  CompressedRows result;
  result.offsets.assign(rows + 1, 0);
  visit([&](Index row, Index) { ++result.offsets[at(row) + 1]; });
  for (std::size_t i = 0; i < rows; ++i) result.offsets[i + 1] += result.offsets[i];
  result.items.resize(at(result.offsets[rows]));
  std::vector<Index> next(result.offsets.begin(), result.offsets.end() - 1);
  visit([&](Index row, Index item) { result.items[at(next[at(row)]++)] = item; });
  return result;
}

CompressedRows sorted_without_repetition(const CompressedRows& rows) {
  CompressedRows result;
  result.offsets.reserve(rows.offsets.size());
  result.items.reserve(rows.items.size());
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    const auto row = rows[i];
    const auto begin = result.items.insert(result.items.end(), row.begin(), row.end());
    std::sort(begin, result.items.end());
    result.items.erase(std::unique(begin, result.items.end()), result.items.end());
    result.offsets.push_back(number(result.items.size()));
  }
  return result;
}

void check_face(const char* kind, std::size_t i, std::span<const Index> corners, Index vertex_count) {
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const bool repeated = corners[k] == corners[(k + 1) % corners.size()];
    if (corners[k] < 0 || corners[k] >= vertex_count || repeated) {
      throw std::out_of_range(
          std::string(kind) + " " + std::to_string(i) + ": vertex " + std::to_string(corners[k]) +
          (repeated ? " is repeated" : " does not exist (" + std::to_string(vertex_count) + " vertices)"));
    }
  }
}

void check_indices(Index vertex_count, std::span<const Triangle> triangles, std::span<const Edge> loose_edges) {
  constexpr std::size_t most = std::numeric_limits<Index>::max() / 2;  // each edge stands in two rows
  if (triangles.size() > most / 3 || loose_edges.size() > most - 3 * triangles.size())
    throw std::out_of_range("more edges than an index can number");
  for (std::size_t t = 0; t < triangles.size(); ++t) check_face("triangle", t, triangles[t], vertex_count);
  for (std::size_t e = 0; e < loose_edges.size(); ++e) check_face("loose edge", e, loose_edges[e], vertex_count);
}

// Returns rows: row v holds the larger ends of the edges whose smaller end is v. The offset of a row is the number of
// its first edge.
CompressedRows larger_ends(Index vertex_count, std::span<const Triangle> triangles, std::span<const Edge> loose_edges) {
  return sorted_without_repetition(gather(at(vertex_count), [&](const auto& emit) {
    const auto emit_edge = [&](Index a, Index b) { emit(std::min(a, b), std::max(a, b)); };
    for (const Triangle& t : triangles) {
      for (std::size_t k = 0; k < 3; ++k) emit_edge(t[k], t[(k + 1) % 3]);
    }
    for (const Edge& e : loose_edges) emit_edge(e[0], e[1]);
  }));
}

void number_edges(Topology& topology, const CompressedRows& ends) {
  topology.edges.reserve(ends.items.size());
  for (std::size_t v = 0; v < ends.rows(); ++v) {
    for (const Index larger : ends[v]) topology.edges.push_back({number(v), larger});
  }
  const auto edge_number = [&](Index a, Index b) {
    const auto [smaller, larger] = ordered(a, b);
    const auto row = ends[at(smaller)];
    return ends.offsets[at(smaller)] +
           static_cast<Index>(std::lower_bound(row.begin(), row.end(), larger) - row.begin());
  };
  topology.triangle_edges.reserve(topology.triangles.size());
  for (const auto& [a, b, c] : topology.triangles) {
    topology.triangle_edges.push_back({edge_number(a, b), edge_number(b, c), edge_number(c, a)});
  }
}

void gather_around_vertices(Topology& topology) {
  const std::size_t vertices = at(topology.vertex_count);
  topology.vertex_triangles = gather(vertices, [&](const auto& emit) {
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
      for (const Index v : topology.triangles[t]) emit(v, number(t));
    }
  });
  topology.vertex_edges = gather(vertices, [&](const auto& emit) {
    for (std::size_t e = 0; e < topology.edges.size(); ++e) {
      for (const Index v : topology.edges[e]) emit(v, number(e));
    }
  });
  topology.vertex_neighbours = gather(vertices, [&](const auto& emit) {
    for (const auto& [a, b] : topology.edges) {
      emit(a, b);
      emit(b, a);
    }
  });
}

void gather_around_edges(Topology& topology) {
  topology.edge_triangles = gather(topology.edges.size(), [&](const auto& emit) {
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
      for (const Index e : topology.triangle_edges[t]) emit(e, number(t));
    }
  });
  topology.edge_opposite = sorted_without_repetition(gather(topology.edges.size(), [&](const auto& emit) {
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) emit(topology.triangle_edges[t][k], topology.triangles[t][(k + 2) % 3]);
    }
  }));
}

Index opposite_of(const Topology& topology, Index edge, Index triangle) {
  const auto& edges = topology.triangle_edges[at(triangle)];
  const auto k = static_cast<std::size_t>(std::find(edges.begin(), edges.end(), edge) - edges.begin());
  return topology.triangles[at(triangle)][(k + 2) % 3];
}

void sort_out_edges(Topology& topology) {
  for (std::size_t e = 0; e < topology.edges.size(); ++e) {
    const auto around = topology.edge_triangles[e];
    const Index edge = number(e);
    if (around.size() == 1) topology.boundary_edges.push_back(edge);
    if (around.size() >= 3) topology.non_manifold_edges.push_back(edge);
    if (around.size() == 2) {
      topology.hinges.push_back({edge,
                                 {around[0], around[1]},
                                 {opposite_of(topology, edge, around[0]), opposite_of(topology, edge, around[1])}});
    }
  }
}

void number_components(Topology& topology) {
  topology.component.assign(at(topology.vertex_count), -1);
  std::vector<Index> open;
  Index count = 0;
  for (Index seed = 0; seed < topology.vertex_count; ++seed) {
    if (topology.component[at(seed)] >= 0) continue;
    topology.component[at(seed)] = count;
    open.push_back(seed);
    while (!open.empty()) {
      const Index v = open.back();
      open.pop_back();
      for (const Index u : topology.vertex_neighbours[at(v)]) {
        if (topology.component[at(u)] >= 0) continue;
        topology.component[at(u)] = count;
        open.push_back(u);
      }
    }
    ++count;
  }
}

}  // namespace

Topology build_topology(Index vertex_count, std::span<const Triangle> triangles, std::span<const Edge> loose_edges) {
  check_indices(vertex_count, triangles, loose_edges);
  Topology topology;
  topology.vertex_count = vertex_count;
  topology.triangles.assign(triangles.begin(), triangles.end());
  number_edges(topology, larger_ends(vertex_count, triangles, loose_edges));
  gather_around_vertices(topology);
  gather_around_edges(topology);
  sort_out_edges(topology);
  number_components(topology);
  return topology;
}

Topology build_topology(const Mesh& mesh) {
  Topology topology = build_topology(static_cast<Index>(mesh.positions.size()), mesh.triangles, mesh.loose_edges);
  const auto mark_inside = [&](const auto& element) {
    for (const Index v : element) {
      if (!topology.vertex_edges[at(v)].empty()) continue;
      topology.off_surface.resize(mesh.positions.size());
      topology.off_surface[at(v)] = 1;
    }
  };
  for_each_of<MeshLists>([&]<class List, std::size_t>() {
    if constexpr (HasVolume<List>) std::ranges::for_each(mesh.*List::list, mark_inside);
  });
  return topology;
}

Index find_edge(const Topology& topology, Index a, Index b) {
  const Edge wanted = ordered(a, b);
  const auto found = std::lower_bound(topology.edges.begin(), topology.edges.end(), wanted);
  return found != topology.edges.end() && *found == wanted
             ? number(static_cast<std::size_t>(found - topology.edges.begin()))
             : -1;
}

}  // namespace ogc::compare
