// Computes E_OGC twice: by its definition with exact quotients, and by Algorithm 2 over all pairs.
#include <algorithm>
#include <map>

#include "reference/definitions/contact_sets.hpp"
#include "reference/definitions/defined_blocks_exact.hpp"
#include "reference/geometry/closest_points.hpp"

namespace ogc::reference {
namespace {

using compare::EdgeEdgeContact;
using EdgeNumbers = std::array<Index, 2>;

using Entered = std::map<FacePair, EdgeNumbers>;

void enter(Entered& entered, const FacePair& faces, const EdgeNumbers& edges) {
  const auto [entry, is_new] = entered.try_emplace(faces, edges);
  if (!is_new) entry->second = std::min(entry->second, edges);
}

bool is_candidate(const compare::DetectIn& in, Index e, Index f) {
  const compare::Edge &a = in.topology->edges[static_cast<std::size_t>(e)],
                      &b = in.topology->edges[static_cast<std::size_t>(f)];
  if (!in.topology->on_surface(a) || !in.topology->on_surface(b)) return false;
  const bool adjacent = a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1];
  return !adjacent && !is_excluded(in.exclusions, a, b);
}

/// Calls visit(e, f) for all candidates, e < f, ascending.
template <class Visit>
void for_each_pair(const compare::DetectIn& in, Visit visit) {
  const auto count = static_cast<Index>(in.topology->edges.size());
  for (Index e = 0; e < count; ++e) {
    for (Index f = e + 1; f < count; ++f) {
      if (is_candidate(in, e, f)) visit(e, f);
    }
  }
}

bool is_on(const Complex& mesh, Face face, Index e) {
  return face == edge_face(e) || face == vertex_face(mesh.edge(e)[0]) || face == vertex_face(mesh.edge(e)[1]);
}

std::vector<EdgeEdgeContact> canonical(const Complex& mesh, const Entered& entered) {
  std::vector<EdgeEdgeContact> contacts;
  for (const auto& [faces, edges] : entered) {
    const bool in_order = is_on(mesh, faces.first, edges[0]);
    contacts.push_back({faces.first, faces.second, edges[in_order ? 0 : 1], edges[in_order ? 1 : 0]});
  }
  return contacts;
}

/// A segment a + s d, 0 ≤ s ≤ 1.
struct Segment {
  ExactVector a, d;
};

Segment segment_of(const Complex& mesh, Index e) {
  const ExactVector a = exact(mesh.at(mesh.edge(e)[0]));
  return {a, exact(mesh.at(mesh.edge(e)[1])) - a};
}

ExactVector end(const Segment& s, EdgeFeature feature) { return feature == EdgeFeature::end_0 ? s.a : plus(s.a, s.d); }

/// The parameter s / weight of a point on a segment, weight > 0.
struct Parameter {
  Exact s, weight;
  bool inside() const { return sign_of(s) > 0 && sign_of(weight - s) > 0; }
};

ExactPoint point_at(const Segment& segment, const Parameter& p) {
  return {plus(times(p.weight, segment.a), times(p.s, segment.d)), p.weight};
}

/// The closest points of two features. If a feature is an interior, its point lies strictly inside the edge.
struct Candidate {
  ExactPoint first, second;
};

std::optional<ExactPoint> foot_inside(const Segment& segment, const ExactVector& x) {
  const Parameter p{dot(x - segment.a, segment.d), dot(segment.d, segment.d)};
  return p.inside() ? std::optional(point_at(segment, p)) : std::nullopt;
}

std::optional<Candidate> between_lines(const Segment& e, const Segment& f) {
  const ExactVector w = f.a - e.a;
  const Exact ee = dot(e.d, e.d), ff = dot(f.d, f.d), ef = dot(e.d, f.d), we = dot(w, e.d), wf = dot(w, f.d);
  const Exact det = ee * ff - ef * ef;
  const Parameter s{we * ff - wf * ef, det}, t{we * ef - wf * ee, det};
  if (!s.inside() || !t.inside()) return std::nullopt;
  return Candidate{point_at(e, s), point_at(f, t)};
}

std::optional<Candidate> candidate(const Segment& e, const Segment& f, EdgeFeatures features) {
  const bool first_inside = features.first == EdgeFeature::interior,
             second_inside = features.second == EdgeFeature::interior;
  if (first_inside && second_inside) return between_lines(e, f);
  if (first_inside) {
    const ExactVector q = end(f, features.second);
    const auto foot = foot_inside(e, q);
    return foot ? std::optional(Candidate{*foot, {q}}) : std::nullopt;
  }
  const ExactVector p = end(e, features.first);
  if (!second_inside) return Candidate{{p}, {end(f, features.second)}};
  const auto foot = foot_inside(f, p);
  return foot ? std::optional(Candidate{{p}, *foot}) : std::nullopt;
}

Quotient<Exact> squared_distance(const Candidate& c) {
  const ExactVector d = times(c.second.weight, c.first.numerator) - times(c.first.weight, c.second.numerator);
  const Exact weight = c.first.weight * c.second.weight;
  return {dot(d, d), weight * weight};
}

bool smaller(const Quotient<Exact>& a, const Quotient<Exact>& b) {
  return sign_of(a.numerator * b.denominator - b.numerator * a.denominator) < 0;
}

struct Closest {
  EdgeFeatures features;
  Candidate points;
  Quotient<Exact> squared;
};

/// Returns the pairs of features with the smallest distance, in the order of edge_features. There are several if the
/// edges are parallel.
std::vector<Closest> closest_of(const Segment& e, const Segment& f) {
  std::vector<Closest> best;  // never empty: two ends are always a candidate
  for (int k = 0; k < edge_feature_pairs; ++k) {
    const auto found = candidate(e, f, edge_features(k));
    if (!found) continue;
    const Quotient<Exact> squared = squared_distance(*found);
    if (!best.empty() && smaller(best.front().squared, squared)) continue;
    if (!best.empty() && smaller(squared, best.front().squared)) best.clear();
    best.push_back({edge_features(k), *found, squared});
  }
  return best;
}

/// Tests the rule of method.md §1.4: ‖e×f‖² < 10⁻⁶ ‖e‖² ‖f‖², and projections that overlap in more than a point.
bool by_rule_parallel(const Segment& e, const Segment& f) {
  const ExactVector n = cross(e.d, f.d);
  const Exact ee = dot(e.d, e.d);
  if (sign_of(Exact(1e6) * dot(n, n) - ee * dot(f.d, f.d)) >= 0) return false;
  Exact low = dot(f.a - e.a, e.d), high = low + dot(f.d, e.d);
  if (sign_of(high - low) < 0) std::swap(low, high);
  return sign_of(high) > 0 && sign_of(ee - low) > 0 && sign_of(high - low) > 0;
}

std::array<Vec3f, 2> ends_of(const Complex& mesh, Index e) {
  return {mesh.at(mesh.edge(e)[0]), mesh.at(mesh.edge(e)[1])};
}

bool are_in_blocks(const Complex& mesh, const FacePair& faces) {
  bool inside = true;
  visit_pair(mesh, faces, [&](const PairBoundary& boundary) { return inside = holds(boundary.condition); });
  return inside;
}

/// Returns whether two nearly parallel edges have a pair of closest points that lie in the blocks of each other's
/// faces. Tests all pairs of features, because only closest points satisfy the conditions of these blocks. Exactly
/// parallel edges have closest points at both ends of the overlap.
bool is_some_end_in_blocks(const Complex& mesh, Index e, Index f) {
  for (int k = 0; k < edge_feature_pairs; ++k) {
    const auto [first, second] = edge_features(k);
    if (are_in_blocks(mesh, ordered(face_of(mesh, e, first), face_of(mesh, f, second)))) return true;
  }
  return false;
}

/// Executes lines 6–10 of Alg. 2 (corrected) for the candidate edges e < f.
void enter_if_active(const compare::DetectIn& in, const Complex& mesh, Index e, Index f, Entered& entered) {
  const EdgePair pair{ends_of(mesh, e), ends_of(mesh, f)};
  const EdgeFeatures closest = closest_features(pair);
  if (sign(with_radius(feature_gap(pair, closest), in.contact_radius)) >= 0) return;
  if (nearly_parallel(pair)) {
    const bool both_loose = mesh.is_loose(e) && mesh.is_loose(f);
    if (both_loose || is_some_end_in_blocks(mesh, e, f)) enter(entered, ordered(edge_face(e), edge_face(f)), {e, f});
    return;
  }
  const FacePair faces = ordered(face_of(mesh, e, closest.first), face_of(mesh, f, closest.second));
  if (are_in_blocks(mesh, faces)) enter(entered, faces, {e, f});
}

}  // namespace

std::vector<EdgeEdgeContact> edge_edge_by_definition(const compare::DetectIn& in) {
  const Complex mesh{*in.topology, in.positions};
  const DefinedBlocks blocks(mesh);
  const Exact r(static_cast<double>(in.contact_radius));
  Entered entered;
  for_each_pair(in, [&](Index e, Index f) {
    const Segment first = segment_of(mesh, e), second = segment_of(mesh, f);
    const std::vector<Closest> closest = closest_of(first, second);
    if (!smaller(closest.front().squared, {r * r, Exact(1)})) return;
    const auto in_both = [&](const Closest& points) {
      const Face p = face_of(mesh, e, points.features.first), q = face_of(mesh, f, points.features.second);
      return blocks.cones().contains_edge_only(p, points.points.second, in.contact_radius) &&
             blocks.cones().contains_edge_only(q, points.points.first, in.contact_radius);
    };
    if (by_rule_parallel(first, second)) {
      const bool both_loose = mesh.is_loose(e) && mesh.is_loose(f);
      if (both_loose || std::ranges::any_of(closest, in_both))
        enter(entered, ordered(edge_face(e), edge_face(f)), {e, f});
    } else if (in_both(closest.front())) {
      const EdgeFeatures features = closest.front().features;
      enter(entered, ordered(face_of(mesh, e, features.first), face_of(mesh, f, features.second)), {e, f});
    }
  });
  return canonical(mesh, entered);
}

std::vector<EdgeEdgeContact> edge_edge_over_all_pairs(const compare::DetectIn& in) {
  const Complex mesh{*in.topology, in.positions};
  Entered entered;
  for_each_pair(in, [&](Index e, Index f) { enter_if_active(in, mesh, e, f, entered); });
  return canonical(mesh, entered);
}

std::vector<std::vector<std::size_t>> contacts_of_edges(const compare::Topology& topology,
                                                        std::span<const EdgeEdgeContact> contacts) {
  std::vector<std::vector<std::size_t>> rows(topology.edges.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    rows[static_cast<std::size_t>(contacts[i].first_edge)].push_back(i);
    rows[static_cast<std::size_t>(contacts[i].second_edge)].push_back(i);
  }
  return rows;
}

}  // namespace ogc::reference
