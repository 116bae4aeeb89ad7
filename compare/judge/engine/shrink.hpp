// Makes a failing case smaller for inspection: drops primitives, then shortens coordinates, as long as the case still
// fails.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// Limits of the search.
struct ShrinkOptions {
  std::size_t tries = 4000;  ///< largest number of cases that are tried
  double seconds = 3;        ///< after this time no further case is tried [s]
};

/// Triangles and loose edges of a mesh, in one list.
struct Primitives {
  std::vector<Triangle> triangles;  ///< come first in the list
  std::vector<Edge> loose_edges;    ///< come after the triangles

  explicit Primitives(const Topology& topology);
  /// Returns the number of triangles and loose edges.
  std::size_t size() const { return triangles.size() + loose_edges.size(); }
  /// Returns the list without the entries [first, last).
  Primitives without(std::size_t first, std::size_t last) const;
};

/// A mesh of some primitives of a larger mesh. It has the vertices of these primitives, in their old order.
struct MeshPart {
  std::shared_ptr<const Topology> topology;  ///< of the part
  std::vector<Index> vertices;               ///< their indices in the larger mesh
  std::vector<std::size_t> edges;            ///< their indices in the larger mesh
  std::vector<std::size_t> triangles;        ///< their indices in the larger mesh; empty if all are dropped

  MeshPart(const Topology& whole, const Primitives& kept);
  /// Returns the entries of `items`, an array of the larger mesh, that belong to the part. `numbers` is `vertices`,
  /// `edges` or `triangles` of the part.
  template <class T, class Numbers>
  static std::vector<T> picked(const std::vector<T>& items, const Numbers& numbers) {
    std::vector<T> chosen;
    for (const auto i : numbers) chosen.push_back(items[static_cast<std::size_t>(i)]);
    return chosen;
  }
  /// Returns the excluded pairs (as in Exclusions) whose vertices are both in the part.
  CompressedRows partners(const CompressedRows& of_whole) const;
};

/// The numbers of a case that may lose binary digits. Coordinates of points come first, as x y z.
struct ShortenedNumbers {
  std::vector<float*> coordinates, lengths;  ///< lengths stay above 0
};

/// Returns the number of triangles and of loose edges; 0 for cases that are no mesh.
std::size_t primitive_count(const TestCase& test);

/// Returns a smaller case with the same name. `fails` checks whether a candidate fails as the given case does. Cases of
/// both detections, bound and plane lose triangles, loose edges and vertices without primitives. Then coordinates and
/// radii become 0 or get the fewest binary digits that keep the failure. In closest_face, closest_points and ccd only
/// the numbers change. All other cases are returned unchanged.
TestCase shrink(const TestCase& test, const std::function<bool(const TestCase&)>& fails,
                const ShrinkOptions& options = {});

/// Shrinks a case with a mismatch. A candidate fails if the judge finds a mismatch of the same kind, with any numbers.
TestCase shrink_failure(const TestCase& test, const std::string& message, const Contestant& contestant,
                        const Authority& authority, const ShrinkOptions& options = {});

}  // namespace ogc::compare
