// Compares the reference's sweep with physics, and tests which positions an update reads.
#include "reference/solvers/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "reference/solvers/kinds/rest_state.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using compare::Index;
using compare::Vec3;
using compare::Vec3f;

namespace {

/// Returns (n + 1)² vertices at the integers of the plane z = height.
compare::Mesh sheet(int n, double height) {
  compare::Mesh mesh;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) mesh.positions.push_back({1.0 * i, 1.0 * j, height});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const Index a = i + j * (n + 1), b = a + 1, c = a + n + 1, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
    }
  return mesh;
}

/// A sweep with all its inputs: at rest at the start, without contacts and bounds, each vertex with its own colour.
struct Question {
  compare::Scene scene;
  compare::Topology topology;
  compare::RestStateOut rest;
  std::vector<Index> colour;
  std::vector<Vec3f> old, start, target, previous;
  std::vector<float> bound;
  compare::DetectVertexFacetOut vertex_facet;
  compare::DetectEdgeEdgeOut edge_edge;

  explicit Question(const compare::Scene& of) : scene(of) {
    round_to_single(scene);
    topology = build_topology(scene);
    rest = reference::rest_state({&scene, &topology}).exact;
    old = start = target = previous = compare::to_single(scene.mesh.positions);
    bound.assign(old.size(), 1e6f);
    const std::vector<Index> groups = rigid_groups(scene);
    for (std::size_t v = 0; v < old.size(); ++v) colour.push_back(groups[v] < 0 ? static_cast<Index>(v) : -1);
  }
  void detect() {
    const std::vector<Index> groups = rigid_groups(scene);
    const auto r = static_cast<float>(scene.settings.contact_radius);
    vertex_facet = reference::detect_vertex_facet({&topology, groups, previous, r, 2 * r}).exact;
    edge_edge = reference::detect_edge_edge({&topology, groups, previous, r, 2 * r}).exact;
  }
  compare::SweepIn in() const {
    return {&scene,
            &topology,
            &rest,
            colour,
            old,
            start,
            target,
            previous,
            bound,
            vertex_facet.contacts,
            edge_edge.contacts};
  }
  compare::SweepOut swept() const { return reference::reference_sweep(in(), reference::SweepStencils(in())); }
  compare::SweepTruth truth(const compare::SweepOut& answer) const { return reference::sweep(in(), answer); }
};

compare::Scene scene_of(std::initializer_list<compare::Mesh> meshes) {
  compare::Scene scene;
  scene.name = "test";
  compare::Material material;
  material.membrane = compare::MembraneModel::st_venant_kirchhoff;  // the energy of this model is written below
  for (const compare::Mesh& mesh : meshes) append_body(scene, {.name = "sheet", .material = material}, mesh);
  scene.settings.contact_radius = 0.25;
  scene.settings.friction_velocity = 1;
  return scene;
}

void shake(std::vector<Vec3f>& points, std::mt19937& random, float size) {
  std::uniform_real_distribution<float> move(-size, size);
  for (Vec3f& p : points) p = {p.x + move(random), p.y + move(random), p.z + move(random)};
}

double distance(const Vec3& a, const Vec3f& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// Returns inertia and St. Venant–Kirchhoff energy of a sheet. At rest, triangles are right-angled with legs of length
/// 1, so two deformed legs are the columns of F.
double energy(const Question& q, const std::vector<Vec3f>& x) {
  const compare::Material& m = q.scene.bodies[0].material;
  double sum = 0;
  for (std::size_t v = 0; v < x.size(); ++v) {
    const double moved = distance({x[v].x, x[v].y, x[v].z}, q.target[v]);
    sum += q.rest.mass[v] / (2 * q.scene.settings.time_step * q.scene.settings.time_step) * moved * moved;
  }
  for (const compare::Triangle& t : q.topology.triangles) {
    const auto edge = [&](std::size_t from, std::size_t to) {
      const Vec3f &a = x[static_cast<std::size_t>(t[from])], &b = x[static_cast<std::size_t>(t[to])];
      return std::array{double{b.x} - a.x, double{b.y} - a.y, double{b.z} - a.z};
    };
    const auto dot = [](const auto& a, const auto& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    // A cell's triangles (a, b, d) and (a, d, c) have their right angles at b and c.
    const bool lower = t[1] == t[0] + 1;
    const auto first = lower ? edge(0, 1) : edge(2, 1), second = lower ? edge(1, 2) : edge(0, 2);
    const double xx = (dot(first, first) - 1) / 2, xy = dot(first, second) / 2, yy = (dot(second, second) - 1) / 2;
    sum += 0.5 * (m.lame_lambda / 2 * (xx + yy) * (xx + yy) + m.lame_mu * (xx * xx + 2 * xy * xy + yy * yy));
  }
  return sum;
}

}  // namespace

TEST_CASE("without energies a sweep takes every vertex to its target", "[unit]") {
  compare::Scene scene = scene_of({sheet(2, 0)});
  scene.bodies[0].material.membrane = compare::MembraneModel::none;
  scene.bodies[0].material.bending = compare::BendingModel::none;
  Question q(scene);
  std::mt19937 random(1);
  shake(q.target, random, 0.5f);
  const compare::SweepTruth truth = q.truth(q.swept());
  for (std::size_t v = 0; v < q.old.size(); ++v) {
    CHECK(distance(truth.position[v], q.target[v]) <= 1e-14);
    CHECK(truth.accepted[v] > 0);
    CHECK(truth.accepted[v] < 2e-5);
  }
  CHECK(q.swept().position == q.target);
  CHECK(truth.cut + truth.cut_doubtful == 0);
}

TEST_CASE("a sheet at rest stays", "[unit]") {
  const Question q(scene_of({sheet(3, 0)}));
  const std::vector<Vec3f> x = q.swept().position;
  // Rest gradients are rounded, which causes strains of 2⁻²⁴ and moves a vertex by a few times 2⁻²⁴.
  for (std::size_t v = 0; v < x.size(); ++v) CHECK(distance({x[v].x, x[v].y, x[v].z}, q.old[v]) <= 8 * 0x1p-24);
}

TEST_CASE("a vertex beyond its bound is put on its ball and counted, prescribed or free; fixed ones stay", "[unit]") {
  compare::Scene scene = scene_of({sheet(1, 0), sheet(1, 3)});
  scene.bodies[0].material.membrane = compare::MembraneModel::none;
  scene.bodies[0].material.bending = compare::BendingModel::none;
  scene.bodies[1].fixed = true;
  scene.motions.push_back({.name = "held", .vertices = {1}, .keyframes = {}});
  Question q(scene);
  for (Vec3f& y : q.target) y = {y.x + 3, y.y, y.z + 4};
  q.bound = {1, 2, 5, 6, 1, 1, 1, 1};
  const compare::SweepOut out = q.swept();
  CHECK(out.cut == 2);
  CHECK(distance({0.6, 0, 0.8}, out.position[0]) <= 1e-6);
  CHECK(distance({2.2, 0, 1.6}, out.position[1]) <= 1e-6);
  CHECK(out.position[3] == q.target[3]);
  for (std::size_t v = 4; v < 8; ++v) CHECK(out.position[v] == q.old[v]);
  const compare::SweepTruth truth = q.truth(out);
  CHECK(truth.cut == 2);
  CHECK(truth.cut_doubtful == 1);
  CHECK(truth.accepted[4] == 0);
  CHECK(truth.accepted[1] < 2e-5);
}

TEST_CASE("a vertex is read at its new position if and only if its colour is lower", "[property]") {
  compare::Scene scene = scene_of({sheet(3, 0)});
  Question q(scene);
  std::mt19937 random(5);
  shake(q.old, random, 0.1f);
  const compare::SweepOut out = q.swept();
  const compare::SweepTruth truth = q.truth(out);
  for (std::size_t moved = 0; moved < q.old.size(); ++moved) {
    compare::SweepOut other = out;
    other.position[moved].z += 0.25f;
    const compare::SweepTruth changed = q.truth(other);
    for (std::size_t v = 0; v < q.old.size(); ++v) {
      const auto& near = q.topology.vertex_neighbours[v];
      const bool is_near = std::find(near.begin(), near.end(), static_cast<Index>(moved)) != near.end();
      if (v <= moved) CHECK(changed.position[v] == truth.position[v]);
      if (v > moved && is_near) CHECK_FALSE(changed.position[v] == truth.position[v]);
    }
  }
}

TEST_CASE("forces of all stencils add up to nothing where all vertices are read at one time", "[property]") {
  compare::Scene scene = scene_of({sheet(3, 0), sheet(3, 0.125)});
  for (compare::Body& body : scene.bodies) {
    body.material.membrane_damping = 0.001;
    body.material.bending_damping = 0.001;
    body.material.bending_stiffness = 0.1;
  }
  scene.bodies[1].material.contact_stiffness = 17;
  scene.bodies[1].material.friction = 0.9;
  Question q(scene);
  std::mt19937 random(7);
  shake(q.previous, random, 0.02f);
  q.detect();
  REQUIRE(q.vertex_facet.contacts.size() > 8);
  REQUIRE(q.edge_edge.contacts.size() > 8);
  q.old = q.previous;
  shake(q.old, random, 0.01f);
  shake(q.start, random, 0.01f);
  std::fill(q.colour.begin(), q.colour.end(), 0);
  const compare::SweepIn in = q.in();
  const compare::SweepOut nothing_yet{q.old, 0};
  const reference::SweepStencils stencils(in);
  Vec3 sum;
  double moduli = 0;
  for (Index v = 0; v < static_cast<Index>(q.old.size()); ++v) {
    for (const reference::Term& term :
         reference::terms_of_vertex(in, stencils, reference::SweepPositions(in, nothing_yet, v), v).terms) {
      const Vec3& f = term.accepted[0].force;
      sum = {sum.x + f.x, sum.y + f.y, sum.z + f.z};
      moduli += std::hypot(f.x, f.y, f.z);
    }
  }
  CHECK(moduli > 1);
  // The gradients ∇N₀ of two corners are rounded to single precision, which changes each force by 2⁻²⁴ of the force.
  CHECK(std::hypot(sum.x, sum.y, sum.z) <= 0x1p-24 * moduli);
}

TEST_CASE("with inertia ahead of stiffness every sweep lowers the energy until nothing moves", "[property]") {
  compare::Scene scene = scene_of({sheet(4, 0)});
  scene.bodies[0].material.bending = compare::BendingModel::none;
  scene.settings.time_step = 0.05;
  Question q(scene);
  std::mt19937 random(11);
  shake(q.target, random, 0.1f);
  double before = energy(q, q.old);
  const double start = before;
  for (int sweep = 0; sweep < 60; ++sweep) {
    q.old = q.swept().position;
    const double after = energy(q, q.old);
    // Rounding positions by 2⁻²⁴ can raise the energy by 2⁻²⁴ times its slope. The slope is bounded by the remaining
    // energy.
    CHECK(after <= before + 1e-6 * start);
    before = after;
  }
  const std::vector<Vec3f> last = q.swept().position;
  for (std::size_t v = 0; v < last.size(); ++v) CHECK(distance({last[v].x, last[v].y, last[v].z}, q.old[v]) <= 1e-6);
  CHECK(before < 0.9 * start);
}

TEST_CASE(
    "a contact at its radius has its block and no decision to take; a stiff one is ill-conditioned and held to its "
    "direction",
    "[unit]") {
  compare::Scene scene = scene_of({sheet(1, 0), sheet(1, 0.25)});
  for (compare::Body& body : scene.bodies) {
    body.material.membrane = compare::MembraneModel::none;
    body.material.bending = compare::BendingModel::none;
    body.material.friction = 0;
  }
  Question q(scene);
  for (std::size_t v = 4; v < 8; ++v) q.previous[v].z = 0.2f;
  q.detect();
  REQUIRE(!q.vertex_facet.contacts.empty());
  for (std::size_t v = 4; v < 8; ++v) q.target[v].z = 0.1f;
  compare::SweepOut out = q.swept();
  for (std::size_t v = 4; v < 8; ++v) CHECK(q.truth(out).grey[v] == 0);
  CHECK(distance(q.truth(out).position[7], out.position[7]) <= q.truth(out).accepted[7]);
  out.position[7].z = 0.1f;  // its position without the contact's block
  CHECK(distance(q.truth(out).position[7], out.position[7]) > q.truth(out).accepted[7]);

  for (Vec3f& p : q.old) p.z = p.z > 0.1f ? 1e-4f : 0;
  out = q.swept();
  CHECK(std::isinf(q.truth(out).accepted[7]));
  out.position[7].z = 0.5e-4f;
  CHECK(q.truth(out).accepted[7] == 0);
}
