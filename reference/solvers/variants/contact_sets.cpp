#include "reference/solvers/variants/contact_sets.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <stdexcept>

#include "reference/geometry/near_pairs.hpp"

namespace ogc::reference {
namespace {

using compare::Face;
using compare::Index;

/// The contact of a vertex and a triangle within r, and their distance [m].
struct FoundFacet {
  compare::VertexFacetContact contact;
  Index triangle = -1;
  float distance = 0;
};
struct FoundEdges {
  compare::EdgeEdgeContact contact;
  std::pair<Index, Index> edges;
};

class Collector {
 public:
  explicit Collector(const compare::DetectIn& in) : in_(in), mesh_{*in.topology, in.positions} {
    NearPairs(mesh_, in.exclusions, double{in.contact_radius}).each([&](const auto& pair) { add(pair); });
    std::ranges::sort(facets_, {}, [](const FoundFacet& f) { return std::pair(f.contact.vertex, f.triangle); });
    std::ranges::sort(edges_, {}, &FoundEdges::edges);
  }
  const std::vector<FoundFacet>& facets() const { return facets_; }
  const std::vector<FoundEdges>& edges() const { return edges_; }

 private:
  // Threads call this in any order, so the caller sorts the results.
  void add(const FacetPair& pair) {
    const float distance = distance_below(pair.gap());
    if (!(distance < in_.contact_radius)) return;
    const Index v = pair.first[0], t = pair.name.second;
    const std::scoped_lock lock(mutex_);
    facets_.push_back({{v, face_of(mesh_, t, pair.closest()), t}, t, distance});
  }
  void add(const EdgesPair& pair) {
    if (!(distance_below(pair.gap()) < in_.contact_radius)) return;
    const EdgeFeatures closest = pair.closest();
    const Index e = pair.name.first, f = pair.name.second;
    compare::EdgeEdgeContact contact{face_of(mesh_, e, closest.first), face_of(mesh_, f, closest.second), e, f};
    if (contact.second < contact.first) contact = {contact.second, contact.first, f, e};
    const std::scoped_lock lock(mutex_);
    edges_.push_back({contact, {e, f}});
  }

  const compare::DetectIn& in_;
  Complex mesh_;
  std::mutex mutex_;
  std::vector<FoundFacet> facets_;
  std::vector<FoundEdges> edges_;
};

/// Returns for each pair of a vertex and another body the nearest contact.
std::vector<compare::VertexFacetContact> nearest_of_bodies(const compare::DetectIn& in,
                                                           const std::vector<FoundFacet>& facets,
                                                           std::span<const Index> body) {
  std::map<std::pair<Index, Index>, const FoundFacet*> nearest;
  const auto body_of = [&](Index v) { return body[static_cast<std::size_t>(v)]; };
  for (const FoundFacet& found : facets) {
    const Index other = body_of(in.topology->triangles[static_cast<std::size_t>(found.triangle)][0]);
    if (other == body_of(found.contact.vertex)) continue;
    const FoundFacet*& known = nearest[{found.contact.vertex, other}];
    if (known == nullptr || found.distance < known->distance) known = &found;
  }
  std::vector<compare::VertexFacetContact> contacts;
  for (const auto& [place, found] : nearest) contacts.push_back(found->contact);
  return contacts;
}

}  // namespace

ListedContacts contact_variant(ContactSet set, const compare::DetectIn& in, std::span<const Index> body) {
  ListedContacts sets;
  switch (set) {
    case ContactSet::ogc: throw std::logic_error("the method's own contacts are those of a detection");
    case ContactSet::distance: sets.vertex_facet = nearest_of_bodies(in, Collector(in).facets(), body); break;
    case ContactSet::pairs: {
      const Collector found(in);
      for (const FoundFacet& facet : found.facets()) sets.vertex_facet.push_back(facet.contact);
      for (const FoundEdges& edges : found.edges()) sets.edge_edge.push_back(edges.contact);
      break;
    }
  }
  return sets;
}

}  // namespace ogc::reference
