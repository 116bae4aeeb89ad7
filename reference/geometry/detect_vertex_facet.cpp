// Runs Algorithm 1 in its order: distance, smallest distances, closest face, block. A separate pass examines the grey
// zone for every face of every triangle within r. A doubtful face of a neighbouring triangle matters even if Algorithm
// 1 never examines it.
#include "reference/geometry/detect_vertex_facet.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <set>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/box_tree.hpp"
#include "reference/geometry/closest_face.hpp"
#include "reference/geometry/grey_groups.hpp"
#include "reference/geometry/separation.hpp"
#include "reference/geometry/smallest.hpp"

namespace ogc::reference {
namespace {

using compare::VertexFacetContact;
using Grey = compare::GreyDecision<VertexFacetContact>;

/// Collects the results of one vertex.
struct VertexAnswer {
  std::vector<VertexFacetContact> contacts;
  std::vector<Grey> grey;
  std::size_t pairs = 0;
  bool near = false;
};

class VertexQuery {
 public:
  VertexQuery(const compare::DetectIn& in, Index vertex)
      : in_(in), mesh_{*in.topology, in.positions}, vertex_(vertex), x_(mesh_.at(vertex)) {}

  /// Visits one non-adjacent triangle whose box is near. Returns the distance, rounded down.
  float visit(Index t) {
    const auto [a, b, c] = mesh_.triangle(t);
    const Corners corners{mesh_.at(a), mesh_.at(b), mesh_.at(c)};
    const TriangleFeature feature = closest_feature(corners, x_);
    const Margin gap = feature_gap(corners, feature, x_);
    const float d = distance_below(gap);
    if (d < in_.query_radius) ++answer_.pairs;
    const bool within = d < in_.contact_radius;
    if (within) enter(face_of(mesh_, t, feature));
    answer_.near = answer_.near || examine(with_radius(gap, in_.contact_radius)).near ||
                   (within && near_feature(corners, feature, x_));
    if (within || grey(with_radius(gap, in_.contact_radius))) ask_about(t, corners);
    return d;
  }

  VertexAnswer finish() {
    for (const auto& group : doubtful_.groups()) {
      Grey decision;
      bool some_exact = false;
      for (const Face& face : group.keys) {
        decision.contacts.push_back(contact(face));
        some_exact = some_exact || entered(face);
      }
      decision.absence_accepted = group.absence || !some_exact;
      answer_.grey.push_back(std::move(decision));
    }
    std::sort(answer_.contacts.begin(), answer_.contacts.end());
    return std::move(answer_);
  }

 private:
  /// Returns the triangles that contain a face, ascending.
  std::vector<Index> triangles_around(Face face) const {
    if (face.kind == FaceKind::triangle) return {face.index};
    const auto i = static_cast<std::size_t>(face.index);
    const auto around = face.kind == FaceKind::vertex ? mesh_.topology.vertex_triangles[i]
                                                      : mesh_.topology.edge_triangles[i];
    return {around.begin(), around.end()};
  }

  VertexFacetContact contact(Face face) const { return {vertex_, face, triangles_around(face).front()}; }

  bool entered(Face face) const {
    return std::any_of(answer_.contacts.begin(), answer_.contacts.end(),
                       [&](const VertexFacetContact& c) { return c.face == face; });
  }

  /// Executes lines 9–20 of Alg. 1 for the closest face of a triangle.
  void enter(Face face) {
    if (entered(face)) return;
    if (face.kind != FaceKind::triangle) {
      bool inside = true;
      visit_block(mesh_, face, x_, [&](const Boundary& boundary) {
        const MarginAnswer margin = examine(boundary.condition.margin);
        answer_.near = answer_.near || margin.near;
        return inside = (margin.sign > 0) == boundary.condition.positive;
      });
      if (!inside) return;
    }
    answer_.contacts.push_back(contact(face));
  }

  /// Examines a triangle within r of the vertex. Notes which of the triangle's possibly closest faces are doubtful, and
  /// which faces could replace them.
  void ask_about(Index t, const Corners& corners) {
    const std::uint8_t features = possible_features(corners, x_);
    std::vector<Face> closest;
    for (int f = 0; f < 7; ++f) {
      if ((features >> f & 1) != 0) closest.push_back(face_of(mesh_, t, static_cast<TriangleFeature>(f)));
    }
    for (const Face face : closest) note(face);
    if (!has_area(corners)) note_ties(closest);
  }

  /// Notes all faces of a collapsed triangle that are equally close. Algorithm 1 enters one of them; the order of the
  /// corners decides which.
  void note_ties(const std::vector<Face>& closest) {
    for (const Face face : closest) {
      if (!membership(face).possible) continue;
      for (const Face other : closest) {
        if (other == face) continue;
        doubtful_.add(face, !membership(other).possible);
        doubtful_.join(face, other);
      }
    }
  }

  void note(Face face) {
    if (!noted_.insert(face).second) return;
    const Membership& inside = membership(face);
    if (!inside.possible || inside.certain) return;
    doubtful_.add(face, grey(face_gap(mesh_, face, x_, in_.contact_radius)));
    visit_block(mesh_, face, x_, [&](const Boundary& boundary) {
      if (!grey(boundary.condition.margin)) return true;
      if (membership(boundary.across).possible) {
        note(boundary.across);
        doubtful_.join(face, boundary.across);
      } else {
        doubtful_.add(face, true);
      }
      return true;
    });
  }

  const Membership& membership(Face face) {
    const auto known = known_.find(face);
    if (known != known_.end()) return known->second;
    return known_.emplace(face, decide(face)).first->second;
  }

  Membership decide(Face face) const {
    constexpr Membership outside{false, false, false};
    if (!is_candidate(face)) return outside;
    Membership inside;
    visit_block(mesh_, face, x_, [&](const Boundary& boundary) {
      require(inside, boundary.condition);
      return inside.possible;
    });
    if (!inside.possible) return inside;
    if (face.kind == FaceKind::triangle) {
      const auto [a, b, c] = mesh_.triangle(face.index);
      if (!has_area({mesh_.at(a), mesh_.at(b), mesh_.at(c)})) return outside;
    }
    const Margin gap = face_gap(mesh_, face, x_, in_.contact_radius);
    const bool below = sign(gap) < 0, doubtful = grey(gap);
    return {inside.exact && below, below || doubtful, inside.certain && below && !doubtful};
  }

  /// Returns whether the vertex and some triangle around the face are a pair that is not excluded (Eq. 12).
  bool is_candidate(Face face) const {
    const std::vector<Index> around = triangles_around(face);
    return std::any_of(around.begin(), around.end(), [&](Index t) {
      return !is_excluded(in_.exclusions, {&vertex_, 1}, mesh_.triangle(t));
    });
  }

  const compare::DetectIn& in_;
  Complex mesh_;
  Index vertex_;
  Vec3f x_;
  VertexAnswer answer_;
  std::map<Face, Membership> known_;
  std::set<Face> noted_;
  GreyGroups<Face> doubtful_;
};

BoxTree triangle_tree(const compare::DetectIn& in) {
  std::vector<Box> boxes(in.topology->triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    for (const Index v : in.topology->triangles[t]) include(boxes[t], in.positions[static_cast<std::size_t>(v)]);
  }
  return BoxTree(std::move(boxes));
}

/// Returns whether a pair is certainly too far apart to be a contact, even with rounding, and too far apart to lower a
/// smallest distance.
bool changes_nothing(const compare::DetectIn& in, Index v, Index t, Smallest& of_vertex, Smallest& of_triangle) {
  const compare::Triangle& corners = in.topology->triangles[static_cast<std::size_t>(t)];
  const auto at = [&](Index k) { return in.positions[static_cast<std::size_t>(k)]; };
  const double known = double{
      std::max(of_vertex.so_far(static_cast<std::size_t>(v)), of_triangle.so_far(static_cast<std::size_t>(t)))};
  return surely_beyond_triangle({at(v), at(corners[0]), at(corners[1]), at(corners[2])},
                                std::max(known, in.contact_radius * search_margin));
}

VertexAnswer query_vertex(const compare::DetectIn& in, DetectionExtent extent, const BoxTree& tree, Index v,
                          Smallest& of_vertex, Smallest& of_triangle) {
  if (!in.topology->on_surface(v)) return {};
  VertexQuery query(in, v);
  Box box;
  include(box, in.positions[static_cast<std::size_t>(v)]);
  tree.query(widened(box, in.query_radius * search_margin), [&](Index t) {
    const compare::Triangle& corners = in.topology->triangles[static_cast<std::size_t>(t)];
    if (std::find(corners.begin(), corners.end(), v) != corners.end() || !in.topology->on_surface(corners) ||
        is_excluded(in.exclusions, {&v, 1}, corners))
      return;
    if (extent == DetectionExtent::exact && changes_nothing(in, v, t, of_vertex, of_triangle)) return;
    const float d = query.visit(t);
    of_vertex.lower(static_cast<std::size_t>(v), d);
    of_triangle.lower(static_cast<std::size_t>(t), d);
  });
  return query.finish();
}

compare::DetectVertexFacetTruth detected(const compare::DetectIn& in, DetectionExtent extent) {
  const BoxTree tree = triangle_tree(in);
  const std::size_t count = in.positions.size();
  Smallest of_vertex(count, in.query_radius), of_triangle(in.topology->triangles.size(), in.query_radius);
  std::vector<VertexAnswer> answers(count);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16), [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t v = range.begin(); v < range.end(); ++v)
      answers[v] = query_vertex(in, extent, tree, static_cast<Index>(v), of_vertex, of_triangle);
  });
  compare::DetectVertexFacetTruth truth;
  for (VertexAnswer& answer : answers) {
    truth.pairs += answer.pairs;
    truth.near += answer.near;
    truth.exact.contacts.insert(truth.exact.contacts.end(), answer.contacts.begin(), answer.contacts.end());
    std::move(answer.grey.begin(), answer.grey.end(), std::back_inserter(truth.grey));
  }
  truth.exact.d_min_vertex = of_vertex.take();
  truth.exact.d_min_triangle = of_triangle.take();
  return truth;
}

}  // namespace

compare::DetectVertexFacetTruth detect_vertex_facet(const compare::DetectIn& in) {
  return detected(in, DetectionExtent::judged);
}
compare::DetectVertexFacetOut exact_vertex_facet(const compare::DetectIn& in) {
  return detected(in, DetectionExtent::exact).exact;
}

}  // namespace ogc::reference
