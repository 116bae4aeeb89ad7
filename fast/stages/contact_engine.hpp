// A detection that grows its lists until nothing is missing: what the judge's probes and ContactFinder run. The simulation does the same with whole steps.
#pragma once

#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "fast/contact_sets.hpp"
#include "fast/stages/detection.hpp"

namespace ogc::fast {

static_assert(sizeof(Vec) == sizeof(compare::Vec3f) && std::is_standard_layout_v<Vec>, "positions are copied, not converted");

/// A face from SurfaceView's numbering.
inline compare::Face face_of(int number, const compare::Topology& topology) {
  const int edges = static_cast<int>(topology.edges.size());
  if (number < topology.vertex_count) return {compare::FaceKind::vertex, number};
  number -= topology.vertex_count;
  return number < edges ? compare::Face{compare::FaceKind::edge, number} : compare::Face{compare::FaceKind::triangle, number - edges};
}

/// The lowest-numbered triangle that contains the face.
inline compare::Index owner_of(const compare::Face& face, const compare::Topology& topology) {
  if (face.kind == compare::FaceKind::triangle) return face.index;
  const auto& rows = face.kind == compare::FaceKind::vertex ? topology.vertex_triangles : topology.edge_triangles;
  return rows[static_cast<std::size_t>(face.index)].front();
}

/// Not inside the class: nvcc takes no private type for a kernel.
template <class T>
struct CopyItems {
  const T* from;
  T* to;

  OGC_HD void operator()(int i) const { to[i] = from[i]; }
};

template <class Backend>
class BackendContactEngine : public ContactEngine {
 public:
  /// `topology` must outlive the engine. `capacity`: contacts that the lists hold at first; 0 for a guess by mesh size.
  BackendContactEngine(Backend& backend, const compare::Topology& topology, std::span<const compare::Index> rigid_groups, int capacity = 0)
      : backend_(backend), topology_(topology), detection_(backend, topology, rigid_groups, capacity) {}

  ContactSets find(std::span<const compare::Vec3f> positions, const ContactQuery& query) override {
    positions_.upload(reinterpret_cast<const Vec*>(positions.data()), positions.size());
    run(positions_.data(), query);
    return download();
  }

  ContactView find_resident(const compare::Vec3f* positions, const ContactQuery& query) override {
    run(reinterpret_cast<const Vec*>(positions), query);
    return detection_.view();
  }

  const Detection<Backend>& detection() const { return detection_; }

 private:
  template <class T>
  std::vector<T> copy(const T* from, std::size_t n) {
    typename Backend::template Buffer<T> buffer;
    buffer.resize(n);
    T* to = buffer.data();
    backend_.for_each(static_cast<int>(n), CopyItems<T>{from, to});
    backend_.synchronize();
    std::vector<T> items(n);
    buffer.download(items.data(), n);
    return items;
  }

  void run(const Vec* positions, const ContactQuery& query) {
    query_radius_.upload(&query.query_radius, 1);
    detection_.rebuild(positions);
    do {
      detection_.detect(positions, query.contact_radius, query_radius_.data(), query.bound_relaxation);
      backend_.synchronize();
    } while (detection_.grow());
  }

  ContactSets download() {
    const ContactView view = detection_.view();
    const auto vertices = static_cast<std::size_t>(topology_.vertex_count);
    ContactSets sets;
    sets.d_min_vertex = copy(view.d_min_vertex, vertices);
    sets.d_min_edge = copy(detection_.d_min_edge(), topology_.edges.size());
    sets.d_min_triangle = copy(detection_.d_min_triangle(), topology_.triangles.size());
    sets.bound = copy(view.bound, vertices);
    const auto vertex_facets = static_cast<std::size_t>(copy(view.vertex_facet_count, 1)[0]);
    const auto edge_edges = static_cast<std::size_t>(copy(view.edge_edge_count, 1)[0]);
    const std::vector<int> faces = copy(detection_.vertex_facet_faces(), vertex_facets);
    const std::vector<VertexFacetRecord> records = copy(view.vertex_facet, vertex_facets);
    for (std::size_t i = 0; i < vertex_facets; ++i) {
      const compare::Face face = face_of(faces[i], topology_);
      sets.vertex_facet.push_back({records[i].vertex, face, owner_of(face, topology_)});
    }
    for (const EdgeEdgeRecord& record : copy(view.edge_edge, edge_edges)) sets.edge_edge.push_back(contact_of(record));
    return sets;
  }

  static compare::EdgeEdgeContact contact_of(const EdgeEdgeRecord& record) {
    const auto face = [](const int (&vertices)[2], int edge) {
      return vertices[1] < 0 ? compare::Face{compare::FaceKind::vertex, vertices[0]} : compare::Face{compare::FaceKind::edge, edge};
    };
    return {face(record.first, record.first_edge), face(record.second, record.second_edge), record.first_edge, record.second_edge};
  }

  Backend& backend_;
  const compare::Topology& topology_;
  Detection<Backend> detection_;
  typename Backend::template Buffer<Vec> positions_;
  typename Backend::template Buffer<float> query_radius_;
};

}  // namespace ogc::fast
