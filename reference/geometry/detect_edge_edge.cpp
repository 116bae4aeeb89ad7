// Runs Algorithm 2 over unordered pairs; each pair is visited once, from its lower-numbered edge. A separate pass
// examines the grey zone, for all nine pairs of faces of two edges within r.
#include "reference/geometry/detect_edge_edge.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "reference/geometry/box_tree.hpp"
#include "reference/geometry/closest_points.hpp"
#include "reference/geometry/generated_pairs.hpp"
#include "reference/geometry/separation.hpp"
#include "reference/geometry/smallest.hpp"

namespace ogc::reference {
namespace {

/// Returns whether the edges are on the surface, not adjacent and not excluded.
bool is_candidate_pair(const compare::DetectIn& in, Index e, Index f) {
  const compare::Edge &a = in.topology->edges[static_cast<std::size_t>(e)],
                      &b = in.topology->edges[static_cast<std::size_t>(f)];
  if (!in.topology->on_surface(a) || !in.topology->on_surface(b)) return false;
  const bool adjacent = a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
  return !adjacent && !is_excluded(in.exclusions, a, b);
}

/// Collects the results of all pairs of an edge with higher-numbered edges.
struct EdgeAnswer {
  std::vector<Generated> generated;
  std::vector<Doubt> doubts;
  std::size_t pairs = 0;
  std::vector<Index> near;  ///< the other edge of each pair with a decision near its boundary
};

class EdgeQuery {
 public:
  EdgeQuery(const compare::DetectIn& in, Index edge) : in_(in), mesh_{*in.topology, in.positions}, edge_(edge) {}

  /// Visits one non-adjacent, higher-numbered edge whose box is near. Returns the distance, rounded down.
  float visit(Index other) {
    const EdgePair pair{ends(edge_), ends(other)};
    const EdgeFeatures closest = closest_features(pair);
    const Margin gap = with_radius(feature_gap(pair, closest), in_.contact_radius);
    const float d = distance_below(gap);
    if (d < in_.query_radius) ++answer_.pairs;
    const MarginAnswer reach = examine(gap);
    const bool within = d < in_.contact_radius, doubtful = reach.grey;
    if (reach.near || (within && is_near_decision(pair, closest, nearly_parallel(pair)))) answer_.near.push_back(other);
    if (within || doubtful) enter(other, pair, closest, within, doubtful);
    return d;
  }

  EdgeAnswer finish() { return std::move(answer_); }

 private:
  std::array<Vec3f, 2> ends(Index e) const { return {mesh_.at(mesh_.edge(e)[0]), mesh_.at(mesh_.edge(e)[1])}; }

  FacePair faces_of(Index other, EdgeFeatures features) const {
    return ordered(face_of(mesh_, edge_, features.first), face_of(mesh_, other, features.second));
  }

  std::vector<Index> edges_around(Face face) const {
    if (face.kind == FaceKind::edge) return {face.index};
    const auto around = mesh_.edges_of(face.index);
    return {around.begin(), around.end()};
  }

  /// Returns whether an edge of the first face and an edge of the second are a candidate pair.
  bool is_candidate(const FacePair& faces) const {
    const std::vector<Index> first = edges_around(faces.first), second = edges_around(faces.second);
    return std::any_of(first.begin(), first.end(), [&](Index e) {
      return std::any_of(second.begin(), second.end(), [&](Index f) { return is_candidate_pair(in_, e, f); });
    });
  }

  void add(const FacePair& faces, Index other, bool exact, bool certain) {
    answer_.generated.push_back({faces, edge_, other, exact, certain});
  }

  FacePair interiors(Index other) const { return ordered(edge_face(edge_), edge_face(other)); }

  void enter(Index other, const EdgePair& pair, EdgeFeatures closest, bool within, bool doubtful) {
    const Membership rule = are_nearly_parallel(pair);
    if (rule.possible) enter_interiors(other, pair, rule, within, doubtful);
    if (rule.certain) return;
    const Membership local = are_closest(pair, closest);
    // If the rule for nearly parallel edges does not hold, the two edges may have no contact. So an answer without the
    // contact of their interiors is accepted.
    if (rule.possible && !(local.certain && membership(faces_of(other, closest)).certain)) accept_absence(other);
    enter_features(other, pair, closest, closest, rule);
    if (local.certain) return;
    for (int k = 0; k < edge_feature_pairs; ++k) {
      if (edge_features(k) != closest) enter_features(other, pair, edge_features(k), closest, rule);
    }
  }

  void accept_absence(Index other) { answer_.doubts.push_back({interiors(other), interiors(other), false}); }

  /// Adds the contact that the rule for nearly parallel edges gives.
  void enter_interiors(Index other, const EdgePair& pair, const Membership& rule, bool within, bool doubtful) {
    const bool both_loose = mesh_.is_loose(edge_) && mesh_.is_loose(other);
    const Membership tested = both_loose ? Membership{} : in_blocks_where_closest(other, pair);
    if (!tested.possible) return;
    add(interiors(other), other, rule.exact && tested.exact && within,
        rule.certain && tested.certain && within && !doubtful);
    if (doubtful || !tested.certain) accept_absence(other);
  }

  /// Returns whether the closest points of nearly parallel edges lie in the block of the other edge's face. Exactly
  /// parallel edges have closest points at both ends of the overlap; one end is enough. The answer is certain if all
  /// possibly closest pairs of features certainly pass, or if a certainly closest pair certainly passes.
  Membership in_blocks_where_closest(Index other, const EdgePair& pair) const {
    Membership some{false, false, false};
    bool all_certain = true;
    for (int k = 0; k < edge_feature_pairs; ++k) {
      const Membership local = are_closest(pair, edge_features(k));
      if (!local.possible) continue;
      const Membership inside = in_other_blocks(other, edge_features(k));
      some.exact = some.exact || (local.exact && inside.exact);
      some.possible = some.possible || inside.possible;
      some.certain = some.certain || (local.certain && inside.certain);
      all_certain = all_certain && inside.certain;
    }
    some.certain = some.certain || all_certain;
    return some;
  }

  /// Returns whether each closest point lies in the block of the other feature. Leaves out the conditions that separate
  /// features of the same two edges, because are_closest decides these.
  Membership in_other_blocks(Index other, EdgeFeatures features) const {
    Membership inside;
    visit_pair(mesh_, faces_of(other, features), [&](const PairBoundary& boundary) {
      const FacePair& across = boundary.across;
      const bool is_own = (is_on(across.first, edge_) && is_on(across.second, other)) ||
                          (is_on(across.first, other) && is_on(across.second, edge_));
      if (!is_own) require(inside, boundary.condition);
      return inside.possible;
    });
    return inside;
  }

  bool is_on(Face face, Index e) const {
    if (face.kind == FaceKind::edge) return face.index == e;
    return face.index == mesh_.edge(e)[0] || face.index == mesh_.edge(e)[1];
  }

  /// Adds one of the nine pairs of faces. Skips a pair that certainly ties with the closest pair (edges of zero
  /// length). Of these two pairs, the first in the order of closest_features is the contact.
  void enter_features(Index other, const EdgePair& pair, EdgeFeatures features, EdgeFeatures closest,
                      const Membership& rule) {
    const FacePair faces = faces_of(other, features);
    const bool is_closest = features == closest;
    if (!is_closest) {
      const Membership local = are_closest(pair, features);
      if (!local.possible || local.certain) return;
    }
    const Membership inside = membership(faces);
    if (!inside.possible) return;
    // If the rule for nearly parallel edges may hold, this pair of faces is doubtful. Only the pair of interiors is not
    // doubtful, because it is the contact with and without the rule.
    const bool is_interiors = features == EdgeFeatures{EdgeFeature::interior, EdgeFeature::interior};
    const bool unaffected = is_interiors || !rule.possible;
    add(faces, other, is_closest && inside.exact && (is_interiors || !rule.exact),
        is_closest && inside.certain && unaffected);
    if (!unaffected) answer_.doubts.push_back({faces, interiors(other), true});
    if (!inside.certain) note_boundaries(faces);
  }

  void note_boundaries(const FacePair& faces) {
    if (grey(pair_gap(mesh_, faces, in_.contact_radius))) answer_.doubts.push_back({faces, faces, false});
    visit_pair(mesh_, faces, [&](const PairBoundary& boundary) {
      if (!grey(boundary.condition.margin)) return true;
      const bool replaced = is_candidate(boundary.across) && membership(boundary.across).possible;
      answer_.doubts.push_back({faces, replaced ? boundary.across : faces, replaced});
      return true;
    });
  }

  Membership membership(const FacePair& faces) const {
    Membership inside;
    visit_pair(mesh_, faces, [&](const PairBoundary& boundary) {
      require(inside, boundary.condition);
      return inside.possible;
    });
    if (!inside.possible) return inside;
    const Margin gap = pair_gap(mesh_, faces, in_.contact_radius);
    const MarginAnswer reach = examine(gap);
    const bool below = reach.sign < 0, doubtful = reach.grey;
    return {inside.exact && below, below || doubtful, inside.certain && below && !doubtful};
  }

  const compare::DetectIn& in_;
  Complex mesh_;
  Index edge_;
  EdgeAnswer answer_;
};

std::vector<Box> edge_boxes(const compare::DetectIn& in) {
  std::vector<Box> boxes(in.topology->edges.size());
  for (std::size_t e = 0; e < boxes.size(); ++e) {
    for (const Index v : in.topology->edges[e]) include(boxes[e], in.positions[static_cast<std::size_t>(v)]);
  }
  return boxes;
}

/// Returns whether a pair is certainly too far apart to be a contact, even with rounding, and too far apart to lower a
/// smallest distance.
bool changes_nothing(const compare::DetectIn& in, Index e, Index other, Smallest& of_edge) {
  const compare::Edge &a = in.topology->edges[static_cast<std::size_t>(e)],
                      &b = in.topology->edges[static_cast<std::size_t>(other)];
  const auto at = [&](Index k) { return in.positions[static_cast<std::size_t>(k)]; };
  const double known = double{
      std::max(of_edge.so_far(static_cast<std::size_t>(e)), of_edge.so_far(static_cast<std::size_t>(other)))};
  return surely_beyond_edge({at(a[0]), at(a[1]), at(b[0]), at(b[1])},
                            std::max(known, in.contact_radius * search_margin));
}

EdgeAnswer query_edge(const compare::DetectIn& in, DetectionExtent extent, const BoxTree& tree, const Box& box, Index e,
                      Smallest& of_edge) {
  EdgeQuery query(in, e);
  tree.query(widened(box, in.query_radius * search_margin), [&](Index other) {
    if (other <= e || !is_candidate_pair(in, e, other)) return;
    if (extent == DetectionExtent::exact && changes_nothing(in, e, other, of_edge)) return;
    const float d = query.visit(other);
    of_edge.lower(static_cast<std::size_t>(e), d);
    of_edge.lower(static_cast<std::size_t>(other), d);
  });
  return query.finish();
}

compare::DetectEdgeEdgeTruth detected(const compare::DetectIn& in, DetectionExtent extent) {
  const std::vector<Box> boxes = edge_boxes(in);
  const BoxTree tree(boxes);
  Smallest of_edge(boxes.size(), in.query_radius);
  std::vector<EdgeAnswer> answers(boxes.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, boxes.size(), 16),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t e = range.begin(); e < range.end(); ++e)
                        answers[e] = query_edge(in, extent, tree, boxes[e], static_cast<Index>(e), of_edge);
                    });
  compare::DetectEdgeEdgeTruth truth;
  std::vector<Generated> generated;
  std::vector<Doubt> doubts;
  std::vector<bool> near(boxes.size());
  for (std::size_t e = 0; e < answers.size(); ++e) {
    const EdgeAnswer& answer = answers[e];
    truth.pairs += answer.pairs;
    for (const Index other : answer.near) near[static_cast<std::size_t>(other)] = near[e] = true;
    generated.insert(generated.end(), answer.generated.begin(), answer.generated.end());
    doubts.insert(doubts.end(), answer.doubts.begin(), answer.doubts.end());
  }
  Assembled assembled = assemble({*in.topology, in.positions}, std::move(generated), doubts);
  truth.exact.contacts = std::move(assembled.contacts);
  truth.exact.d_min_edge = of_edge.take();
  truth.near = static_cast<std::size_t>(std::count(near.begin(), near.end(), true));
  truth.grey = std::move(assembled.grey);
  return truth;
}

}  // namespace

compare::DetectEdgeEdgeTruth detect_edge_edge(const compare::DetectIn& in) {
  return detected(in, DetectionExtent::judged);
}
compare::DetectEdgeEdgeOut exact_edge_edge(const compare::DetectIn& in) {
  return detected(in, DetectionExtent::exact).exact;
}

}  // namespace ogc::reference
