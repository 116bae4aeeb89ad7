// Makes the traits of stage detect_vertex_facet.
#include "compare/judge/stages/detection.hpp"

namespace ogc::compare {

namespace {

bool is_part(const Topology& topology, const Face& a, const Face& b) {
  if (a.kind >= b.kind) return false;
  const auto i = static_cast<std::size_t>(b.index);
  const auto has = [&](const auto& items) { return std::find(items.begin(), items.end(), a.index) != items.end(); };
  if (b.kind == FaceKind::edge) return has(topology.edges[i]);
  return a.kind == FaceKind::vertex ? has(topology.triangles[i]) : has(topology.triangle_edges[i]);
}

/// Checks whether two contacts of one vertex exclude each other. They do if a's face is an end, a corner or an edge of
/// b's face, because a boundary separates the blocks of such faces.
bool excludes(const Topology& topology, const VertexFacetContact& a, const VertexFacetContact& b) {
  return a.vertex == b.vertex && is_part(topology, a.face, b.face);
}

double longest_side(const MeshCase& mesh, const Triangle& t) {
  const auto& x = mesh.positions;
  return std::max({length(x[t[0]], x[t[1]]), length(x[t[1]], x[t[2]]), length(x[t[2]], x[t[0]])});
}

}  // namespace

void judge_detect_vertex_facet(const TestCase& test, const DetectVertexFacetTruth& truth,
                               const DetectVertexFacetOut& out, Tally& tally) {
  const MeshCase& mesh = case_of<MeshCase>(test.data);
  const Topology& topology = *mesh.topology;
  tally.begin(test.name);
  tally.count(static_cast<std::uint64_t>(topology.vertex_count), truth.pairs, truth.grey.size(), truth.near);
  SetVerdict<VertexFacetContact>(truth.exact.contacts, out.contacts, truth.grey, topology, excludes, tally).judge();
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

namespace {

std::vector<WrongForm> detect_vertex_facet_forms(std::span<const Evidence> evidence) {
  using Contact = VertexFacetContact;
  constexpr auto stage = &Authority::detect_vertex_facet;
  constexpr auto answered = &Contestant::detect_vertex_facet;
  std::vector<WrongForm> forms = question_forms(stage);
  const auto add = [&](const char* name, const char* list, Owner<Contact> owner) {
    const std::size_t cap = cap_seen<DetectVertexFacetOut, Contact>(evidence, answered, owner);
    forms.push_back(
        capped<DetectVertexFacetOut, DetectVertexFacetTruth, Contact>(name, list, cap, stage, answered, owner));
  };
  add("contacts_capped_by_vertex", "of a vertex", [](const Contact& c) { return c.vertex; });
  add("contacts_capped_by_triangle", "of a triangle", [](const Contact& c) { return c.owner; });
  add("contacts_capped_in_all", "in all", [](const Contact&) { return Index{0}; });
  const auto dropped = [&](const char* name, const char* meaning, bool (*drops)(const Contact&, const Topology&)) {
    forms.push_back(told(name, meaning, stage, [drops](const DetectIn& in, DetectVertexFacetTruth& truth) {
      std::erase_if(truth.exact.contacts, [&](const Contact& c) { return drops(c, *in.topology); });
      std::erase_if(truth.grey, [&](const auto& decision) {
        return std::any_of(decision.contacts.begin(), decision.contacts.end(),
                           [&](const Contact& c) { return drops(c, *in.topology); });
      });
    }));
  };
  dropped("one_ring_left_out", "pairs within one ring of edges are left out",
          [](const Contact& c, const Topology& topology) {
            const auto ring = topology.vertex_neighbours[static_cast<std::size_t>(c.vertex)];
            const Triangle& t = topology.triangles[static_cast<std::size_t>(c.owner)];
            return std::any_of(ring.begin(), ring.end(),
                               [&](Index v) { return std::find(t.begin(), t.end(), v) != t.end(); });
          });
  dropped("interiors_alone", "contacts with edges and vertices are dropped: those with interiors of triangles alone",
          [](const Contact& c, const Topology&) { return c.face.kind != FaceKind::triangle; });
  return forms;
}

struct DetectVertexFacet
    : DetectionStage<DetectVertexFacet, &Contestant::detect_vertex_facet, &Authority::detect_vertex_facet> {
  static constexpr StageInfo info{.name = "detect_vertex_facet",
                                  .question = "all vertex–facet contacts, smallest distances",
                                  .unit = "vertex",
                                  .reference = "reference/geometry/detect_vertex_facet.cpp",
                                  .kind = CaseKind::mesh,
                                  .has_boundary = true,
                                  .determinism = Determinism::cpu_to_gpu};
  static constexpr std::array metrics{MetricInfo{"d_min_vertex", "u max(d, Σ|δ|)", detect_below_tolerance},
                                      MetricInfo{"d_min_triangle", "u max(d, Σ|δ|)", detect_below_tolerance}};

  static constexpr auto judge = judge_detect_vertex_facet;
  using DetectionStage::outputs;
  static std::vector<Quantity> outputs(const In& in, const Out& out) {
    return {contact_quantity(out.contacts, *in.topology), compare::numbers("d_min_vertex", "m", out.d_min_vertex),
            compare::numbers("d_min_triangle", "m", out.d_min_triangle)};
  }
  static std::vector<WrongForm> wrong_forms(std::span<const Evidence> evidence) {
    return detect_vertex_facet_forms(evidence);
  }

  using Pairs = std::set<std::pair<Index, Face>>;
  static Pairs moved(const Out& out, const Renumbering& to) {
    Pairs pairs;
    for (const VertexFacetContact& c : out.contacts) pairs.insert({to.vertex(c.vertex), to.face(c.face)});
    return pairs;
  }
  static Pairs kept(const Out& out) {
    Pairs pairs;
    for (const VertexFacetContact& c : out.contacts) pairs.insert({c.vertex, c.face});
    return pairs;
  }
};

}  // namespace

constinit const StageTraits stages::detect_vertex_facet = make_traits<DetectVertexFacet>();

}  // namespace ogc::compare
