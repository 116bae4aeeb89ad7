// Sorts generated pairs by faces, then by edges. So all pairs of edges that generate the same contact are adjacent, and
// the lowest-numbered pair of edges is the first.
#include "reference/geometry/generated_pairs.hpp"

#include <algorithm>
#include <map>
#include <span>

#include "reference/geometry/grey_groups.hpp"

namespace ogc::reference {
namespace {

using compare::EdgeEdgeContact;
using Grey = compare::GreyDecision<EdgeEdgeContact>;

bool is_on(const Complex& mesh, Face face, Index edge) {
  if (face.kind == FaceKind::edge) return face.index == edge;
  return mesh.edge(edge)[0] == face.index || mesh.edge(edge)[1] == face.index;
}

/// Returns the contact; its edges are in the order of its faces.
EdgeEdgeContact contact(const Complex& mesh, const Generated& g) {
  if (is_on(mesh, g.faces.first, g.edge)) return {g.faces.first, g.faces.second, g.edge, g.other};
  return {g.faces.first, g.faces.second, g.other, g.edge};
}

struct Candidate {
  std::span<const Generated> generators;
  bool certain() const { return first_certain() != generators.end(); }
  std::span<const Generated>::iterator first_certain() const {
    return std::find_if(generators.begin(), generators.end(), [](const Generated& g) { return g.certain; });
  }
  const Generated* first_exact() const {
    const auto it = std::find_if(generators.begin(), generators.end(), [](const Generated& g) { return g.exact; });
    return it == generators.end() ? nullptr : &*it;
  }
};

using Candidates = std::map<FacePair, Candidate>;

Candidates candidates_of(std::span<const Generated> sorted) {
  Candidates candidates;
  for (std::size_t i = 0; i < sorted.size();) {
    std::size_t end = i + 1;
    while (end < sorted.size() && sorted[end].faces == sorted[i].faces) ++end;
    candidates.emplace_hint(candidates.end(), sorted[i].faces, Candidate{sorted.subspan(i, end - i)});
    i = end;
  }
  return candidates;
}

/// Adds a grey decision if a contact is certain, but its lowest-numbered pair of edges is not certain. The decision
/// accepts the contact with each pair of edges up to the first certain pair.
void add_doubtful_owner(const Complex& mesh, const Candidate& candidate, std::vector<Grey>& grey) {
  const auto certain = candidate.first_certain();
  if (certain == candidate.generators.begin()) return;
  Grey decision;
  for (auto it = candidate.generators.begin(); it != certain + 1; ++it) decision.contacts.push_back(contact(mesh, *it));
  grey.push_back(std::move(decision));
}

GreyGroups<FacePair> doubtful_pairs(const Candidates& candidates, const std::vector<Doubt>& doubts) {
  GreyGroups<FacePair> doubtful;
  for (const auto& [faces, candidate] : candidates) {
    if (!candidate.certain()) doubtful.add(faces, false);
  }
  for (const Doubt& doubt : doubts) {
    if (doubt.joined) {
      doubtful.join(doubt.faces, doubt.other);
    } else if (doubtful.contains(doubt.faces)) {
      doubtful.add(doubt.faces, true);
    }
  }
  return doubtful;
}

/// Sorts the decisions. Removes repeated contacts, and decisions that leave no choice.
void tidy(std::vector<Grey>& grey) {
  for (Grey& decision : grey) {
    std::sort(decision.contacts.begin(), decision.contacts.end());
    decision.contacts.erase(std::unique(decision.contacts.begin(), decision.contacts.end()), decision.contacts.end());
  }
  std::erase_if(grey, [](const Grey& decision) { return decision.contacts.size() == 1 && !decision.absence_accepted; });
  std::sort(grey.begin(), grey.end(), [](const Grey& a, const Grey& b) { return a.contacts < b.contacts; });
}

}  // namespace

Assembled assemble(const Complex& mesh, std::vector<Generated> generated, const std::vector<Doubt>& doubts) {
  std::sort(generated.begin(), generated.end());
  const Candidates candidates = candidates_of(generated);
  Assembled result;
  for (const auto& [faces, candidate] : candidates) {
    if (const Generated* lowest = candidate.first_exact()) result.contacts.push_back(contact(mesh, *lowest));
    if (candidate.certain()) add_doubtful_owner(mesh, candidate, result.grey);
  }
  for (const auto& group : doubtful_pairs(candidates, doubts).groups()) {
    Grey decision;
    bool some_exact = false;
    for (const FacePair& faces : group.keys) {
      const Candidate& candidate = candidates.at(faces);
      some_exact = some_exact || candidate.first_exact() != nullptr;
      for (const Generated& g : candidate.generators) decision.contacts.push_back(contact(mesh, g));
    }
    decision.absence_accepted = group.absence || !some_exact;
    result.grey.push_back(std::move(decision));
  }
  tidy(result.grey);
  return result;
}

}  // namespace ogc::reference
