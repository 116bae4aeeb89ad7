// Forms of the two detections.
#include <algorithm>
#include <map>

#include "compare/judge/explain/form_tools.hpp"
#include "compare/judge/questions.hpp"

namespace ogc::compare {

namespace {

template <class Truth>
using Detection = std::function<Truth(const DetectIn&)> Authority::*;

/// The question is changed.
template <class Truth>
std::vector<WrongForm> question_forms(Detection<Truth> stage) {
  return {asked("groups_ignored", "pairs inside one rigid group are kept", stage,
                [](DetectIn& in) { in.exclusions.groups = {}; }),
          asked("excluded_pairs_ignored", "pairs beside a stitch are kept", stage,
                [](DetectIn& in) { in.exclusions.partners = nullptr; }),
          asked("query_radius_for_contact_radius", "contacts up to r_q, not up to r", stage,
                [](DetectIn& in) { in.contact_radius = in.query_radius; }),
          asked("half_the_contact_radius", "contacts up to r/2, not up to r", stage,
                [](DetectIn& in) { in.contact_radius /= 2; }),
          told("contacts_missing", "no contact at all", stage, [](const DetectIn&, Truth& truth) {
            truth.exact.contacts.clear();
            truth.grey.clear();
          })};
}

/// Which list a contact is kept in: by vertex, by triangle, by edge; one for all.
template <class Contact>
using Owner = Index (*)(const Contact&);

template <class Contact>
std::map<Index, std::size_t> lengths(const std::vector<Contact>& contacts, Owner<Contact> owner) {
  std::map<Index, std::size_t> count;
  for (const Contact& contact : contacts) ++count[owner(contact)];
  return count;
}

/// The longest list of all answers.
template <class Out, class Contact>
std::size_t cap_seen(std::span<const Evidence> evidence, std::function<Out(const DetectIn&)> Contestant::*answered,
                     Owner<Contact> owner) {
  std::size_t longest = 0;
  for (const Evidence& one : evidence) {
    const Out out = (one.answered.*answered)(detect_question(one.test));
    for (const auto& [list, count] : lengths<Contact>(out.contacts, owner)) longest = std::max(longest, count);
  }
  return longest;
}

/// Lists of at most `cap` contacts: which are missing from a full one, the answer says.
template <class Out, class Truth, class Contact>
WrongForm capped(std::string name, const std::string& list, std::size_t cap, Detection<Truth> stage,
                 std::function<Out(const DetectIn&)> Contestant::*answered, Owner<Contact> owner) {
  const std::string meaning = "at most " + std::to_string(cap) + " contacts " + list +
                              " are kept, and the others dropped";
  return {std::move(name), meaning, [=](const Evidence& evidence, const Authority& authority) {
            Authority wrong = authority;
            wrong.*stage = [&](const DetectIn& in) {
              Truth truth = (authority.*stage)(in);
              std::vector<Contact> kept = (evidence.answered.*answered)(in).contacts;
              std::sort(kept.begin(), kept.end());
              const auto given = lengths<Contact>(kept, owner);
              const auto is_full = [&](const Contact& contact) {
                const auto count = given.find(owner(contact));
                return count != given.end() && count->second == cap;
              };
              std::erase_if(truth.exact.contacts, [&](const Contact& c) {
                return is_full(c) && !std::binary_search(kept.begin(), kept.end(), c);
              });
              for (auto& decision : truth.grey)
                decision.absence_accepted = decision.absence_accepted ||
                                            std::any_of(decision.contacts.begin(), decision.contacts.end(), is_full);
              return truth;
            };
            return agrees(evidence, wrong);
          }};
}

}  // namespace

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

}  // namespace ogc::compare
