// Copies from the backend to the host, in the judge's types: arrays behind plain pointers, and the sets of a detection.
// Probes, traces and ContactFinder use it; a step never waits for such a copy.
#pragma once

#include <type_traits>
#include <vector>

#include "compare/stages/detect_edge_edge.hpp"
#include "fast/contact_sets.hpp"
#include "fast/stages/detection.hpp"

namespace ogc::fast {

static_assert(sizeof(Vec) == sizeof(compare::Vec3f) && std::is_standard_layout_v<Vec>,
              "positions are copied, not converted");

/// Returns the face with this number; SurfaceView defines the numbers of faces.
inline compare::Face face_of(int number, const compare::Topology& topology) {
  const int edges = static_cast<int>(topology.edges.size());
  if (number < topology.vertex_count) return {compare::FaceKind::vertex, number};
  number -= topology.vertex_count;
  return number < edges ? compare::Face{compare::FaceKind::edge, number}
                        : compare::Face{compare::FaceKind::triangle, number - edges};
}

/// Returns the lowest-numbered triangle that contains the face.
inline compare::Index owner_of(const compare::Face& face, const compare::Topology& topology) {
  if (face.kind == compare::FaceKind::triangle) return face.index;
  const auto& rows = face.kind == compare::FaceKind::vertex ? topology.vertex_triangles : topology.edge_triangles;
  return rows[static_cast<std::size_t>(face.index)].front();
}

/// Returns the face on one side of an edge–edge record. `edge`: the edge that the record has for this side.
inline compare::Face side_of(const int (&vertices)[2], int edge) {
  return vertices[1] < 0 ? compare::Face{compare::FaceKind::vertex, vertices[0]}
                         : compare::Face{compare::FaceKind::edge, edge};
}

/// Returns a record as a contact in the judge's type.
inline compare::EdgeEdgeContact contact_of(const EdgeEdgeRecord& record) {
  return {side_of(record.first, record.first_edge), side_of(record.second, record.second_edge), record.first_edge,
          record.second_edge};
}

/// Sets to[i] = from[i].
template <class T>
struct CopyItems {
  const T* from;  ///< on the backend
  T* to;          ///< on the backend

  OGC_HD void operator()(int i) const { to[i] = from[i]; }
};

/// Returns n items that are on the backend; waits for all enqueued work.
template <class T, class Backend>
std::vector<T> download_items(Backend& backend, const T* from, std::size_t n) {
  typename Backend::template Buffer<T> buffer;
  buffer.resize(n);
  T* to = buffer.data();
  backend.for_each(static_cast<int>(n), CopyItems<T>{from, to});
  backend.synchronize();
  std::vector<T> items(n);
  buffer.download(items.data(), n);
  return items;
}

/// Returns n positions or velocities that are on the backend; waits for all enqueued work.
template <class Backend>
std::vector<compare::Vec3f> download_positions(Backend& backend, const Vec* from, std::size_t n) {
  std::vector<compare::Vec3f> positions;
  positions.reserve(n);
  for (const Vec& x : download_items(backend, from, n)) positions.push_back({x.x, x.y, x.z});
  return positions;
}

/// Returns the contact sets, smallest distances and bounds of the last detection.
template <class Backend>
ContactSets download_contacts(Backend& backend, Detection<Backend>& detection, const compare::Topology& topology) {
  const ContactView view = detection.view();
  const auto vertices = static_cast<std::size_t>(topology.vertex_count);
  ContactSets sets;
  sets.d_min_vertex = download_items(backend, view.d_min_vertex, vertices);
  sets.d_min_edge = download_items(backend, detection.d_min_edge(), topology.edges.size());
  sets.d_min_triangle = download_items(backend, detection.d_min_triangle(), topology.triangles.size());
  sets.bound = download_items(backend, view.bound, vertices);
  const auto vertex_facets = static_cast<std::size_t>(download_items(backend, view.vertex_facet_count, 1)[0]);
  const auto edge_edges = static_cast<std::size_t>(download_items(backend, view.edge_edge_count, 1)[0]);
  const int* numbers = detection.vertex_facet_faces();
  const std::vector<int> faces = download_items(backend, numbers, vertex_facets);
  const std::vector<VertexFacetRecord> records = download_items(backend, view.vertex_facet, vertex_facets);
  for (std::size_t i = 0; i < vertex_facets; ++i) {
    const compare::Face face = face_of(faces[i], topology);
    sets.vertex_facet.push_back({records[i].vertex, face, owner_of(face, topology)});
  }
  for (const EdgeEdgeRecord& record : download_items(backend, view.edge_edge, edge_edges))
    sets.edge_edge.push_back(contact_of(record));
  return sets;
}

}  // namespace ogc::fast
