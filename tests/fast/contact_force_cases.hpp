// Computes what fast::ContactForces should return, contact by contact, from the reference's answers to the judge's
// stages. The tests of both backends share it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "compare/stages/numbers.hpp"
#include "fast/contact_forces.hpp"
#include "fast/contact_sets.hpp"
#include "reference/energies/activation.hpp"
#include "reference/energies/contact_force.hpp"
#include "reference/energies/friction_force.hpp"
#include "tests/catch.hpp"
#include "tests/fast/guards.hpp"
#include "tests/fast/numeric.hpp"

namespace ogc::tests {

using fast::test::D3;

inline D3 wide(const compare::Vec3f& a) { return {a.x, a.y, a.z}; }
inline D3 wide(const compare::Vec3& a) { return {a.x, a.y, a.z}; }

/// A contact as a question of the stage contact_force, without `own`.
struct ContactQuestion {
  compare::ContactForceCase question;
  std::array<std::size_t, 4> vertex{};  ///< numbers in the mesh
  bool edge_edge = false;               ///< between edges or their ends

  int count() const { return compare::vertex_count(question.sides); }
};

/// Everything that ContactForces reads. Contacts are found at `previous`, then vertices move to `x`.
struct ContactWorld {
  TestMesh mesh;
  Positions rest, previous, x, start;
  fast::ContactForceOptions options;
  double time_step = 0.01;
  std::vector<compare::Index> colours;

  fast::ContactForces forces(fast::Backend backend = fast::Backend::cpu) const {
    return fast::ContactForces(mesh.connectivity(), rest, options, backend, colours);
  }
  fast::ContactQuery query() const {
    return {.contact_radius = options.contact_radius, .query_radius = options.contact_radius};
  }
  fast::Sliding sliding() const { return {start, time_step}; }
  float slip_limit() const { return static_cast<float>(options.friction_velocity * time_step); }

  /// Returns the contacts, found on the host.
  std::vector<ContactQuestion> questions() const {
    fast::ContactFinder finder(mesh.connectivity());
    const fast::ContactView view = finder.find_resident(previous.data(), query());
    std::vector<ContactQuestion> all;
    for (int i = 0; i < *view.vertex_facet_count; ++i) {
      const fast::VertexFacetRecord& of = view.vertex_facet[i];
      all.push_back(ask({of.vertex, of.corner[0], of.corner[1], of.corner[2]}, false));
    }
    for (int i = 0; i < *view.edge_edge_count; ++i) {
      const fast::EdgeEdgeRecord& of = view.edge_edge[i];
      if (of.first[1] < 0) {
        all.push_back(ask({of.first[0], of.second[0], of.second[1], -1}, false));
        all.back().edge_edge = true;
        continue;
      }
      all.push_back(ask({of.first[0], of.first[1], of.second[0], of.second[1]}, true));
      const compare::Topology& topology = finder.mesh().topology();
      all.back().question.rest_squared = {rest_squared(topology, of.first_edge),
                                          rest_squared(topology, of.second_edge)};
    }
    return all;
  }

 private:
  ContactQuestion ask(const std::array<int, 4>& vertex, bool edges) const {
    ContactQuestion asked;
    asked.edge_edge = edges;
    compare::ContactForceCase& q = asked.question;
    q.sides = edges           ? compare::ContactSides::edge_edge
              : vertex[2] < 0 ? compare::ContactSides::point_point
              : vertex[3] < 0 ? compare::ContactSides::point_edge
                              : compare::ContactSides::point_triangle;
    for (std::size_t k = 0; k < static_cast<std::size_t>(asked.count()); ++k) {
      const auto v = static_cast<std::size_t>(vertex[k]);
      asked.vertex[k] = v, q.vertex[k] = x[v], q.previous[k] = previous[v];
    }
    q.contact_radius = options.contact_radius, q.stiffness = options.contact_stiffness;
    q.activation = options.contact_activation;
    return asked;
  }
  float rest_squared(const compare::Topology& topology, int edge) const {
    const auto e = static_cast<std::size_t>(edge);
    if (topology.edge_triangles[e].empty()) return 0;
    const D3 along = wide(rest[static_cast<std::size_t>(topology.edges[e][1])]) -
                     wide(rest[static_cast<std::size_t>(topology.edges[e][0])]);
    return static_cast<float>(dot(along, along));
  }
};

/// Moves the vertices of a mesh by up to `by` [m] after the detection, and by up to `slip` [m] since the step's start.
/// Rest lengths are `stretch` times those of the mesh.
inline ContactWorld moved_world(const TestMesh& mesh, float radius, float by, float slip, float stretch,
                                std::uint32_t seed) {
  ContactWorld world;
  world.mesh = mesh;
  world.rest = scaled(mesh.positions, stretch);
  world.previous = mesh.positions;
  TestMesh other = jittered(mesh, by, seed);
  world.x = other.positions;
  world.start = jittered(other, slip, seed + 1).positions;
  world.options = {.contact_radius = radius, .contact_stiffness = 100, .friction = 0.3F, .friction_velocity = 0.5};
  return world;
}

/// Returns worlds with contacts of every kind: sheets with and without mollified edges, crowded triangles of very
/// different sizes with loose edges.
inline std::vector<ContactWorld> contact_worlds() {
  TestMesh sheets = jittered(sheet(6, 1.0F, 0), 0.1F, 1);
  sheets.add(jittered(sheet(6, 1.0F, 0.5F), 0.1F, 2));
  std::vector<ContactWorld> worlds{moved_world(sheets, 0.6F, 0.03F, 0.01F, 1, 3),
                                   moved_world(sheets, 0.6F, 0.03F, 0.01F, 3, 4),
                                   moved_world(random_faces(9), 0.05F, 0.002F, 0.005F, 1, 5),
                                   moved_world(random_faces(10), 0.2F, 0.002F, 0.005F, 2, 6)};
  worlds[1].options.contact_activation = compare::ContactActivation::ipc_log;
  worlds[3].options.contact_activation = compare::ContactActivation::quadratic;
  return worlds;
}

/// What one vertex should have, and the largest accepted errors.
struct ExpectedForce {
  D3 force, friction;             ///< of contacts without friction; of friction [N]
  std::array<double, 6> block{};  ///< with friction [N/m]
  double force_error = 0, friction_error = 0, block_error = 0;
  double force_size = 0, friction_size = 0, block_size = 0;  ///< sums of norms
  int terms = 0;
};

inline double norm_of(const std::array<double, 6>& b) {
  return std::sqrt(b[0] * b[0] + b[3] * b[3] + b[5] * b[5] + 2 * (b[1] * b[1] + b[2] * b[2] + b[4] * b[4]));
}

inline std::array<double, 6> less(const std::array<double, 6>& a, const std::array<double, 6>& b) {
  std::array<double, 6> gap{};
  for (std::size_t k = 0; k < 6; ++k) gap[k] = a[k] - b[k];
  return gap;
}

/// Adds an answer of the reference: the exact one, and as errors the stage's tolerance and what grey decisions change.
inline void add_answer(const std::vector<compare::ForceAnswer>& accepted, double force_tolerance,
                       double block_tolerance, D3& force, double& force_error, double& force_size, ExpectedForce& sum) {
  const compare::ForceAnswer& exact = accepted.front();
  double force_doubt = 0, block_doubt = 0;
  for (const compare::ForceAnswer& other : accepted) {
    force_doubt = std::max(force_doubt, fast::test::length(wide(other.force) - wide(exact.force)) +
                                            compare::unit_roundoff * force_tolerance * other.force_scale);
    block_doubt = std::max(block_doubt, norm_of(less(other.block, exact.block)) +
                                            compare::unit_roundoff * block_tolerance * other.block_scale);
  }
  force += wide(exact.force);
  force_error += force_doubt;
  force_size += fast::test::length(wide(exact.force)) + force_doubt;
  for (std::size_t k = 0; k < 6; ++k) sum.block[k] += exact.block[k];
  sum.block_error += block_doubt;
  sum.block_size += norm_of(exact.block) + block_doubt;
  ++sum.terms;
}

/// Returns what each vertex should have.
inline std::vector<ExpectedForce> expected_forces(const ContactWorld& world, bool with_friction) {
  std::vector<ExpectedForce> all(world.x.size());
  const auto colour = [&](std::size_t v) {
    return world.colours.empty() ? static_cast<compare::Index>(v) : world.colours[v];
  };
  for (const ContactQuestion& contact : world.questions()) {
    for (int own = 0; own < contact.count(); ++own) {
      compare::FrictionForceCase asked;
      asked.contact = contact.question;
      const std::size_t v = contact.vertex[static_cast<std::size_t>(own)];
      asked.contact.own = own;
      for (int k = 0; k < contact.count(); ++k) {
        const std::size_t other = contact.vertex[static_cast<std::size_t>(k)];
        if (colour(other) == colour(v)) asked.contact.together |= static_cast<std::uint8_t>(1 << k);
        asked.start[static_cast<std::size_t>(k)] = world.start[other];
      }
      asked.friction = world.options.friction, asked.slip_limit = world.slip_limit();
      ExpectedForce& sum = all[v];
      add_answer(reference::contact_force(asked.contact), compare::contact_force_tolerance,
                 compare::contact_block_tolerance, sum.force, sum.force_error, sum.force_size, sum);
      if (!with_friction) continue;
      add_answer(reference::friction_force(asked), compare::friction_force_tolerance, compare::friction_block_tolerance,
                 sum.friction, sum.friction_error, sum.friction_size, sum);
    }
  }
  return all;
}

/// Returns how often a vertex's numbers differ from the expected ones by more than the stages' tolerances and the
/// rounding of the sum. A sum of n terms in any order errs by less than n 2⁻²⁴ of the sum of their norms.
inline int count_wrong(const ContactWorld& world, const fast::ContactForceSums& sums, bool with_friction) {
  const std::vector<ExpectedForce> expected = expected_forces(world, with_friction);
  int wrong = 0;
  for (std::size_t v = 0; v < expected.size(); ++v) {
    const ExpectedForce& e = expected[v];
    const double rounding = compare::unit_roundoff * e.terms;
    const double off = fast::test::length(wide(sums.force[v]) - (e.force + e.friction)),
                 off_friction = fast::test::length(wide(sums.friction[v]) - e.friction);
    std::array<double, 6> block{};
    for (std::size_t k = 0; k < 6; ++k) block[k] = sums.block[v][k];
    wrong += !(off <= e.force_error + e.friction_error + rounding * (e.force_size + e.friction_size));
    wrong += !(off_friction <= e.friction_error + rounding * e.friction_size);
    wrong += !(norm_of(less(block, e.block)) <= e.block_error + rounding * e.block_size);
  }
  return wrong;
}

/// Returns the distance of a point from a segment, of two segments, and of a point from a triangle [m].
inline double distance_of(const D3& p, const D3& a, const D3& b) {
  const D3 along = b - a;
  return fast::test::length(p - a - std::clamp(dot(along, p - a) / dot(along, along), 0.0, 1.0) * along);
}
inline double distance_of(const D3& a, const D3& b, const D3& c, const D3& d, bool edges) {
  if (!edges) {  // the point a and the triangle b, c, d
    const D3 normal = cross(c - b, d - b);
    const double area = dot(normal, normal), u = dot(cross(c - b, a - b), normal), w = dot(cross(a - b, d - b), normal);
    if (u > 0 && w > 0 && u + w < area) return std::abs(dot(a - b, normal)) / std::sqrt(area);
    return std::min({distance_of(a, b, c), distance_of(a, c, d), distance_of(a, d, b)});
  }
  const D3 normal = cross(b - a, d - c);
  const double sine = dot(normal, normal), s = dot(cross(c - a, d - c), normal) / sine,
               t = dot(cross(c - a, b - a), normal) / sine;
  if (s > 0 && s < 1 && t > 0 && t < 1) return std::abs(dot(c - a, normal)) / std::sqrt(sine);
  return std::min({distance_of(a, c, d), distance_of(b, c, d), distance_of(c, a, b), distance_of(d, a, b)});
}

/// Returns the distance of a contact's sides [m], given the positions of its vertices.
inline double distance_of(const ContactQuestion& contact, const std::array<D3, 4>& x) {
  switch (contact.question.sides) {
    case compare::ContactSides::point_point: return fast::test::length(x[0] - x[1]);
    case compare::ContactSides::point_edge: return distance_of(x[0], x[1], x[2]);
    case compare::ContactSides::edge_edge: return distance_of(x[0], x[1], x[2], x[3], true);
    case compare::ContactSides::point_triangle: return distance_of(x[0], x[1], x[2], x[3], false);
  }
  return 0;
}

/// Returns e_k (method.md §4.3), without overlaps of parallel loose edges.
inline double share_of(const ContactQuestion& contact) {
  const compare::ContactForceCase& q = contact.question;
  const double limit = 1e-3 * static_cast<double>(q.rest_squared[0]) * q.rest_squared[1];
  const D3 normal = cross(wide(q.previous[1]) - wide(q.previous[0]), wide(q.previous[3]) - wide(q.previous[2]));
  const double share = limit > 0 ? std::min(1.0, dot(normal, normal) / limit) : 1;
  return share * (2 - share);
}

inline std::array<D3, 4> points_of(const ContactQuestion& contact) {
  return {wide(contact.question.vertex[0]), wide(contact.question.vertex[1]), wide(contact.question.vertex[2]),
          wide(contact.question.vertex[3])};
}

/// Returns energy, slope and curvature of a contact.
inline reference::ActivationValue activation_of(const ContactQuestion& contact, const std::array<D3, 4>& x) {
  const compare::ContactForceCase& q = contact.question;
  return reference::activation_at(q.activation, distance_of(contact, x), q.contact_radius,
                                  share_of(contact) * q.stiffness);
}

}  // namespace ogc::tests
