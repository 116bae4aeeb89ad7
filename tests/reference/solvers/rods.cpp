// Tests rods in the reference's whole runs: forces against differences of the energy, sweeps that never raise the
// energy, frames at rest, and frames after a rotation.
#include "reference/solvers/rods/rod_system.hpp"

#include <cmath>
#include <numbers>

#include "compare/problem/rods.hpp"
#include "reference/solvers/initial_guess.hpp"
#include "reference/solvers/kinds/rest_state.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using reference::FourOf;
using reference::Triple;

namespace {

using compare::Index;
using compare::Vec3;
using Positions = std::vector<Triple<double>>;

/// Returns a bent chain, and a ring with a branch; some edges have the opposite direction.
compare::Scene rods(double damping) {
  compare::Scene scene;
  scene.name = "rods";
  compare::Mesh chain, ring;
  for (int k = 0; k <= 8; ++k) chain.positions.push_back({1e-3 * k, 3e-4 * k * k, 2e-4 * std::sin(0.9 * k)});
  for (Index k = 0; k < 8; ++k)
    chain.loose_edges.push_back(k % 3 == 1 ? compare::Edge{k + 1, k} : compare::Edge{k, k + 1});
  for (int k = 0; k < 5; ++k) {
    const double t = 2 * std::numbers::pi * k / 5;
    ring.positions.push_back({0.02 + 1e-3 * std::cos(t), 1e-3 * std::sin(t), 1e-4 * k});
  }
  ring.positions.push_back({0.022, 0, 1e-3});
  for (Index k = 0; k < 5; ++k) ring.loose_edges.push_back({k, (k + 1) % 5});
  ring.loose_edges.push_back({0, 5});
  compare::Body body;
  body.material.rod = compare::RodMaterial{.density = 1e-3, .stretch = 0.1, .bend = 2e-7, .damping = damping};
  body.name = "chain";
  append_body(scene, body, chain);
  body.name = "ring";
  append_body(scene, body, ring);
  scene.settings.time_step = 4e-4;
  compare::round_to_single(scene);
  return scene;
}

struct Bent {
  compare::Scene scene;
  compare::Topology topology;
  compare::RestStateOut rest;
  reference::RodSystem system;
  Positions start, x;

  explicit Bent(double damping)
      : scene(rods(damping)),
        topology(build_topology(scene)),
        rest(reference::rest_state({&scene, &topology}).exact),
        system(scene, rest) {
    for (std::size_t v = 0; v < scene.mesh.positions.size(); ++v) {
      const Vec3& p = scene.mesh.positions[v];
      const double s = static_cast<double>(v);
      start.push_back({p.x, p.y, p.z});
      x.push_back({p.x + 2e-4 * std::sin(3 * s), p.y + 2e-4 * std::cos(5 * s), p.z + 1e-4 * std::sin(7 * s)});
    }
    system.begin_step(start, 1);
    system.turn(x);
  }
  double energy(const Positions& at) const {
    double sum = 0;
    for (std::size_t i = 0; i < system.size(); ++i) sum += system.energy(i, at);
    return sum;
  }
};

}  // namespace

TEST_CASE("rods: forces are slopes of the energy, with damping and without", "[property]") {
  for (const double damping : {0.0, 1e-3}) {
    const Bent bent(damping);
    for (std::size_t v = 0; v < bent.x.size(); ++v) {
      reference::VertexSystemOf<double> sum;
      for (std::size_t e = 0; e < bent.system.segments(); ++e) {
        const auto& ends = bent.system.terms()[e].vertex;
        for (std::size_t end = 0; end < 2; ++end)
          if (ends[end] == static_cast<Index>(v))
            bent.system.add_force(
                static_cast<Index>(e), end,
                {bent.x[static_cast<std::size_t>(ends[0])], bent.x[static_cast<std::size_t>(ends[1])]}, sum);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        constexpr double step = 1e-6;
        Positions to = bent.x, from = bent.x;
        to[v][axis] += step, from[v][axis] -= step;
        // The energy is quadratic in one vertex, so a central difference is exact up to rounding.
        CHECK(sum.force[axis] == Approx((bent.energy(from) - bent.energy(to)) / (2 * step)).margin(1e-9));
      }
    }
  }
}

TEST_CASE("rods: a sweep of the segments never raises the energy, and comes to rest where no torque is left",
          "[property]") {
  for (const double damping : {0.0, 1e-3}) {
    Bent bent(damping);
    double before = bent.energy(bent.x);
    const double torque = bent.system.mean_torque(bent.x);
    for (int sweep = 0; sweep < 1000; ++sweep) {
      bent.system.sweep(bent.x);
      const double now = bent.energy(bent.x);
      CHECK(now <= before + 1e-15);
      before = now;
    }
    CHECK(bent.system.mean_torque(bent.x) < 1e-6 * torque);
  }
}

TEST_CASE("rods: the rest shape has no energy and no torque, and neighbours meet where exactly two segments do",
          "[unit]") {
  Bent bent(0);
  bent.system.set_start({});
  CHECK(bent.system.elastic_energy(bent.start) == Approx(0).margin(1e-15));
  // Frames are rounded to single precision, which causes torques of 2⁻²⁴ (σ + Σ w), with σ and w of compare/rods.md.
  // Here σ + Σ w is 2·10⁻³ N m.
  CHECK(bent.system.mean_torque(bent.start) < 1e-9);
  const std::vector<Index> colour = reference::segment_colours_of(
      bent.rest, compare::segment_groups(bent.scene, compare::rod_segments(bent.scene)));
  for (std::size_t e = 0; e < colour.size(); ++e)
    for (const Index f : bent.rest.segments[e].neighbour)
      if (f >= 0) CHECK(colour[e] != colour[static_cast<std::size_t>(f)]);
  // The branch begins at vertex 0 of the ring; the three segments there are not neighbours of each other.
  CHECK(bent.rest.segments[13].neighbour == std::array<Index, 2>{-1, -1});
  CHECK(bent.rest.segments[8].neighbour[0] == -1);
}

TEST_CASE("initial_guess: a frame turns with its segment, half round about its own first axis, or stays", "[unit]") {
  const auto turned = [](const compare::TurnCase& c) {
    compare::InitialGuessIn in;
    in.turns = {c};
    return reference::initial_guess(in).orientation.front();
  };
  const compare::Quaternion one{0, 0, 0, 1};
  const double half = std::sqrt(0.5);
  const std::array<double, 4> quarter = turned({{0, 0, 1}, {0, 3, 0}, one});
  CHECK(quarter[0] == Approx(-half));  // from z to y: −90° about x
  CHECK(quarter[3] == Approx(half));
  CHECK(turned({{0, 0, 1}, {0, 0, -2}, one}) == std::array<double, 4>{1, 0, 0, 0});
  CHECK(turned({{0, 0, 1}, {0, 0, 0}, one}) == std::array<double, 4>{0, 0, 0, 1});
}
