// Lets the judge test the blocks. Calls the predicates of a detection, in the order of a detection.
#pragma once

#include <cstdint>
#include <vector>

#include "compare/stages/block.hpp"
#include "fast/kernels/block.hpp"
#include "fast/kernels/closest_face.hpp"
#include "fast/kernels/closest_points.hpp"
#include "fast/probes/probe_memory.hpp"
#include "fast/stages/surface.hpp"

namespace ogc::fast {

/// Decides for each case whether a point is in a block.
struct ProbeBlock {
  SurfaceView surface;
  PaddedVecs positions;                     ///< by vertex [m]
  const compare::BlockQuestion* questions;  ///< by case
  std::uint8_t* inside;                     ///< by case: 1 if the block holds the point, written

  OGC_HD void operator()(int i) const {
    const compare::BlockQuestion& question = questions[i];
    inside[i] = question.kind == compare::BlockQuestion::Kind::vertex_in_surface
                    ? is_vertex_in_surface(question.of, question.face)
                    : is_edge_in_edges(question.of, question.face);
  }

 private:
  OGC_HD Ends ends(int e) const { return {positions[surface.edges[e].a], positions[surface.edges[e].b]}; }

  OGC_HD static bool is_between(const Vec& x, const Ends& e) {
    return exact_sign(End{x, e.a, e.b}) > 0 && exact_sign(End{x, e.b, e.a}) > 0;
  }

  /// Returns whether vertex v is in the block of the face. Calls the predicates of CollectVertexFacet.
  OGC_HD bool is_vertex_in_surface(int v, const compare::Face& face) const {
    const Vec x = positions[v];
    if (face.kind == compare::FaceKind::vertex) return in_vertex_block(x, face.index, surface, positions);
    if (face.kind == compare::FaceKind::edge)
      return is_between(x, ends(face.index)) && in_edge_block(x, face.index, surface, positions);
    const Facet& facet = surface.facets[face.index];
    const Corners corners{positions[facet.corner[0]], positions[facet.corner[1]], positions[facet.corner[2]]};
    return closest_feature(x, corners, facet.descending) == TriangleFeature::interior;
  }

  /// Returns whether the point of edge e that is nearest to the face lies in the face's block. Calls the predicates of
  /// CollectEdgeEdge in its order: the lower-numbered edge is the first.
  OGC_HD bool is_edge_in_edges(int e, const compare::Face& face) const {
    if (face.kind == compare::FaceKind::edge) {
      const bool is_first = face.index < e;
      const EdgePairFeatures on = is_first ? closest_edge_features(ends(face.index), ends(e))
                                           : closest_edge_features(ends(e), ends(face.index));
      return (is_first ? on.first : on.second) == EdgeFeature::interior;
    }
    const int v = face.index;
    const EdgeEnds& of = surface.edges[e];
    if (exact_sign(End{positions[v], positions[of.a], positions[of.b]}) <= 0)
      return in_vertex_block(positions[of.a], v, surface, positions);
    if (exact_sign(End{positions[v], positions[of.b], positions[of.a]}) <= 0)
      return in_vertex_block(positions[of.b], v, surface, positions);
    return in_vertex_block(of, v, surface, positions);
  }
};

/// Answers the stage `block`.
template <class Backend>
compare::BlockOut probe_block(Backend& backend, const compare::BlockIn& in) {
  const Surface<Backend> surface(*in.topology, {});
  ProbeMemory<Backend> memory(backend);
  compare::BlockOut out;
  const std::vector<compare::Vec3f> positions(in.positions.begin(), in.positions.end());
  const std::vector<compare::BlockQuestion> questions(in.questions.begin(), in.questions.end());
  backend.for_each(static_cast<int>(questions.size()),
                   ProbeBlock{surface.view(),
                              {memory.padded(positions)},
                              memory.template in<compare::BlockQuestion>(questions),
                              memory.template out<std::uint8_t>(out.inside, questions.size())});
  memory.fetch();
  return out;
}

}  // namespace ogc::fast
