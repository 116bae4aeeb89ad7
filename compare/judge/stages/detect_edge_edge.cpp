// Makes the traits of stage detect_edge_edge.
#include "compare/judge/stages/detection.hpp"

namespace ogc::compare {

namespace {

/// Returns false: no contacts exclude each other. Nearly parallel edges make a contact of interiors even if an end is
/// closest. Another edge at that end may add a contact of the end; both are right.
bool excludes(const Topology&, const EdgeEdgeContact&, const EdgeEdgeContact&) { return false; }

}  // namespace

void judge_detect_edge_edge(const TestCase& test, const DetectEdgeEdgeTruth& truth, const DetectEdgeEdgeOut& out,
                            Tally& tally) {
  const MeshCase& mesh = case_of<MeshCase>(test.data);
  const Topology& topology = *mesh.topology;
  tally.begin(test.name);
  tally.count(topology.edges.size(), truth.pairs, truth.grey.size(), truth.near);
  SetVerdict<EdgeEdgeContact>(truth.exact.contacts, out.contacts, truth.grey, topology, excludes, tally).judge();
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

namespace {

std::vector<WrongForm> detect_edge_edge_forms(std::span<const Evidence> evidence) {
  using Contact = EdgeEdgeContact;
  constexpr auto stage = &Authority::detect_edge_edge;
  constexpr auto answered = &Contestant::detect_edge_edge;
  std::vector<WrongForm> forms = question_forms(stage);
  const auto add = [&](const char* name, const char* list, Owner<Contact> owner) {
    const std::size_t cap = cap_seen<DetectEdgeEdgeOut, Contact>(evidence, answered, owner);
    forms.push_back(capped<DetectEdgeEdgeOut, DetectEdgeEdgeTruth, Contact>(name, list, cap, stage, answered, owner));
  };
  add("contacts_capped_by_edge", "of a lower-numbered edge", [](const Contact& c) { return c.first_edge; });
  add("contacts_capped_in_all", "in all", [](const Contact&) { return Index{0}; });
  forms.push_back(told("interiors_alone", "contacts with vertices are dropped: those between interiors of edges alone",
                       stage, [](const DetectIn&, DetectEdgeEdgeTruth& truth) {
                         const auto has_vertex = [](const Contact& c) {
                           return c.first.kind == FaceKind::vertex || c.second.kind == FaceKind::vertex;
                         };
                         std::erase_if(truth.exact.contacts, has_vertex);
                         std::erase_if(truth.grey, [&](const auto& d) {
                           return std::any_of(d.contacts.begin(), d.contacts.end(), has_vertex);
                         });
                       }));
  forms.push_back(told("edges_swapped", "the two edges of a contact exchanged", stage,
                       [](const DetectIn&, DetectEdgeEdgeTruth& truth) {
                         for (Contact& c : truth.exact.contacts) std::swap(c.first_edge, c.second_edge);
                       }));
  return forms;
}

struct DetectEdgeEdge : DetectionStage<DetectEdgeEdge, &Contestant::detect_edge_edge, &Authority::detect_edge_edge> {
  static constexpr StageInfo info{.name = "detect_edge_edge",
                                  .question = "all edge–edge contacts, smallest distances",
                                  .unit = "edge",
                                  .reference = "reference/geometry/detect_edge_edge.cpp",
                                  .kind = CaseKind::mesh,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"d_min_edge", "u max(d, Σ|δ|)", detect_below_tolerance}};

  static constexpr auto judge = judge_detect_edge_edge;
  using DetectionStage::outputs;
  static std::vector<Quantity> outputs(const In& in, const Out& out) {
    return {contact_quantity(out.contacts, *in.topology), compare::numbers("d_min_edge", "m", out.d_min_edge)};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence> evidence) {
    return detect_edge_edge_forms(evidence);
  }

  using Pairs = std::set<std::pair<Face, Face>>;
  static Pairs moved(const Out& out, const Renumbering& to) {
    Pairs pairs;
    for (const EdgeEdgeContact& c : out.contacts) pairs.insert(std::minmax(to.face(c.first), to.face(c.second)));
    return pairs;
  }
  static Pairs kept(const Out& out) {
    Pairs pairs;
    for (const EdgeEdgeContact& c : out.contacts) pairs.insert({c.first, c.second});
    return pairs;
  }
};

}  // namespace

constinit const StageTraits stages::detect_edge_edge = make_traits<DetectEdgeEdge>();

}  // namespace ogc::compare
