#include "reference/solvers/step.hpp"

#include <algorithm>
#include <cmath>

#include "compare/problem/volumes.hpp"
#include "compare/stages/volume_force.hpp"
#include "reference/solvers/guess_contacts.hpp"
#include "reference/solvers/step_order.hpp"

namespace ogc::reference {
namespace {

using compare::Index;
using compare::StepEventKind;
using compare::Vec3;
using compare::Vec3f;

/// Returns for each event the moves that contacts leave. All lists are empty if the answer's rest state lacks the
/// friction of a pair of bodies.
std::vector<std::vector<compare::HeldMove>> held_moves(const compare::StepIn& in, const compare::StepOut& answer) {
  std::vector<std::vector<compare::HeldMove>> moves(answer.events.size());
  const std::size_t bodies = in.scene->bodies.size(), count = in.scene->mesh.positions.size();
  if (answer.rest.meetings.size() != bodies * bodies) return moves;
  HeldMoves rounds(rigid_groups(*in.scene), in.scene->settings.contact_radius);
  for (std::size_t i = 1; i < answer.events.size(); ++i) {
    const compare::StepEvent& detection = answer.events[i - 1];
    const bool is_round = answer.events[i].kind == StepEventKind::guess && detection.kind == StepEventKind::detection;
    if (!is_round || detection.position.size() != count || answer.target.size() != count) continue;
    moves[i] = rounds.judged_round(guess_contacts(*in.scene, *in.topology, answer.rest, detection.vertex_facet.contacts,
                                                  detection.edge_edge.contacts),
                                   detection.position, answer.target);
  }
  return moves;
}

/// Returns for each vertex whether a contact certainly or possibly keeps it in place. Empty if the event is not a round
/// of the guess loop.
std::vector<bool> staying(const std::vector<compare::HeldMove>& moves) {
  std::vector<bool> stays;
  for (const compare::HeldMove& held : moves) stays.push_back(held.touches != 0);
  return stays;
}

Vec3 difference(const Vec3f& a, const Vec3f& b) { return {double{a.x} - b.x, double{a.y} - b.y, double{a.z} - b.z}; }
double norm(const Vec3& a) { return std::hypot(a.x, a.y, a.z); }

/// Returns whether no vertex is farther than `most` from its place before, along any axis.
bool all_within(const std::vector<Vec3f>& before, const std::vector<Vec3f>& after, double most) {
  const auto is_within = [most](const Vec3f& from, const Vec3f& to) {
    const Vec3 moved = difference(to, from);
    return std::max({std::abs(moved.x), std::abs(moved.y), std::abs(moved.z)}) <= most;
  };
  return std::ranges::equal(before, after, is_within);
}

}  // namespace

StepLag lag_of(const std::vector<Vec3f>& x, const std::vector<Vec3f>& previous, const std::vector<Vec3f>& target,
               const std::vector<Index>& groups, const compare::Settings& settings, const std::vector<bool>& stays) {
  StepLag lag;
  if (!traits_of(settings.bounds).has_planes) return lag;
  for (std::size_t v = 0; v < x.size(); ++v) {
    if (groups[v] <= 0 || x[v] == target[v] || (!stays.empty() && stays[v] && x[v] == previous[v])) continue;
    ++lag.lagging;
    lag.has_advanced = lag.has_advanced || !(x[v] == previous[v]);
  }
  return lag;
}

Depth depth_of(const std::vector<compare::VolumeContact>& contacts, const compare::Topology& topology,
               const std::vector<Vec3f>& x, double contact_radius) {
  Depth deepest = Depth::shallow;
  for (const compare::VolumeContact& contact : contacts) {
    if (contact.point < 0 || static_cast<std::size_t>(contact.point) >= x.size() || contact.triangle < 0 ||
        static_cast<std::size_t>(contact.triangle) >= topology.triangles.size())
      continue;
    const Vec3f point = x[static_cast<std::size_t>(contact.point)], n = contact.direction;
    const compare::Triangle& corners = topology.triangles[static_cast<std::size_t>(contact.triangle)];
    double above = deep_share * contact_radius, size = above;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 apart = difference(point, x[static_cast<std::size_t>(corners[k])]);
      const double w = double{contact.weights[k]};
      above += w * (n.x * apart.x + n.y * apart.y + n.z * apart.z);
      size += std::abs(w) * (std::abs(n.x * apart.x) + std::abs(n.y * apart.y) + std::abs(n.z * apart.z));
    }
    // φ + r/2 has as many terms as r − φ, so the number of roundings in compare/stages/volume_force.hpp is valid here,
    // too.
    if (std::abs(above) <= compare::volume_force_grey * compare::unit_roundoff * size)
      deepest = std::max(deepest, Depth::doubtful);
    else if (above < 0)
      deepest = Depth::deep;
  }
  return deepest;
}

compare::StepTruth step(const compare::StepIn& in, const compare::StepOut& answer) {
  const compare::Scene& scene = *in.scene;
  const compare::Settings& settings = scene.settings;
  const std::vector<Vec3f> start = compare::to_single(scene.mesh.positions);
  const std::vector<Index> groups = compare::rigid_groups(scene);
  compare::StepTruth truth;
  truth.prescribed_target.resize(start.size());
  for (const compare::PrescribedMotion& motion : scene.motions) {
    const std::vector<Vec3f> targets = compare::prescribed_targets(scene, motion, settings.time_step);
    for (std::size_t k = 0; k < targets.size(); ++k)
      truth.prescribed_target[static_cast<std::size_t>(motion.vertices[k])] = targets[k];
  }
  double largest = 0;
  for (std::size_t v = 0; v < start.size(); ++v) {
    if (groups[v] != 0) largest = std::max(largest, norm(difference(answer.target[v], start[v])));
    const Vec3 moved = difference(answer.position[v], start[v]);
    truth.velocity.push_back(
        {moved.x / settings.time_step, moved.y / settings.time_step, moved.z / settings.time_step});
    truth.velocity_scale.push_back(norm(moved) / settings.time_step);
  }
  truth.query_radius = truth.query_radius_scale = std::min(settings.contact_radius + largest,
                                                           settings.detection_radius_cap * settings.contact_radius);
  truth.moves = held_moves(in, answer);
  StepOrder order(settings, compare::bounded_count(*in.topology, groups));
  const std::vector<Vec3f>* previous = &start;
  const std::vector<compare::VolumeContact>* volumes = nullptr;
  for (auto kind = order.next(); kind; kind = order.next()) {
    const std::size_t i = truth.events.size();
    truth.events.push_back(*kind);
    const bool is_there = i < answer.events.size();
    const Index cut = is_there ? answer.events[i].cut : 0;
    if (is_there && *kind == compare::StepEventKind::detection) {
      previous = &answer.events[i].position;
      volumes = &answer.events[i].volumes.contacts;
    }
    StepLag lag;
    if (is_there)
      lag = lag_of(answer.events[i].position, *previous, truth.prescribed_target, groups, settings,
                   staying(truth.moves[i]));
    bool is_deep = false;
    if (is_there && *kind == compare::StepEventKind::sweep && volumes != nullptr) {
      const Depth depth = depth_of(*volumes, *in.topology, answer.events[i].position, settings.contact_radius);
      // If the depth is doubtful, both orders of events are right. Follows the order that the answer's next event
      // shows.
      const bool detects_next = i + 1 < answer.events.size() &&
                                answer.events[i + 1].kind == compare::StepEventKind::detection;
      is_deep = depth == Depth::deep || (depth == Depth::doubtful && detects_next);
    }
    const bool is_still = is_there && *kind == compare::StepEventKind::sweep &&
                          all_within(answer.events[i - 1].position, answer.events[i].position, settings.settled_move);
    order.took_place(cut, lag, is_deep, is_still);
  }
  return truth;
}

}  // namespace ogc::reference
