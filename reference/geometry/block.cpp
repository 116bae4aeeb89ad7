// Decides by one conjunction of conditions whether a given point is in a block. For the closest point of an edge, first
// decides which face of the edge holds that point. If several faces are possible, the answers for all of them are
// accepted.
#include "reference/geometry/block.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "reference/geometry/blocks.hpp"
#include "reference/geometry/closest_points.hpp"

namespace ogc::reference {
namespace {

using compare::BlockQuestion;

struct Answer {
  bool inside = false;
  bool may_be_inside = false, may_be_outside = false;
  bool near = false;
};

/// Adds the result for one face of the edge. `premise`: whether the closest point lies on this face. `block`: whether
/// the point is in the block if it lies on this face.
void add(Answer& answer, const Membership& premise, const Membership& block) {
  answer.inside = answer.inside || (premise.exact && block.exact);
  answer.may_be_inside = answer.may_be_inside || (premise.possible && block.possible);
  answer.may_be_outside = answer.may_be_outside || (premise.possible && !block.certain);
}

void require(Membership& membership, Nearness& nearness, const Condition& condition) {
  const MarginAnswer margin = examine(condition.margin);
  const bool held = (margin.sign > 0) == condition.positive;
  require(membership, held, margin.grey);
  nearness.add(held, margin.near);
}

Answer vertex_in_surface(const Complex& mesh, const Vec3f& x, Face a) {
  Membership block;
  Nearness nearness;
  visit_block(mesh, a, x, [&](const Boundary& boundary) {
    require(block, nearness, boundary.condition);
    return nearness.within_reach();
  });
  Answer answer;
  add(answer, {}, block);
  answer.near = nearness.is_near();
  return answer;
}

/// Decides Eq. 14: whether the point of edge a that is closest to edge e lies in the interior of a.
Answer edge_in_edge(const Complex& mesh, Index e, Index a) {
  const auto ends = [&mesh](Index edge) {
    return std::array{mesh.at(mesh.edge(edge)[0]), mesh.at(mesh.edge(edge)[1])};
  };
  const EdgePair pair{ends(a), ends(e)};
  const auto interior = [](EdgeFeatures on) { return on.first == EdgeFeature::interior; };
  Answer answer;
  const EdgeFeatures closest = closest_features(pair);
  answer.inside = interior(closest);
  const auto accept = [&](EdgeFeatures on) { (interior(on) ? answer.may_be_inside : answer.may_be_outside) = true; };
  accept(closest);
  answer.near = is_near_decision(pair, closest, false);
  if (are_closest(pair, closest).certain) return answer;
  for (int k = 0; k < edge_feature_pairs; ++k) {
    if (are_closest(pair, edge_features(k)).possible) accept(edge_features(k));
  }
  return answer;
}

/// Decides Eq. 15 for c, the point of an edge that is closest to v. `plane(w)` is positive if c lies on w's side of the
/// plane that contains v and is perpendicular to vw.
template <class Plane>
Membership vertex_block(const Complex& mesh, Index v, Nearness& nearness, Plane plane) {
  Membership block;
  for (const Index f : mesh.edges_of(v)) {
    require(block, nearness, {plane(mesh.at(mesh.across(f, v))), false});
  }
  return block;
}

Answer edge_in_vertex(const Complex& mesh, Index e, Index v) {
  const Vec3f &x = mesh.at(v), &c = mesh.at(mesh.edge(e)[0]), &d = mesh.at(mesh.edge(e)[1]);
  Answer answer;
  Membership inside;
  Nearness of_interior;
  for (const auto& [from, to] : {std::array{c, d}, std::array{d, c}}) {
    Membership beyond;
    Nearness of_end;
    require(beyond, of_end, {along(from, to, x), false});
    if (beyond.possible)
      add(answer, beyond, vertex_block(mesh, v, of_end, [&](const Vec3f& w) { return along(x, w, from); }));
    require(inside, of_interior, {along(from, to, x), true});
    answer.near = answer.near || of_end.is_near();
  }
  if (inside.possible)
    add(answer, inside, vertex_block(mesh, v, of_interior, [&](const Vec3f& w) { return turn(x, w, c, d); }));
  answer.near = answer.near || of_interior.is_near();
  return answer;
}

Answer answer_to(const Complex& mesh, const BlockQuestion& question) {
  if (question.kind == BlockQuestion::Kind::vertex_in_surface)
    return vertex_in_surface(mesh, mesh.at(question.of), question.face);
  if (question.face.kind == FaceKind::edge) return edge_in_edge(mesh, question.of, question.face.index);
  return edge_in_vertex(mesh, question.of, question.face.index);
}

}  // namespace

compare::BlockTruth block(const compare::BlockIn& in) {
  const Complex mesh{*in.topology, in.positions};
  const std::vector<std::uint8_t> none(in.questions.size());
  compare::BlockTruth truth{none, none, none};
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, in.questions.size(), 16),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        const Answer answer = answer_to(mesh, in.questions[i]);
                        truth.inside[i] = answer.inside;
                        truth.grey[i] = answer.may_be_inside && answer.may_be_outside;
                        truth.near[i] = answer.near;
                      }
                    });
  return truth;
}

}  // namespace ogc::reference
