// Makes a failing case small enough to look at: drops primitives, then gives coordinates fewer digits, as long as the
// case still fails.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// When to stop.
struct ShrinkOptions {
  std::size_t tries = 4000;  ///< cases asked at most
  double seconds = 3;        ///< no case is begun after so long
};

/// Triangles and loose edges of a mesh, in one list.
struct Primitives {
  std::vector<Triangle> triangles;  ///< first in the list
  std::vector<Edge> loose_edges;    ///< behind them

  explicit Primitives(const Topology& topology);
  /// Of both together.
  std::size_t size() const { return triangles.size() + loose_edges.size(); }
  /// Without those from `first` to `last`.
  Primitives without(std::size_t first, std::size_t last) const;
};

/// A mesh of some primitives of another one: its vertices are those that they hold, in order.
struct MeshPart {
  std::shared_ptr<const Topology> topology;  ///< of the part
  std::vector<Index> vertices;               ///< number in the other mesh
  std::vector<std::size_t> edges;            ///< likewise
  std::vector<std::size_t> triangles;        ///< likewise; empty where all are dropped

  MeshPart(const Topology& whole, const Primitives& kept);
  /// The items of the part's vertices, edges or triangles, out of those of the whole mesh.
  template <class T, class Numbers>
  static std::vector<T> picked(const std::vector<T>& items, const Numbers& numbers) {
    std::vector<T> chosen;
    for (const auto i : numbers) chosen.push_back(items[static_cast<std::size_t>(i)]);
    return chosen;
  }
  /// Excluded pairs (as in Exclusions) of which the part holds both vertices.
  CompressedRows partners(const CompressedRows& of_whole) const;
};

/// The numbers of a case that may get fewer binary digits; where it has points, they come first, as x y z.
struct ShortenedNumbers {
  std::vector<float*> coordinates, lengths;  ///< lengths stay above 0
};

/// Number of triangles and edges without a triangle; 0 for cases that are no mesh.
std::size_t primitive_count(const TestCase& test);

/// The smaller case, under the same name. `fails` says whether a candidate fails as the given one does. Cases of
/// detect_vertex_facet, detect_edge_edge and bound lose triangles and loose edges, with the vertices that nothing holds
/// any more; then, as in closest_face and closest_points, coordinates and radii are set to 0 or to the fewest binary
/// digits that keep the failure. All others come back as they are.
TestCase shrink(const TestCase& test, const std::function<bool(const TestCase&)>& fails,
                const ShrinkOptions& options = {});

/// The same for a mismatch: a candidate fails where the judge finds one of the same kind, whatever its numbers.
TestCase shrink_failure(const TestCase& test, const std::string& message, const Contestant& contestant,
                        const Authority& authority, const ShrinkOptions& options = {});

}  // namespace ogc::compare
