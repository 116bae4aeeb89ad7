#include "reference/ipc/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "reference/ipc/broad_phase.hpp"

namespace ogc::reference {
namespace {

using compare::at, compare::Index;
using compare::ContactSides;
using compare::Topology;

/// Returns a term with only the vertices that `form` uses. Their order depends only on their indices, so that equal
/// terms compare equal.
BarrierTerm lone_term(const ClosestForm& form, const std::array<Index, 4>& vertex) {
  BarrierTerm term;
  term.count = form.kind == FormKind::points ? 2 : form.kind == FormKind::point_line ? 3 : 4;
  std::array<std::uint8_t, 4> place{form.at};
  const std::size_t first = term.count == 3 ? 1 : 0;
  if (term.count < 4 && vertex[place[first]] > vertex[place[first + 1]]) std::swap(place[first], place[first + 1]);
  term.form.kind = form.kind;
  for (std::uint8_t k = 0; k < term.count; ++k) {
    term.form.at[k] = k;
    term.vertex[k] = vertex[place[k]];
    term.form.weight[k] = form.weight[place[k]];
  }
  return term;
}

/// The squared distance and closest points of a pair.
struct Measured {
  double squared = 0;
  ClosestForm form;
  std::array<Index, 4> vertex;
  std::array<Triple<double>, 4> corners;
};

Measured measured(const Topology& topology, const PrimitivePair& pair, const State& x) {
  Measured m;
  m.vertex = vertices_of(topology, pair);
  m.corners = corners_of(m.vertex, x);
  m.form = pair.sides == ContactSides::edge_edge ? closest_edges(m.corners) : closest_form(pair.sides, m.corners);
  m.squared = squared_form_distance(m.form, m.corners);
  return m;
}

BarrierTerm term_of(const PairMesh& mesh, const PrimitivePair& pair, const Measured& m) {
  if (pair.sides == ContactSides::edge_edge) {
    const double rest = double{mesh.edge_length_squared[at(pair.first)]} *
                        double{mesh.edge_length_squared[at(pair.second)]};
    if (Mollifier<double>(m.corners[1] - m.corners[0], m.corners[3] - m.corners[2], rest, 1).acts()) {
      BarrierTerm term{m.vertex, 4, m.form, 1, rest};
      return term;
    }
  }
  return lone_term(m.form, m.vertex);
}

auto order_of(const BarrierTerm& term) { return std::tie(term.count, term.vertex); }

/// Merges equal terms (of two vertices, or of a vertex and an edge) from several pairs into one term, weighted by their
/// number. The weight is exact, so the order of the terms does not matter.
void merge(std::vector<BarrierTerm>& terms) {
  const auto mergeable = std::stable_partition(terms.begin(), terms.end(),
                                               [](const BarrierTerm& term) { return term.count == 4; });
  std::sort(mergeable, terms.end(),
            [](const BarrierTerm& a, const BarrierTerm& b) { return order_of(a) < order_of(b); });
  auto kept = mergeable;
  for (auto next = mergeable; next != terms.end(); ++next) {
    if (kept != next && order_of(*kept) == order_of(*next)) {
      kept->weight += next->weight;
    } else if (next != mergeable) {
      *++kept = *next;
    }
  }
  if (mergeable != terms.end()) terms.erase(kept + 1, terms.end());
}

/// Collects the barriers of the pairs that one thread handles.
struct BarrierPart {
  BarrierSet set;
  double squared = std::numeric_limits<double>::infinity();  ///< squared distance of the closest pair [m²]

  void add(const PairMesh& mesh, const BarrierShape& shape, const PrimitivePair& pair, const State& x) {
    const Measured m = measured(mesh.topology, pair, x);
    const double gap = shape.gap(m.squared);
    if (!(gap < shape.support())) return;
    if (m.squared < squared) squared = m.squared, set.closest = pair;
    if (gap <= 0) {
      set.touching.push_back(pair);
      return;
    }
    set.active.push_back(pair);
    set.squared.push_back(m.squared);
    set.terms.push_back(term_of(mesh, pair, m));
  }

  void append(const BarrierPart& other) {
    const auto extend = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    extend(set.active, other.set.active);
    extend(set.squared, other.set.squared);
    extend(set.terms, other.set.terms);
    extend(set.touching, other.set.touching);
    if (other.squared < squared) squared = other.squared, set.closest = other.set.closest;
  }
};

}  // namespace

std::array<Index, 4> vertices_of(const Topology& topology, const PrimitivePair& pair) {
  if (pair.sides == ContactSides::edge_edge) {
    const compare::Edge &e = topology.edges[at(pair.first)], &f = topology.edges[at(pair.second)];
    return {e[0], e[1], f[0], f[1]};
  }
  const compare::Triangle& t = topology.triangles[at(pair.second)];
  return {pair.first, t[0], t[1], t[2]};
}

std::string describe(const Topology& topology, const PrimitivePair& pair, const compare::ElementNames& names) {
  if (pair.sides == ContactSides::edge_edge)
    return names.edge(topology.edges[at(pair.first)]) + " and " + names.edge(topology.edges[at(pair.second)]);
  return names.vertex(pair.first) + " and " + names.triangle(pair.second, topology.triangles[at(pair.second)]);
}

std::array<Triple<double>, 4> corners_of(const std::array<Index, 4>& vertex, const State& x) {
  std::array<Triple<double>, 4> corners;
  for (std::size_t k = 0; k < 4; ++k) corners[k] = x[at(vertex[k])];
  return corners;
}

std::vector<PrimitivePair> near_pairs(const PairMesh& mesh, const State& from, const State& to, double distance) {
  const Topology& topology = mesh.topology;
  const auto boxes_of = [&](const auto& primitives) { return swept_boxes(primitives, from, to, distance / 2); };
  const BoxTree triangles(boxes_of(topology.triangles));
  const auto facets = found_by<PrimitivePair>(from.size(), [&](Index v, std::vector<PrimitivePair>& found) {
    const std::array<Index, 1> vertex{v};
    triangles.query(swept_box(vertex, from, to, distance / 2), [&](Index t) {
      if (is_pair(mesh.exclusions, vertex, topology.triangles[at(t)]))
        found.push_back({ContactSides::point_triangle, v, t});
    });
  });
  const std::vector<Box> edge_boxes = boxes_of(topology.edges);
  const BoxTree edges(edge_boxes);
  std::vector<PrimitivePair> pairs = found_by<PrimitivePair>(
      edge_boxes.size(), [&](Index e, std::vector<PrimitivePair>& found) {
        edges.query(edge_boxes[at(e)], [&](Index f) {
          if (e < f && is_pair(mesh.exclusions, topology.edges[at(e)], topology.edges[at(f)]))
            found.push_back({ContactSides::edge_edge, e, f});
        });
      });
  pairs.insert(pairs.end(), facets.begin(), facets.end());
  return pairs;
}

BarrierSet barriers_at(const PairMesh& mesh, const BarrierShape& shape, const std::vector<PrimitivePair>& pairs,
                       const State& x) {
  constexpr std::size_t grain = 512;
  std::vector<BarrierPart> parts((pairs.size() + grain - 1) / grain);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t p) {
    for (std::size_t i = p * grain; i < std::min(pairs.size(), (p + 1) * grain); ++i)
      parts[p].add(mesh, shape, pairs[i], x);
  });
  BarrierPart all;
  for (const BarrierPart& part : parts) all.append(part);
  all.set.smallest = std::min(shape.reach(), std::sqrt(all.squared));
  merge(all.set.terms);
  return std::move(all.set);
}

}  // namespace ogc::reference
