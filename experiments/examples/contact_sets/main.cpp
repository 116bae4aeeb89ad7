// Computes contact sets and conservative bounds for a solver of your own. The input is two triangles, one 3 mm above
// the other; the output is everything that one step needs.
#include <cstdio>
#include <vector>

#include "fast/contact_sets.hpp"

int main() {
  const std::vector<ogc::compare::Triangle> triangles{{0, 1, 2}, {3, 4, 5}};
  const std::vector<ogc::compare::Vec3f> positions{{0.0f, 0.0f, 0.0f},     {0.1f, 0.0f, 0.0f},
                                                   {0.0f, 0.1f, 0.0f},     {0.02f, 0.02f, 0.003f},
                                                   {0.12f, 0.02f, 0.003f}, {0.02f, 0.12f, 0.003f}};
  const auto vertex_count = static_cast<ogc::compare::Index>(positions.size());

  // For positions in device memory use Backend::cuda here and find_resident(device_pointer, query) below.
  ogc::fast::ContactFinder finder(ogc::fast::Mesh(vertex_count, triangles), ogc::fast::Backend::cpu);
  const ogc::fast::ContactSets sets = finder.find(positions, {.contact_radius = 0.005f, .query_radius = 0.01f});

  std::printf("%zu vertex-facet and %zu edge-edge contacts\n", sets.vertex_facet.size(), sets.edge_edge.size());
  for (const auto& [vertex, face, owner] : sets.vertex_facet) {
    std::printf("vertex %d is in the block of %s %d\n", vertex,
                face.kind == ogc::compare::FaceKind::triangle ? "triangle" : "a lower face,", face.index);
  }
  for (std::size_t v = 0; v < positions.size(); ++v)
    std::printf("vertex %zu may move %.4g m without touching anything\n", v, double{sets.bound[v]});
}
