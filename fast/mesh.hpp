// Holds what does not change while a mesh moves. Solvers outside this project make one mesh and pass it to as many
// finders (fast/contact_sets.hpp) and guards (fast/guard.hpp) as they need.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "compare/problem/exclusions.hpp"
#include "compare/problem/mesh.hpp"

namespace ogc::fast {

/// Largest r_q of finders and guards [m], as for scenes (compare/problem/settings.cpp). Searches compare squares of
/// distances with its square. If that were infinite, boxes of empty places, which are infinitely far, would count as
/// near.
inline constexpr float most_query_radius = 0x1p20F;
/// Smallest r and r_q of finders and guards [m]. A squared gap in single precision has three products, each of which
/// errs by 2⁻¹⁵⁰ if it underflows; the limit with which it is compared errs by twice as much. The limit is too large by
/// 2⁻¹⁹ of itself (gap_limit in fast/kernels/bvh.hpp), 2⁻⁹⁹ for this radius, so no near pair is lost. From this length
/// on, exact predicates do not underflow, either (fast/kernels/predicates.hpp).
inline constexpr float least_radius = 0x1p-40F;
/// Largest modulus of a coordinate that finders and guards take [m]. Norms of differences are then at most √3 · 2³¹,
/// and numbers of degree 4 in them, the highest degree in single precision (fast/kernels/separation.hpp), at most 9 ·
/// 2¹²⁴ < 2¹²⁸: they do not overflow. The judge's questions go as far (compare/judge/cases/legal.hpp).
inline constexpr float most_coordinate = 0x1p30F;

/// The connectivity of a surface, and the pairs of faces that may meet. It has no positions and never changes. Copies
/// are cheap and refer to the same data, also from several threads.
class Mesh {
 public:
  /// `triangles` and `loose_edges` (edges of no triangle) name vertices from 0 to vertex_count − 1. `exclusions`: pairs
  /// that are excluded by groups of vertices or by partners; excluded pairs are no contacts, and nothing keeps them
  /// apart. A vector with one number per vertex converts to groups. All arguments are copied. Throws
  /// compare::InputError if the number of vertices is negative, an index is out of range or repeated, or groups or
  /// partners do not have one entry per vertex.
  explicit Mesh(compare::Index vertex_count, std::span<const compare::Triangle> triangles,
                std::span<const compare::Edge> loose_edges = {}, const compare::ExclusionView& exclusions = {});

  /// Return the adjacency, which defines the numbers of edges, and the exclusions. Both live as long as a copy of the
  /// mesh.
  const compare::Topology& topology() const { return data_->topology; }
  const compare::Exclusions& exclusions() const { return data_->exclusions; }
  compare::Index vertex_count() const { return data_->topology.vertex_count; }  ///< number of vertices

  /// Throws compare::InputError unless `vectors` has one finite vector for each vertex. The message begins with
  /// `argument` and names the vertex and its coordinates.
  void check(std::string_view argument, std::span<const compare::Vec3f> vectors) const;
  /// Does the same, and throws if a coordinate is beyond most_coordinate.
  void check_positions(std::string_view argument, std::span<const compare::Vec3f> positions) const;

 private:
  struct Data {
    compare::Topology topology;
    compare::Exclusions exclusions;
  };
  std::shared_ptr<const Data> data_;
};

}  // namespace ogc::fast
