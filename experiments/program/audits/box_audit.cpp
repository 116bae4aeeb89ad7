#include "experiments/program/audits/box_audit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <set>
#include <utility>

#include <tbb/parallel_for.h>

#include "compare/judge/cases/random.hpp"
#include "compare/oracle/audit.hpp"
#include "compare/oracle/box_tree.hpp"
#include "compare/problem/error.hpp"
#include "reference/contestant.hpp"

namespace ogc::experiments {

namespace {

using compare::at, compare::Index;
using compare::Topology;

/// A contact by the vertices of its faces, which are the same in the whole state and in a box: vertex and face, or both
/// faces. −1: no vertex.
using Key = std::array<Index, 6>;

std::array<Index, 3> vertices_of(const Topology& topology, const compare::Face& face) {
  if (face.kind == compare::FaceKind::vertex) return {face.index, -1, -1};
  if (face.kind == compare::FaceKind::edge) {
    const compare::Edge& ends = topology.edges[at(face.index)];
    return {ends[0], ends[1], -1};
  }
  compare::Triangle corners = topology.triangles[at(face.index)];
  std::ranges::sort(corners);
  return corners;
}

Key joined(const std::array<Index, 3>& a, const std::array<Index, 3>& b) {
  return {a[0], a[1], a[2], b[0], b[1], b[2]};
}

Key key_of(const Topology& topology, const compare::VertexFacetContact& contact) {
  return joined({contact.vertex, -1, -1}, vertices_of(topology, contact.face));
}
Key key_of(const Topology& topology, const compare::EdgeEdgeContact& contact) {
  return joined(vertices_of(topology, contact.first), vertices_of(topology, contact.second));
}

std::string text_of(const Key& key) {
  std::string text = "of vertices";
  for (const Index v : key)
    if (v >= 0) text += " " + std::to_string(v);
  return text;
}

/// A cell of the grid, by its numbers along x, y and z.
using Cell = std::array<std::int64_t, 3>;

/// The surroundings of a box: a mesh of its own, whose vertices are numbered in the order of the whole mesh.
struct Part {
  std::vector<Index> core;      ///< vertices of the box, ascending
  std::vector<Index> vertices;  ///< by own number: number in the whole mesh, ascending
  Topology topology;
  std::vector<compare::Vec3f> positions;
  compare::Exclusions exclusions;

  bool is_core(Index v) const { return std::ranges::binary_search(core, v); }
  bool is_core(const Key& key) const {
    return std::ranges::all_of(key, [this](Index v) { return v < 0 || is_core(v); });
  }
};

class BoxAuditor {
 public:
  BoxAuditor(const Topology& topology, std::span<const compare::Vec3f> positions,
             const compare::ExclusionView& exclusions, const FoundContacts& found, float contact_radius, double side)
      : topology_(topology),
        positions_(positions),
        exclusions_(exclusions),
        found_(found),
        contact_radius_(contact_radius),
        side_(side > 0 ? side : 4 * mean_edge()),
        tree_(triangle_boxes()) {
    for (const compare::Vec3f& x : positions_) {
      const std::array<double, 3> p{x.x, x.y, x.z};
      for (std::size_t k = 0; k < 3; ++k) origin_[k] = std::min(origin_[k], p[k]);
    }
    for (Index v = 0; v < topology_.vertex_count; ++v)
      if (!topology_.vertex_edges[at(v)].empty()) cells_[cell_of(v)].push_back(v);
    vertex_facet_ = by_vertex(found_.vertex_facet);
    edge_edge_ = by_vertex(found_.edge_edge);
  }

  BoxFindings run(const BoxRequest& request) const {
    std::vector<std::pair<std::size_t, Cell>> order;  // all cells, those with most contacts first
    for (const auto& [cell, vertices] : cells_) order.emplace_back(contacts_of(vertices), cell);
    std::ranges::stable_sort(order, std::ranges::greater{}, &std::pair<std::size_t, Cell>::first);
    BoxFindings findings{.cells = order.size(), .boxes = std::min(request.count, order.size()), .side = side_};
    findings.densest = findings.boxes / 2;
    // Draws the other half: a shuffle of the rest, as far as it is needed.
    compare::Random random("audit", "boxes", request.seed, 0);
    for (std::size_t i = findings.densest; i < findings.boxes; ++i)
      std::swap(order[i], order[i + random.bits() % (order.size() - i)]);
    if (findings.densest > 0) {
      findings.most_contacts = order.front().first;
      findings.least_of_densest = order[findings.densest - 1].first;
    }
    std::vector<BoxFindings> shares(findings.boxes);
    tbb::parallel_for(std::size_t{0}, shares.size(), [&](std::size_t i) { shares[i] = audit(order[i].second); });
    for (const BoxFindings& share : shares) add(findings, share);
    return findings;
  }

 private:
  double mean_edge() const {
    double sum = 0;
    for (const compare::Edge& e : topology_.edges) {
      const compare::Vec3f &a = positions_[at(e[0])], &b = positions_[at(e[1])];
      sum += std::hypot(double{a.x} - double{b.x}, double{a.y} - double{b.y}, double{a.z} - double{b.z});
    }
    return topology_.edges.empty() ? 1 : sum / static_cast<double>(topology_.edges.size());
  }

  compare::Vec3 position(Index v) const {
    const compare::Vec3f& x = positions_[at(v)];
    return {x.x, x.y, x.z};
  }

  std::vector<compare::Box> triangle_boxes() const {
    std::vector<compare::Box> boxes;
    for (const compare::Triangle& t : topology_.triangles)
      boxes.push_back(compare::box_of({position(t[0]), position(t[1]), position(t[2])}));
    return boxes;
  }

  Cell cell_of(Index v) const {
    const compare::Vec3 x = position(v);
    const auto along = [this](double p, std::size_t k) {
      return static_cast<std::int64_t>(std::floor((p - origin_[k]) / side_));
    };
    return {along(x.x, 0), along(x.y, 1), along(x.z, 2)};
  }

  /// Returns, by vertex, the contacts whose lowest-numbered vertex it is (of a vertex and a facet: the vertex).
  template <class Contact>
  compare::CompressedRows by_vertex(const std::vector<Contact>& contacts) const {
    const auto vertex = [this](const Contact& contact) { return at(key_of(topology_, contact)[0]); };
    compare::CompressedRows rows;
    rows.offsets.assign(at(topology_.vertex_count) + 1, 0);
    for (const Contact& contact : contacts) ++rows.offsets[vertex(contact) + 1];
    std::partial_sum(rows.offsets.begin(), rows.offsets.end(), rows.offsets.begin());
    rows.items.resize(contacts.size());
    std::vector<Index> next(rows.offsets.begin(), rows.offsets.end() - 1);
    for (std::size_t i = 0; i < contacts.size(); ++i)
      rows.items[at(next[vertex(contacts[i])]++)] = static_cast<Index>(i);
    return rows;
  }

  std::size_t contacts_of(const std::vector<Index>& vertices) const {
    std::size_t count = 0;
    for (const Index v : vertices) count += vertex_facet_[at(v)].size() + edge_edge_[at(v)].size();
    return count;
  }

  Part part_of(const Cell& cell) const {
    std::set<Index> core(cells_.at(cell).begin(), cells_.at(cell).end());
    compare::Box box;
    for (const double end : {0.0, 1.0})
      box.add(compare::Vec3{origin_[0] + (static_cast<double>(cell[0]) + end) * side_,
                            origin_[1] + (static_cast<double>(cell[1]) + end) * side_,
                            origin_[2] + (static_cast<double>(cell[2]) + end) * side_});
    tree_.for_each_meeting(box, [&](Index t) {
      for (const Index v : topology_.triangles[at(t)]) core.insert(v);
    });
    std::set<Index> triangles, loose, all(core);
    for (const Index v : core) {
      for (const Index t : topology_.vertex_triangles[at(v)]) triangles.insert(t);
      for (const Index e : topology_.vertex_edges[at(v)])
        if (topology_.edge_triangles[at(e)].empty()) loose.insert(e);
    }
    for (const Index t : triangles)
      for (const Index v : topology_.triangles[at(t)]) all.insert(v);
    for (const Index e : loose)
      for (const Index v : topology_.edges[at(e)]) all.insert(v);
    Part part;
    part.core.assign(core.begin(), core.end());
    part.vertices.assign(all.begin(), all.end());
    const auto own = [&](Index v) {
      return static_cast<Index>(std::ranges::lower_bound(part.vertices, v) - part.vertices.begin());
    };
    std::vector<compare::Triangle> corners;
    for (const Index t : triangles) {
      const compare::Triangle& of = topology_.triangles[at(t)];
      corners.push_back({own(of[0]), own(of[1]), own(of[2])});
    }
    std::vector<compare::Edge> ends;
    for (const Index e : loose) ends.push_back({own(topology_.edges[at(e)][0]), own(topology_.edges[at(e)][1])});
    part.topology = compare::build_topology(static_cast<Index>(part.vertices.size()), corners, ends);
    std::vector<std::array<Index, 2>> partners;
    for (const Index v : part.vertices) {
      part.positions.push_back(positions_[at(v)]);
      if (!exclusions_.groups.empty()) part.exclusions.groups.push_back(exclusions_.groups[at(v)]);
      if (exclusions_.partners == nullptr) continue;
      for (const Index other : (*exclusions_.partners)[at(v)])
        if (other > v && all.contains(other)) partners.push_back({own(v), own(other)});
    }
    if (!partners.empty()) part.exclusions.partners = compare::partner_rows(part.vertices.size(), partners);
    return part;
  }

  /// Adds the keys of a part's contacts that are compared, with numbers of the whole mesh.
  template <class Contact>
  static void add_keys(const Part& part, const std::vector<Contact>& contacts, std::set<Key>& keys) {
    for (const Contact& contact : contacts) {
      Key key = key_of(part.topology, contact);
      for (Index& v : key)
        if (v >= 0) v = part.vertices[at(v)];
      if (part.is_core(key)) keys.insert(key);
    }
  }

  /// Returns the keys of the found contacts that are compared. Counts a contact that was found twice as an extra one.
  template <class Contact>
  std::set<Key> found_keys(const Part& part, const std::vector<Contact>& contacts, const compare::CompressedRows& rows,
                           BoxFindings& findings) const {
    std::set<Key> keys;
    for (const Index v : part.core) {
      for (const Index i : rows[at(v)]) {
        const Key key = key_of(topology_, contacts[at(i)]);
        if (!part.is_core(key) || keys.insert(key).second) continue;
        ++findings.extra;
        if (findings.first.empty()) findings.first = "a contact found twice " + text_of(key);
      }
    }
    return keys;
  }

  template <class Truth>
  void compare_sets(const Part& part, const Truth& truth, const std::set<Key>& found, const char* kind,
                    BoxFindings& findings) const {
    std::set<Key> exact, grey;
    add_keys(part, truth.exact.contacts, exact);
    for (const auto& decision : truth.grey) add_keys(part, decision.contacts, grey);
    findings.contacts += exact.size();
    const auto differs = [&](const Key& key, std::size_t& count, const char* what) {
      if (grey.contains(key)) {
        ++findings.grey;
        return;
      }
      ++count;
      if (findings.first.empty()) findings.first = std::string(what) + " " + kind + " contact " + text_of(key);
    };
    for (const Key& key : exact)
      if (!found.contains(key)) differs(key, findings.missing, "missing");
    for (const Key& key : found)
      if (!exact.contains(key)) differs(key, findings.extra, "extra");
  }

  BoxFindings audit(const Cell& cell) const {
    const Part part = part_of(cell);
    BoxFindings findings;
    findings.vertices = part.core.size();
    for (const compare::Triangle& t : part.topology.triangles)
      findings.triangles += std::ranges::all_of(t, [&](Index v) { return part.is_core(part.vertices[at(v)]); }) ? 1 : 0;
    const compare::AuditResult met = compare::audit(part.topology, compare::to_double(part.positions), part.exclusions);
    findings.pairs_tested = met.pairs_tested;
    findings.intersections = met.count;
    if (met.count > 0) findings.first = compare::describe(met.intersections.front(), part.topology) + " (own numbers)";
    const compare::DetectIn in{&part.topology, part.exclusions, part.positions, contact_radius_, contact_radius_};
    static const compare::Authority authority = reference::authority();
    compare_sets(part, authority.detect_vertex_facet(in),
                 found_keys(part, found_.vertex_facet, vertex_facet_, findings), "vertex–facet", findings);
    compare_sets(part, authority.detect_edge_edge(in), found_keys(part, found_.edge_edge, edge_edge_, findings),
                 "edge–edge", findings);
    return findings;
  }

  static void add(BoxFindings& sum, const BoxFindings& share) {
    for (const auto member :
         {&BoxFindings::vertices, &BoxFindings::triangles, &BoxFindings::pairs_tested, &BoxFindings::intersections,
          &BoxFindings::contacts, &BoxFindings::missing, &BoxFindings::extra, &BoxFindings::grey})
      sum.*member += share.*member;
    if (sum.first.empty()) sum.first = share.first;
  }

  const Topology& topology_;
  std::span<const compare::Vec3f> positions_;
  compare::ExclusionView exclusions_;
  const FoundContacts& found_;
  float contact_radius_;
  double side_;
  compare::BoxTree tree_;
  std::array<double, 3> origin_{1e308, 1e308, 1e308};
  std::map<Cell, std::vector<Index>> cells_;
  compare::CompressedRows vertex_facet_, edge_edge_;  ///< by vertex: numbers of found contacts
};

}  // namespace

BoxFindings audit_boxes(const Topology& topology, std::span<const compare::Vec3f> positions,
                        const compare::ExclusionView& exclusions, const FoundContacts& found, float contact_radius,
                        const BoxRequest& request) {
  if (!topology.off_surface.empty())
    throw compare::InputError(
        "an audit in boxes takes surfaces and curves alone, and this state has solids or volumes; "
        "audit it without --boxes");
  return BoxAuditor(topology, positions, exclusions, found, contact_radius, request.side).run(request);
}

}  // namespace ogc::experiments
