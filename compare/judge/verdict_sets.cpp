// Verdicts of the two detections and of bound. Sets are brought into canonical order and compared as sorted keys:
//
//   exact, answered            right
//   exact, not answered        excused by a grey decision that holds it, if another contact of that decision is
//                              answered or absence is accepted
//   answered, not exact        excused by a grey decision that holds it
//   a and b answered, a ⊂ b    wrong in one grey decision: whatever the side of the boundary, their blocks share no
//                              point (§3.3, local exclusiveness). Two triangles across a slightly concave edge may
//                              stand side by side; so may edge pairs, by the rule for nearly parallel ones
//
// A missing contact that nothing replaces is named as a gap in the covering: there a vertex could pass unseen.
#include <algorithm>
#include <cmath>

#include "compare/judge/features.hpp"
#include "compare/judge/units.hpp"
#include "compare/judge/verdict.hpp"

namespace ogc::compare {

namespace {

bool is_part(const Topology& topology, const Face& a, const Face& b) {
  if (a.kind >= b.kind) return false;
  const auto i = static_cast<std::size_t>(b.index);
  const auto has = [&](const auto& items) { return std::find(items.begin(), items.end(), a.index) != items.end(); };
  if (b.kind == FaceKind::edge) return has(topology.edges[i]);
  return a.kind == FaceKind::vertex ? has(topology.triangles[i]) : has(topology.triangle_edges[i]);
}

/// Whether a's block lies on the other side of a boundary of b's.
bool excludes(const Topology& topology, const VertexFacetContact& a, const VertexFacetContact& b) {
  return a.vertex == b.vertex && is_part(topology, a.face, b.face);
}

/// Never: nearly parallel edges meet interior to interior also where an end is closest, beside the contact of that end
/// with the same edge that another edge at it generates.
bool excludes(const Topology&, const EdgeEdgeContact&, const EdgeEdgeContact&) { return false; }

template <class Contact>
bool holds(const std::vector<Contact>& sorted, const Contact& contact) {
  return std::binary_search(sorted.begin(), sorted.end(), contact);
}

template <class Contact>
bool lists(const GreyDecision<Contact>& decision, const Contact& contact) {
  return std::find(decision.contacts.begin(), decision.contacts.end(), contact) != decision.contacts.end();
}

template <class Contact>
class SetVerdict {
 public:
  SetVerdict(std::vector<Contact> exact, std::vector<Contact> answer, const std::vector<GreyDecision<Contact>>& grey,
             const Topology& topology, Tally& tally)
      : exact_(std::move(exact)), answer_(std::move(answer)), grey_(grey), topology_(topology), tally_(tally) {
    std::sort(exact_.begin(), exact_.end());
    std::sort(answer_.begin(), answer_.end());
  }

  void judge() {
    for (std::size_t i = 1; i < answer_.size(); ++i)
      if (answer_[i - 1] == answer_[i]) tally_.mismatch("contacts: " + print(answer_[i]) + " stands twice");
    for (const Contact& contact : exact_)
      if (!holds(answer_, contact)) judge_missing(contact);
    for (const Contact& contact : answer_)
      if (!holds(exact_, contact)) judge_extra(contact);
    for (const auto& decision : grey_) judge_decision(decision);
  }

 private:
  /// In braces, so that its commas end nothing.
  std::string print(const Contact& contact) const { return "{" + contact_name(contact, topology_) + "}"; }

  std::size_t answered(const GreyDecision<Contact>& decision) const {
    return static_cast<std::size_t>(std::count_if(decision.contacts.begin(), decision.contacts.end(),
                                                  [&](const Contact& c) { return holds(answer_, c); }));
  }

  void judge_missing(const Contact& contact) {
    bool listed = false;
    for (const auto& decision : grey_) {
      if (!lists(decision, contact)) continue;
      if (decision.absence_accepted || answered(decision) > 0) return tally_.answered_not_exactly();
      listed = true;
    }
    tally_.mismatch("contacts: " + print(contact) + " is missing" +
                    (listed ? ", and nothing that the grey zone allows stands for it (covering)" : ""));
  }

  void judge_extra(const Contact& contact) {
    const bool excused = std::any_of(grey_.begin(), grey_.end(),
                                     [&](const auto& decision) { return lists(decision, contact); });
    if (excused)
      tally_.answered_not_exactly();
    else
      tally_.mismatch("contacts: " + print(contact) + " is no contact");
  }

  void judge_decision(const GreyDecision<Contact>& decision) {
    for (const Contact& a : decision.contacts)
      for (const Contact& b : decision.contacts)
        if (excludes(topology_, a, b) && holds(answer_, a) && holds(answer_, b)) {
          tally_.mismatch("contacts: " + print(a) + " and " + print(b) +
                          " stand side by side, and one is part of the other");
          return;
        }
  }

  std::vector<Contact> exact_, answer_;
  const std::vector<GreyDecision<Contact>>& grey_;
  const Topology& topology_;
  Tally& tally_;
};

double length(const Vec3f& a, const Vec3f& b) {
  return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
}

double longest_side(const MeshCase& mesh, const Triangle& t) {
  const auto& x = mesh.positions;
  return std::max({length(x[t[0]], x[t[1]]), length(x[t[1]], x[t[2]]), length(x[t[2]], x[t[0]])});
}

/// The unit of a smallest distance is that of the pair which attains it, u max(d, Σ|δ|), and the judge does not know
/// that pair. Every point of it lies within d + (longest sides) of the case's first vertex, which bounds each |δ| by √3
/// times that: three of them for a pair of four vertices.
double pair_scale(double d, double sides) { return 3 * std::sqrt(3.0) * (d + sides); }

/// One value: never above the exact one, never negative, and not uselessly far below.
void judge_smallest(const char* what, std::size_t i, float value, float exact, double scale, std::size_t metric,
                    Tally& tally) {
  if (!(value <= exact)) {
    tally.mismatch(std::string(what) + " " + std::to_string(i) + text(": %.9g is above the exact %.9g", value, exact));
    return;
  }
  if (value < 0) {
    tally.mismatch(std::string(what) + " " + std::to_string(i) + text(": %.9g is negative, exact %.9g", value, exact));
    return;
  }
  const double error = double{exact} - value;
  tally.error(metric, in_units(error, scale),
              [&] { return std::string(what) + " " + std::to_string(i) + text(": %.9g, exact %.9g", value, exact); });
}

bool right_length(std::size_t length, std::size_t wanted, const char* what, Tally& tally) {
  if (length == wanted) return true;
  tally.mismatch(std::string(what) + " has " + std::to_string(length) + " entries instead of " +
                 std::to_string(wanted));
  return false;
}

}  // namespace

void judge_detect_vertex_facet(const TestCase& test, const DetectVertexFacetTruth& truth,
                               const DetectVertexFacetOut& out, Tally& tally) {
  const MeshCase& mesh = std::get<MeshCase>(test.data);
  const Topology& topology = *mesh.topology;
  tally.begin(test.name);
  tally.count(static_cast<std::uint64_t>(topology.vertex_count), truth.pairs, truth.grey.size(), truth.near);
  SetVerdict<VertexFacetContact>(truth.exact.contacts, out.contacts, truth.grey, topology, tally).judge();
  double longest = 0;
  for (const Triangle& t : topology.triangles) longest = std::max(longest, longest_side(mesh, t));
  if (right_length(out.d_min_vertex.size(), truth.exact.d_min_vertex.size(), "d_min_vertex", tally))
    for (std::size_t v = 0; v < out.d_min_vertex.size(); ++v)
      judge_smallest("vertex", v, out.d_min_vertex[v], truth.exact.d_min_vertex[v],
                     pair_scale(truth.exact.d_min_vertex[v], longest), 0, tally);
  if (right_length(out.d_min_triangle.size(), truth.exact.d_min_triangle.size(), "d_min_triangle", tally))
    for (std::size_t t = 0; t < out.d_min_triangle.size(); ++t)
      judge_smallest("triangle", t, out.d_min_triangle[t], truth.exact.d_min_triangle[t],
                     pair_scale(truth.exact.d_min_triangle[t], longest_side(mesh, topology.triangles[t])), 1, tally);
}

void judge_detect_edge_edge(const TestCase& test, const DetectEdgeEdgeTruth& truth, const DetectEdgeEdgeOut& out,
                            Tally& tally) {
  const MeshCase& mesh = std::get<MeshCase>(test.data);
  const Topology& topology = *mesh.topology;
  tally.begin(test.name);
  tally.count(topology.edges.size(), truth.pairs, truth.grey.size(), truth.near);
  SetVerdict<EdgeEdgeContact>(truth.exact.contacts, out.contacts, truth.grey, topology, tally).judge();
  if (!right_length(out.d_min_edge.size(), truth.exact.d_min_edge.size(), "d_min_edge", tally)) return;
  double longest = 0;
  for (const Edge& e : topology.edges) longest = std::max(longest, length(mesh.positions[e[0]], mesh.positions[e[1]]));
  for (std::size_t e = 0; e < out.d_min_edge.size(); ++e) {
    const Edge ends = topology.edges[e];
    const double sides = longest + length(mesh.positions[ends[0]], mesh.positions[ends[1]]);
    judge_smallest("edge", e, out.d_min_edge[e], truth.exact.d_min_edge[e],
                   pair_scale(truth.exact.d_min_edge[e], sides), 0, tally);
  }
}

void judge_bound(const TestCase& test, const BoundTruth& truth, const BoundOut& out, Tally& tally) {
  tally.begin(test.name);
  tally.count(truth.exact.bound.size(), truth.exact.bound.size(), 0);
  if (!right_length(out.bound.size(), truth.exact.bound.size(), "bound", tally)) return;
  for (std::size_t v = 0; v < out.bound.size(); ++v)
    judge_smallest("vertex", v, out.bound[v], truth.exact.bound[v], truth.exact.bound[v], 0, tally);
}

}  // namespace ogc::compare
