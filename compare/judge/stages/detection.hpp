// Holds the common parts of both detections: the verdict about a contact set, the traits of a stage whose case is a
// state, and forms that change the question or limit a list. The verdict sorts the exact set and the answered set and
// compares them:
//
// - A missing contact (exact, not answered) is accepted if a grey decision lists it, and either the answer has another
//   contact of this decision, or the decision accepts that all are missing. Otherwise a vertex could pass through the
//   gap in the covering by blocks.
// - An extra contact (answered, not exact) is accepted if a grey decision lists it.
// - Two answered contacts of one grey decision are wrong if a boundary separates their blocks (§3.3, local
//   exclusiveness). Both are accepted for two triangles at a slightly concave edge, and for pairs of edges because of
//   the rule for nearly parallel ones.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "compare/judge/cases/dust.hpp"
#include "compare/judge/cases/mutate.hpp"
#include "compare/judge/engine/features.hpp"
#include "compare/judge/engine/renumbering.hpp"
#include "compare/judge/engine/units.hpp"
#include "compare/judge/report/form_tools.hpp"
#include "compare/judge/stages/mesh_case.hpp"
#include "compare/judge/stages/parameter_ranges.hpp"
#include "compare/judge/stages/stage_of.hpp"

namespace ogc::compare {

/// Checks whether the sorted set holds the contact.
template <class Contact>
bool holds(const std::vector<Contact>& sorted, const Contact& contact) {
  return std::binary_search(sorted.begin(), sorted.end(), contact);
}

/// Checks whether the decision lists the contact.
template <class Contact>
bool lists(const GreyDecision<Contact>& decision, const Contact& contact) {
  return std::find(decision.contacts.begin(), decision.contacts.end(), contact) != decision.contacts.end();
}

/// Compares two sets of contacts. `excludes(topology, a, b)` returns whether a boundary of b's block separates the
/// blocks of the contacts a and b. If it does, an answer may have only one of these two contacts.
template <class Contact>
class SetVerdict {
 public:
  using Excludes = bool (*)(const Topology&, const Contact&, const Contact&);

  SetVerdict(std::vector<Contact> exact, std::vector<Contact> answer, const std::vector<GreyDecision<Contact>>& grey,
             const Topology& topology, Excludes excludes, Tally& tally)
      : exact_(std::move(exact)),
        answer_(std::move(answer)),
        grey_(grey),
        topology_(topology),
        excludes_(excludes),
        tally_(tally) {
    std::sort(exact_.begin(), exact_.end());
    std::sort(answer_.begin(), answer_.end());
  }

  /// Writes mismatches into the tally.
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
  /// Prints a contact in braces, which separate its commas from those of the message.
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
        if (excludes_(topology_, a, b) && holds(answer_, a) && holds(answer_, b)) {
          tally_.mismatch("contacts: " + print(a) + " and " + print(b) +
                          " stand side by side, and one is part of the other");
          return;
        }
  }

  std::vector<Contact> exact_, answer_;
  const std::vector<GreyDecision<Contact>>& grey_;
  const Topology& topology_;
  Excludes excludes_;
  Tally& tally_;
};

/// Returns ‖a − b‖ [m].
inline double length(const Vec3f& a, const Vec3f& b) {
  return std::hypot(double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z);
}

/// Returns an upper limit of the error scale of a smallest distance d. The scale is max(d, Σ|δ|) of the nearest pair,
/// which the judge does not know:
/// - δ is the position of a vertex of the pair relative to the pair's first vertex; ‖δ‖ ≤ d + `sides`, where `sides` is
///   the sum of the longest sides,
/// - |δ| is the sum of the moduli of δ's coordinates, at most √3 ‖δ‖,
/// - a pair of four vertices has three δ.
inline double pair_scale(double d, double sides) { return 3 * std::sqrt(3.0) * (d + sides); }

/// A stage whose answer is the contacts of a state. `S::kept(out)` returns the contacts as a set; `S::moved(out, to)`
/// returns the renumbered set.
template <class S, auto contestant, auto authority>
struct DetectionStage : MeshStage<S, contestant, authority>, InEveryRun {
  using Base = MeshStage<S, contestant, authority>;
  using typename Base::In;
  using typename Base::Out;
  using typename Base::Truth;
  using Case = MeshCase;
  /// Parameters that a problem string may set.
  static constexpr std::array parameters{ranges::contact_radius, ranges::query_radius};

  /// Sets the radii. Returns what makes them illegal together; empty if they are legal.
  static std::string set(Case& c, std::span<const Override> values) {
    for (const Override& value : values)
      (value.name == ranges::contact_radius.name ? c.contact_radius : c.query_radius) = value.value;
    return ranges::check_radii(c.contact_radius, c.query_radius);
  }
  /// Returns the table of both detections.
  static std::span<const Generator> generators() { return detect_generators(); }

  /// Checks the arrays by vertex, the coordinates and the radii.
  static void check(const Case& c, FirstProblem& problem) {
    const auto n = static_cast<std::size_t>(c.topology->vertex_count);
    problem.require(c.positions.size() == n && c.rigid_groups.size() == n,
                    "an array does not have one entry for each vertex");
    problem.vectors("a coordinate", c.positions);
    problem.number("a contact radius", c.contact_radius, 0x1p-60f, most_length);  // its square is a normal number
    problem.number("a query radius", c.query_radius, c.contact_radius, vast);
  }
  /// Moves positions; mesh and radii stay.
  static void mutate(Random& random, Case& c) { mutate_points(random, c.positions); }
  static std::vector<float*> coordinates(Case& c) { return coordinates_of({c.positions}); }
  /// `of_state` returns a whole frame of a run, `of_scene` a scene at its start.
  static Case of_state(const States& states, std::uint64_t index, Random& random) {
    return states.whole(states.frame(index), random);
  }
  static Case of_scene(const Scene& scene, const Contestant&) { return case_at_start(scene); }

  /// Write and read the state.
  static Json write(const Case& c) { return mesh_case_to_json(c); }
  static Case read(const Json& data) { return to_mesh_case(data); }

  /// Draws the mesh.
  static Shape shape(const Case& c) {
    Shape shape;
    shape.add(*c.topology, c.positions);
    return shape;
  }
  /// Lists radii, mesh, positions and exclusions.
  static std::vector<Quantity> inputs(const Case& c) {
    return joined({scalar("contact_radius", "m", c.contact_radius), scalar("query_radius", "m", c.query_radius)},
                  state_quantities(*c.topology, c.positions, c.rigid_groups, c.partners));
  }

  /// `mesh` returns the whole mesh, `part` the case of a part of the mesh.
  static const Topology* mesh(const Case& c) { return c.topology.get(); }
  static Case part(const Case& c, const MeshPart& part) {
    return {part.topology,
            MeshPart::picked(c.rigid_groups, part.vertices),
            MeshPart::picked(c.positions, part.vertices),
            c.contact_radius,
            c.query_radius,
            part.partners(c.partners)};
  }
  /// Returns the numbers that may be shortened: coordinates, and radii, which stay above 0.
  static ShortenedNumbers numbers(Case& c) { return {coordinates(c), {&c.contact_radius, &c.query_radius}}; }

  /// `question` returns a view of the case, `add` adds the bits of an answer.
  static In question(const Case& c) { return detect_question(c); }
  static void add(Bits& bits, const Out& out) { bits.add(out); }
  /// Returns a text with the number of grey decisions; empty if there are none.
  static std::string note(const Truth& truth) {
    return truth.grey.empty()
               ? ""
               : "grey: " + std::to_string(truth.grey.size()) + " decisions may go either way; the exact one is shown";
  }
  /// Lists the exact answer, with the same outputs as a contestant's answer.
  static std::vector<Quantity> outputs(const In& in, const Truth& truth) { return S::outputs(in, truth.exact); }

  /// Checks whether renumbering keeps the contacts. Owners and generating edges are not compared, because they depend
  /// on indices. Smallest distances are not compared, because their rounding depends on the order of corners and edges.
  /// The check holds only for generic cases: for collapsed triangles or edges a contestant may break ties by order.
  static bool is_same_renumbered(const TestCase& test, Random& random, const Contestant& c) {
    const auto& before = case_of<Case>(test.data);
    const Renumbering to(random, *before.topology);
    auto pairs = pairs_of(before.partners);
    for (auto& [a, b] : pairs) a = to.vertex(a), b = to.vertex(b);
    const Case after{to.topology(),
                     to.by_vertex(before.rigid_groups),
                     to.by_vertex(before.positions),
                     before.contact_radius,
                     before.query_radius,
                     partner_rows(before.positions.size(), pairs)};
    return S::moved((c.*contestant)(question(before)), to) == S::kept((c.*contestant)(question(after)));
  }
};

/// Lists the contacts of an answer by name.
template <class Contact>
Quantity contact_quantity(const std::vector<Contact>& all, const Topology& topology) {
  std::vector<std::string> names;
  for (const Contact& contact : all) names.push_back(contact_name(contact, topology));
  std::sort(names.begin(), names.end());
  return words("contacts", std::move(names));
}

template <class Truth>
using Detection = std::function<Truth(const DetectIn&)> Authority::*;

/// Returns wrong forms: right answers to changed questions, and an answer without contacts.
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

/// Returns the index of the vertex, triangle or edge whose list holds a contact. If all contacts are in one list,
/// returns the same index for all.
template <class Contact>
using Owner = Index (*)(const Contact&);

/// Returns the length of each list that is not empty.
template <class Contact>
std::map<Index, std::size_t> lengths(const std::vector<Contact>& contacts, Owner<Contact> owner) {
  std::map<Index, std::size_t> count;
  for (const Contact& contact : contacts) ++count[owner(contact)];
  return count;
}

/// Returns the length of the longest list among all answers.
template <class Out, class Contact>
std::size_t cap_seen(std::span<const Evidence> evidence, std::function<Out(const DetectIn&)> Contestant::*answered,
                     Owner<Contact> owner) {
  std::size_t longest = 0;
  for (const Evidence& one : evidence) {
    const Out out = (one.answered.*answered)(detect_question(case_of<MeshCase>(one.test.data)));
    for (const auto& [list, count] : lengths<Contact>(out.contacts, owner)) longest = std::max(longest, count);
  }
  return longest;
}

/// Makes the form that keeps at most `cap` contacts in each list. The answer decides which contacts a full list keeps.
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

}  // namespace ogc::compare
