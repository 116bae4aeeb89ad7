#include "compare/judge/engine/features.hpp"

#include <array>

namespace ogc::compare {

namespace {

template <class Corners>
std::string with_vertices(const std::string& name, const Corners& corners) {
  std::string text;
  for (const Index v : corners) text += (text.empty() ? " (vertices " : ", ") + std::to_string(v);
  return name + text + ")";
}

}  // namespace

std::string feature_name(TriangleFeature feature) {
  const auto k = static_cast<unsigned>(feature);
  constexpr std::array<const char*, 3> edges{"(0,1)", "(1,2)", "(2,0)"};
  if (k < 3) return "vertex " + std::to_string(k) + " of the triangle";
  if (k < 6) return std::string("edge ") + edges[k - 3] + " of the triangle";
  return k == 6 ? "the interior of the triangle" : "no feature of a triangle (" + std::to_string(k) + ")";
}

std::string feature_name(EdgeFeature feature, const std::string& which) {
  const auto k = static_cast<unsigned>(feature);
  if (k < 2) return "end " + std::to_string(k) + " of the " + which + " edge";
  return k == 2 ? "the interior of the " + which + " edge"
                : "no feature of the " + which + " edge (" + std::to_string(k) + ")";
}

std::string face_name(const Face& face, const Topology& topology) {
  const auto i = static_cast<std::size_t>(face.index);
  const std::string number = std::to_string(face.index);
  switch (face.kind) {
    case FaceKind::vertex: return "vertex " + number;
    case FaceKind::edge:
      return i < topology.edges.size() ? with_vertices("edge " + number, topology.edges[i]) : "edge " + number;
    case FaceKind::triangle:
      return i < topology.triangles.size() ? with_vertices("triangle " + number, topology.triangles[i])
                                           : "triangle " + number;
  }
  return "a face of kind " + std::to_string(static_cast<int>(face.kind));
}

std::string contact_name(const VertexFacetContact& c, const Topology& topology) {
  return "vertex " + std::to_string(c.vertex) + " and " + face_name(c.face, topology) + ", owner triangle " +
         std::to_string(c.owner);
}

std::string contact_name(const EdgeEdgeContact& c, const Topology& topology) {
  return face_name(c.first, topology) + " and " + face_name(c.second, topology) + ", of edges " +
         std::to_string(c.first_edge) + " and " + std::to_string(c.second_edge);
}

std::string pair_name(const PrimitivePair& pair, const Topology& topology) {
  const bool is_of_edges = pair.kind == PrimitivePair::Kind::edge_edge;
  return face_name({is_of_edges ? FaceKind::edge : FaceKind::vertex, pair.first}, topology) + " and " +
         face_name({is_of_edges ? FaceKind::edge : FaceKind::triangle, pair.second}, topology);
}

std::string question_name(const BlockQuestion& question, const Topology& topology) {
  const std::string face = face_name(question.face, topology);
  if (question.kind == BlockQuestion::Kind::vertex_in_surface)
    return "vertex " + std::to_string(question.of) + " in the block of " + face;
  return "the point of " + face_name({FaceKind::edge, question.of}, topology) + " closest to " + face + " in its block";
}

}  // namespace ogc::compare
