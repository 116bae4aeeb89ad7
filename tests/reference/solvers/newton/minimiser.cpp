#include "reference/solvers/newton/minimiser.hpp"

#include <cmath>

#include "reference/geometry/detect_edge_edge.hpp"
#include "reference/geometry/detect_vertex_facet.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::Vec3f;
using Positions = reference::Minimiser::Positions;

namespace {

/// A step from the start of a scene, with the contacts found there.
struct Question {
  compare::Scene scene;
  compare::Topology topology;
  std::vector<Vec3f> start, target;
  std::vector<compare::VertexFacetContact> vertex_facet;
  std::vector<compare::EdgeEdgeContact> edge_edge;

  explicit Question(compare::Scene from) : scene(std::move(from)) {
    round_to_single(scene);
    topology = build_topology(scene);
    start = compare::to_single(scene.mesh.positions);
    target = start;
    const std::vector<compare::Index> groups = rigid_groups(scene);
    const double h = scene.settings.time_step;
    for (std::size_t v = 0; v < start.size(); ++v)
      if (groups[v] == -1) target[v].y += static_cast<float>(h * scene.velocities[v].y + h * h * scene.gravity.y);
    const auto r = static_cast<float>(scene.settings.contact_radius);
    const compare::DetectIn detect{&topology, groups, start, r, r};
    vertex_facet = reference::detect_vertex_facet(detect).exact.contacts;
    edge_edge = reference::detect_edge_edge(detect).exact.contacts;
  }

  compare::SweepIn in() const {
    return {&scene, &topology, nullptr, {}, start, start, target, start, {}, vertex_facet, edge_edge};
  }
  std::size_t contacts() const { return vertex_facet.size() + edge_edge.size(); }
  Positions at_start() const {
    Positions x;
    for (const Vec3f& p : start) x.push_back({p.x, p.y, p.z});
    return x;
  }
};

double distance(const Positions& a, const Positions& b) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v)
    for (std::size_t axis = 0; axis < 3; ++axis) sum += (a[v][axis] - b[v][axis]) * (a[v][axis] - b[v][axis]);
  return std::sqrt(sum);
}

/// The minimum, moved by up to `size` [m] at each of the first `free` vertices, by a pattern that no symmetry has.
Positions shaken(Positions x, std::size_t free, double size, int draw) {
  for (std::size_t v = 0; v < free; ++v)
    for (std::size_t axis = 0; axis < 3; ++axis)
      x[v][axis] += size * std::sin(12.9898 * static_cast<double>(3 * v + axis) + 78.233 * draw);
  return x;
}

}  // namespace

TEST_CASE("with contacts and friction fixed Newton converges quadratically to what doubles can tell", "[property]") {
  const Question question(two_sheets());
  REQUIRE(question.contacts() > 50);
  reference::Minimiser minimiser(question.in());
  minimiser.lag_friction(question.at_start());
  const reference::Minimum minimum = minimiser.minimum(question.at_start());
  REQUIRE(minimum.converged);
  const std::vector<double>& force = minimum.forces;
  // log(f₃/f₂)/log(f₂/f₁) tends to the order: 1 of linear convergence, 2 of quadratic. The last forces are rounding's.
  double order = 0;
  for (std::size_t i = 2; i < force.size(); ++i)
    if (force[i - 1] < 1e-4 * force[0])
      order = std::max(order, std::log(force[i] / force[i - 1]) / std::log(force[i - 1] / force[i - 2]));
  INFO("order " << order);
  CHECK(order > 1.9);
  CHECK(force.size() <= 12);
  CHECK(minimiser.minimum(minimum.position).forces.size() == 1);
}

TEST_CASE("a state is no farther from the minimum than its gradient and its energy allow", "[property]") {
  const Question question(two_sheets());
  reference::Minimiser minimiser(question.in());
  minimiser.lag_friction(question.at_start());
  const Positions least = minimiser.minimum(question.at_start()).position;
  for (int draw = 0; draw < 8; ++draw) {
    const Positions x = shaken(least, 36, 1e-6, draw);
    double smallest = 1e30;
    for (const Positions* at : {&least, &x}) smallest = std::min(smallest, minimiser.smallest_eigenvalue(*at).value());
    const double apart = distance(x, least), energy = minimiser.energy_above(x, least);
    INFO("draw " << draw << ", smallest eigenvalue " << smallest);
    CHECK(apart <= minimiser.gradient(x).norm / smallest);
    CHECK(apart <= std::sqrt(2 * energy / smallest));
    CHECK(energy > 0);
  }
}

TEST_CASE("the smallest eigenvalue is just below the true one, and bounds are reached in its direction", "[property]") {
  // Three masses above a plane, each held by the contact alone: m/h² along the plane, k_c more across it.
  compare::Material material;
  material.membrane = compare::MembraneModel::none;
  material.bending = compare::BendingModel::none;
  material.friction = 0;
  const Question question(triangle_on_plane(4.5e-3, material));
  REQUIRE(question.contacts() == 3);
  reference::Minimiser minimiser(question.in());
  const double h = question.scene.settings.time_step, mass = material.density * 0.5 * 1e-4 / 3;
  const double found = minimiser.smallest_eigenvalue(question.at_start()).value(), exact = mass / (h * h);
  // Confirmed is 1 − 2⁻¹⁰ of Lanczos' value, which is right to 2⁻²⁰; masses are single-precision numbers.
  CHECK(found <= exact * (1 - 0x1p-11));
  CHECK(found >= exact * (1 - 0x1p-9));
  // Moved along the plane both bounds are the way itself: nothing but inertia draws it back.
  const Positions least = minimiser.minimum(question.at_start()).position;
  Positions x = least;
  for (std::size_t v = 0; v < 3; ++v) x[v][0] += 1e-4;
  const double way = std::sqrt(3.0) * 1e-4;
  CHECK(minimiser.gradient(x).norm / exact == Approx(way).epsilon(0x1p-20));
  CHECK(minimiser.gradient(x).mean / exact == Approx(1e-4).epsilon(0x1p-20));
  CHECK(std::sqrt(2 * minimiser.energy_above(x, least) / exact) == Approx(way).epsilon(0x1p-20));
}

TEST_CASE("where the energy is not convex there is no smallest eigenvalue", "[unit]") {
  compare::Scene scene;
  scene.name = "compressed";
  compare::Material stiff;
  stiff.lame_mu = stiff.lame_lambda = 1e4;
  add_sheet(scene, 4, 0.03, 0, false, stiff);
  scene.rest_positions = scene.mesh.positions;
  for (compare::Vec3& p : scene.mesh.positions) p.x *= 0.5, p.z *= 0.6;
  scene.settings.contact_radius = 1e-3;
  const Question question(scene);
  CHECK_FALSE(reference::Minimiser(question.in()).smallest_eigenvalue(question.at_start()));
}
