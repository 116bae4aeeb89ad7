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

/// Limits of the search.
struct ShrinkOptions {
  std::size_t tries = 4000;  ///< largest number of cases that are asked
  double seconds = 3;        ///< no case is begun after this time [s]
};

/// Triangles and loose edges of a mesh, in one list.
struct Primitives {
  std::vector<Triangle> triangles;  ///< come first in the list
  std::vector<Edge> loose_edges;    ///< come after the triangles

  explicit Primitives(const Topology& topology);
  /// Returns the number of both together.
  std::size_t size() const { return triangles.size() + loose_edges.size(); }
  /// Returns the list without the entries from `first` to `last`.
  Primitives without(std::size_t first, std::size_t last) const;
};

/// A mesh of some primitives of another one; its vertices are those of the primitives, in order.
struct MeshPart {
  std::shared_ptr<const Topology> topology;  ///< of the part
  std::vector<Index> vertices;               ///< their numbers in the other mesh
  std::vector<std::size_t> edges;            ///< their numbers in the other mesh
  std::vector<std::size_t> triangles;        ///< their numbers in the other mesh; empty where all are dropped

  MeshPart(const Topology& whole, const Primitives& kept);
  /// Returns the items of the part's vertices, edges or triangles, out of those of the whole mesh.
  template <class T, class Numbers>
  static std::vector<T> picked(const std::vector<T>& items, const Numbers& numbers) {
    std::vector<T> chosen;
    for (const auto i : numbers) chosen.push_back(items[static_cast<std::size_t>(i)]);
    return chosen;
  }
  /// Returns the excluded pairs (as in Exclusions) of which the part holds both vertices.
  CompressedRows partners(const CompressedRows& of_whole) const;
};

/// The numbers of a case that may get fewer binary digits. Where the case has points, they come first, as x y z.
struct ShortenedNumbers {
  std::vector<float*> coordinates, lengths;  ///< lengths stay above 0
};

/// Returns the number of triangles and of edges without a triangle; 0 for cases that are no mesh.
std::size_t primitive_count(const TestCase& test);

/// Returns a smaller case under the same name. `fails` tells whether a candidate fails as the given case does. Cases of
/// the two detections, bound and plane lose triangles and loose edges, with the vertices that no primitive holds then.
/// After that their coordinates and radii, and the coordinates of closest_face, closest_points and ccd, are set to 0 or
/// to the fewest binary digits that keep the failure. All other cases come back as they are.
TestCase shrink(const TestCase& test, const std::function<bool(const TestCase&)>& fails,
                const ShrinkOptions& options = {});

/// Shrinks a case with a mismatch: a candidate fails where the judge finds a mismatch of the same kind, whatever its
/// numbers.
TestCase shrink_failure(const TestCase& test, const std::string& message, const Contestant& contestant,
                        const Authority& authority, const ShrinkOptions& options = {});

}  // namespace ogc::compare
