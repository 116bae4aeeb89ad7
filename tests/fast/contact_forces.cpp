#include "fast/contact_forces.hpp"

#include <cstring>
#include <limits>
#include <string>
#include <utility>

#include <tbb/global_control.h>

#include "compare/problem/error.hpp"
#include "compare/stages/activation.hpp"
#include "fast/cpu/backend.hpp"
#include "fast/guard.hpp"
#include "fast/stages/detection.hpp"
#include "fast/stages/sweep.hpp"
#include "tests/fast/contact_force_cases.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using tests::ContactQuestion;
using tests::ContactWorld;
using tests::D3;
using tests::Positions;

namespace {

/// Finds the contacts of a world and evaluates its forces.
struct Evaluation {
  fast::ContactFinder finder;
  fast::FoundContacts contacts;
  fast::ContactForces forces;

  explicit Evaluation(const ContactWorld& world)
      : finder(world.mesh.connectivity()),
        contacts{finder.find_resident(world.previous.data(), world.query()), world.previous.data()},
        forces(world.forces()) {}
};

fast::ContactForceSums sums_of(const ContactWorld& world, bool with_friction = true) {
  Evaluation at(world);
  return at.forces.evaluate(at.contacts, world.x, with_friction ? world.sliding() : fast::Sliding{});
}

bool same_bits(const fast::ContactForceSums& a, const fast::ContactForceSums& b) {
  const auto same = [](const auto& p, const auto& q) {
    return p.size() == q.size() && std::memcmp(p.data(), q.data(), p.size() * sizeof(p[0])) == 0;
  };
  return std::memcmp(&a.energy, &b.energy, sizeof(a.energy)) == 0 && same(a.force, b.force) &&
         same(a.friction, b.friction) && same(a.block, b.block);
}

/// Returns the normal forces of all contacts: their sum, and the most contacts that a vertex has.
struct NormalForces {
  double sum = 0;
  int most = 0;

  explicit NormalForces(const ContactWorld& world) {
    std::vector<int> contacts(world.x.size());
    for (const ContactQuestion& contact : world.questions()) {
      sum -= tests::activation_of(contact, tests::points_of(contact)).slope;
      for (int k = 0; k < contact.count(); ++k) most = std::max(most, ++contacts[contact.vertex[at(k)]]);
    }
  }
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }
};

double largest_coordinate(const Positions& x) {
  double largest = 0;
  for (const compare::Vec3f& a : x)
    largest = std::max({largest, double{std::abs(a.x)}, double{std::abs(a.y)}, double{std::abs(a.z)}});
  return largest;
}

}  // namespace

TEST_CASE("contact_forces: each vertex has the sum of the reference's answers to the judge's stages", "[property]") {
  for (ContactWorld& world : tests::contact_worlds()) {
    const std::size_t count = world.x.size();
    int kinds[4] = {}, mollified = 0;
    for (const ContactQuestion& contact : world.questions()) {
      ++kinds[static_cast<int>(contact.question.sides)];
      mollified += tests::share_of(contact) < 1 ? 1 : 0;
    }
    INFO("kinds " << kinds[0] << " " << kinds[1] << " " << kinds[2] << " " << kinds[3] << ", mollified " << mollified);
    CHECK(kinds[0] + kinds[1] > 0);
    CHECK(kinds[2] > 10);
    CHECK(kinds[3] > 5);
    CHECK(tests::count_wrong(world, sums_of(world), true) == 0);
    CHECK(tests::count_wrong(world, sums_of(world, false), false) == 0);
    // Vertices that are updated together have larger blocks.
    world.colours.assign(count, 0);
    CHECK(tests::count_wrong(world, sums_of(world), true) == 0);
    for (std::size_t v = 0; v < count; ++v) world.colours[v] = static_cast<compare::Index>(v % 3);
    CHECK(tests::count_wrong(world, sums_of(world), true) == 0);
  }
}

TEST_CASE("contact_forces: the comparison sees wrong rest lengths, positions, starts, colours and constants",
          "[property]") {
  // The second world has mollified edges; with ipc_log every contact has a force that depends on all constants.
  const ContactWorld world = tests::contact_worlds()[1];
  const fast::ContactForceSums sums = sums_of(world);
  const auto is_seen = [&](auto change) {
    ContactWorld wrong = world;
    change(wrong);
    return tests::count_wrong(wrong, sums, true) > 10;
  };
  CHECK(is_seen([](ContactWorld& w) { w.rest = w.previous; }));
  CHECK(is_seen([](ContactWorld& w) { w.x = w.previous; }));
  CHECK(is_seen([](ContactWorld& w) { std::swap(w.x, w.start); }));
  CHECK(is_seen([](ContactWorld& w) { w.colours.assign(w.x.size(), 0); }));
  CHECK(is_seen([](ContactWorld& w) { w.options.contact_stiffness *= 1.0001F; }));
  CHECK(is_seen([](ContactWorld& w) { w.options.friction *= 1.001F; }));
  CHECK(is_seen([](ContactWorld& w) { w.time_step *= 1.001; }));
  CHECK(is_seen([](ContactWorld& w) { w.options.contact_activation = compare::ContactActivation::ogc; }));
}

TEST_CASE("contact_forces: energies are those of the contacts, and the force is minus their derivative", "[property]") {
  for (const ContactWorld& world : tests::contact_worlds()) {
    const fast::ContactForceSums sums = sums_of(world, false);
    const std::vector<ContactQuestion> questions = world.questions();
    std::vector<std::vector<std::pair<const ContactQuestion*, std::size_t>>> at_vertex(world.x.size());
    fast::ContactEnergy energy;
    double error = 0;
    for (const ContactQuestion& contact : questions) {
      const std::array<D3, 4> x = tests::points_of(contact);
      const reference::ActivationValue value = tests::activation_of(contact, x);
      (contact.edge_edge ? energy.edge_edge : energy.vertex_facet) += value.energy;
      double size = 0;
      for (int k = 1; k < contact.count(); ++k) size += fast::test::length(x[NormalForces::at(k)] - x[0]);
      // e_k errs by 15 units (compare/stages/contact_force.hpp), the distance by contact_grey units of its scale.
      error += compare::unit_roundoff *
               ((compare::activation_tolerance + 15) * value.energy_scale - value.slope * compare::contact_grey * size);
      for (int k = 0; k < contact.count(); ++k)
        at_vertex[contact.vertex[NormalForces::at(k)]].push_back({&contact, NormalForces::at(k)});
    }
    CHECK(std::abs(sums.energy.vertex_facet - energy.vertex_facet) <= error);
    CHECK(std::abs(sums.energy.edge_edge - energy.edge_edge) <= error);
    CHECK(sums.energy.total() == sums.energy.vertex_facet + sums.energy.edge_edge);
    CHECK(error < 1e-4 * energy.total());

    const std::vector<tests::ExpectedForce> expected = tests::expected_forces(world, false);
    double largest_force = 0, largest_tolerance = 0;
    for (std::size_t v = 0; v < world.x.size(); ++v) {
      const auto slope_of = [&](int axis, double step, double& size) {
        double ends[2] = {};
        for (int end = 0; end < 2; ++end) {
          for (const auto& [contact, own] : at_vertex[v]) {
            std::array<D3, 4> x = tests::points_of(*contact);
            fast::test::axis(x[own], axis) += end == 0 ? -step : step;
            ends[end] += tests::activation_of(*contact, x).energy;
          }
        }
        size = ends[0] + ends[1];
        return (ends[1] - ends[0]) / (2 * step);
      };
      D3 push = tests::wide(sums.force[v]);
      for (int axis = 0; axis < 3; ++axis) {
        // A central difference errs by step² E'''/6, and twice the step by four times that, so their difference is
        // three times the error. Where E'' jumps, at a change of the closest feature, both err by a share of the step,
        // and the difference is at least the error. Energies err by a few 2⁻⁵³ of themselves, with ill-conditioned
        // distances by up to 2⁻⁴⁰ in these worlds.
        const double step = 1e-4 * world.options.contact_radius;
        double size = 0, ignored = 0;
        const double fine = slope_of(axis, step, size), coarse = slope_of(axis, 2 * step, ignored);
        const double tolerance = std::abs(coarse - fine) + 0x1p-40 * size / step + expected[v].force_error +
                                 compare::unit_roundoff * expected[v].terms * expected[v].force_size;
        INFO("vertex " << v << ", axis " << axis);
        CHECK(std::abs(fast::test::axis(push, axis) + fine) <= tolerance);
        largest_tolerance = std::max(largest_tolerance, tolerance);
      }
      largest_force = std::max(largest_force, fast::test::length(push));
    }
    CHECK(largest_tolerance < 1e-2 * largest_force);
  }
}

TEST_CASE("contact_forces: forces add up to 0, contacts without friction have no torque, blocks are semidefinite",
          "[property]") {
  for (const ContactWorld& world : tests::contact_worlds()) {
    const NormalForces normal(world);
    // On each contact the weights err by 3 units, and their products with slope and normal by 2. A vertex rounds each
    // partial sum, which is at most the sum of its terms. Each contact has at most four weights up to 1.
    const double rounding = compare::unit_roundoff * 4 * (5 + normal.most) * normal.sum,
                 arm = 3 * largest_coordinate(world.x);
    REQUIRE(normal.sum > 1);
    for (const bool with_friction : {false, true}) {
      const fast::ContactForceSums sums = sums_of(world, with_friction);
      D3 force, torque;
      double size = 0;
      for (std::size_t v = 0; v < sums.force.size(); ++v) {
        const D3 push = tests::wide(sums.force[v]);
        force = force + push;
        torque = torque + cross(tests::wide(world.x[v]), push);
        size += fast::test::length(push);
        // Rounding of the sum of blocks may lower an eigenvalue by this at most; each block alone is rounded by a few
        // units of its largest entry.
        const auto& b = sums.block[v];
        const double trace = double{b[0]} + b[3] + b[5], shift = compare::unit_roundoff * (8 + 2 * normal.most) * trace;
        const double xx = b[0] + shift, yy = b[3] + shift, zz = b[5] + shift, xy = b[1], xz = b[2], yz = b[4];
        CHECK(xx * yy - xy * xy >= 0);
        CHECK(xx * zz - xz * xz >= 0);
        CHECK(xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz) >= 0);
        CHECK(trace >= 0);
      }
      const double share = with_friction ? 1 + world.options.friction : 1;
      CHECK(fast::test::length(force) <= share * rounding);
      // A friction force acts at both contact points, which are d apart, so it has a torque. Σ wᵢ xᵢ = d n errs by a
      // few units of the arm, as n does.
      if (!with_friction) CHECK(fast::test::length(torque) <= 4 * arm * rounding);
      CHECK(size > 100 * share * rounding);
    }
  }
}

TEST_CASE("contact_forces: friction opposes sliding, and a contact's friction is at most mu lambda", "[property]") {
  for (const ContactWorld& world : tests::contact_worlds()) {
    const NormalForces normal(world);
    const fast::ContactForceSums with = sums_of(world), without = sums_of(world, false);
    double power = 0, size = 0, friction = 0;
    for (std::size_t v = 0; v < world.x.size(); ++v) {
      const D3 moved = tests::wide(world.x[v]) - tests::wide(world.start[v]), rub = tests::wide(with.friction[v]);
      power += dot(rub, moved);
      size += fast::test::length(rub) * fast::test::length(moved);
      friction += fast::test::length(rub);
      CHECK(without.friction[v] == compare::Vec3f{});
      // Each of the three is rounded once for each contact.
      const D3 gap = tests::wide(with.force[v]) - tests::wide(without.force[v]) - rub;
      CHECK(fast::test::length(gap) <= compare::unit_roundoff * 3 * (normal.most + 4) * normal.sum);
    }
    CHECK(power < -0.05 * size);
    // The weights of both sides add up to 1.
    CHECK(friction <= 2 * world.options.friction * normal.sum * (1 + compare::unit_roundoff * 64));
    CHECK(friction > 0.01 * world.options.friction * normal.sum);
  }
  // One contact, a vertex over the inside of a triangle: the law itself, for slow and fast sliding.
  tests::TestMesh mesh;
  mesh.positions = {{-4, 0, -4}, {4, 0, -4}, {0, 0, 6}, {0, 0.25F, 0}, {0, 8, 1}, {1, 8, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  for (const float slip : {0.001F, 0.0049F, 0.02F}) {
    ContactWorld world = tests::moved_world(mesh, 0.375F, 0, 0, 1, 1);
    for (std::size_t v = 3; v < 6; ++v) world.start[v].x -= slip;
    REQUIRE(world.questions().size() == 1);
    const fast::ContactForceSums sums = sums_of(world);
    // λ = k_c (r − d) = 12.5 N; ε_v h = 0.005 m
    const double y = std::min(slip / 0.005, 1.0), strength = 0.3 * 12.5 * y * (2 - y);
    CHECK(sums.force[3].y == Approx(12.5));
    CHECK(sums.force[3].x == Approx(-strength));
    CHECK(sums.friction[3].x == Approx(-strength));
    CHECK(sums.friction[3].y == 0);
    CHECK(sums.block[3][0] == Approx(strength / slip));
    CHECK(sums.block[3][3] == Approx(100));
    CHECK(sums.energy.vertex_facet == Approx(0.5 * 100 * 0.125 * 0.125));
    CHECK(sums.energy.edge_edge == 0);
  }
}

TEST_CASE("contact_forces: the bits are those that a sweep gathers for its contacts", "[property]") {
  compare::Scene scene = fast::test::empty_scene();
  compare::Material material;
  material.friction = 0.3;
  scene.settings.contact_radius = 0.02;
  fast::test::add_sheet(scene, 9, 0.1, 0.012, false, material);
  fast::test::add_sheet(scene, 8, 0.1, 0, false, material);
  const compare::Topology topology = compare::build_topology(scene);
  const fast::RestState rest = fast::build_rest_state(scene, topology);
  const fast::Colouring colouring = fast::colour_vertices(rest);
  ContactWorld world;
  world.mesh.triangles = scene.mesh.triangles;
  for (const compare::Vec3& p : scene.mesh.positions)
    world.mesh.positions.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  world.rest = world.mesh.positions;
  world.previous = tests::jittered(world.mesh, 2e-3F, 7).positions;
  world.x = tests::jittered(world.mesh, 2e-3F, 8).positions;
  world.start = tests::jittered(world.mesh, 2e-3F, 9).positions;
  world.colours.assign(colouring.colour.begin(), colouring.colour.end());
  world.options = {.contact_radius = 0.02F, .contact_stiffness = 100, .friction = 0.3F};
  world.time_step = scene.settings.time_step;
  const fast::ContactForceSums sums = sums_of(world);

  fast::CpuBackend backend;
  fast::ContactFinder finder(world.mesh.connectivity());
  const fast::ContactView found = finder.find_resident(world.previous.data(), world.query());
  fast::Sweep<fast::CpuBackend> sweep(backend, rest, colouring, topology, scene);
  sweep.reserve_contacts(*found.vertex_facet_count + *found.edge_edge_count);
  sweep.resolve_contacts(found, reinterpret_cast<const fast::Vec*>(world.previous.data()));
  std::vector<fast::PaddedVec> x, start;
  const auto pad = [](const compare::Vec3f& p) { return fast::PaddedVec(fast::Vec{p.x, p.y, p.z}); };
  // The fresh buffer has the same positions as the old one.
  for (int copy = 0; copy < 2; ++copy)
    for (const compare::Vec3f& p : world.x) x.push_back(pad(p));
  for (const compare::Vec3f& p : world.start) start.push_back(pad(p));
  fast::SweepView view;
  sweep.complete(view);
  view.old = x.data();
  view.to_fresh = static_cast<int>(world.x.size());
  view.start = {start.data()};
  view.contact_radius = 0.02F;
  view.friction_limit = world.slip_limit();
  int wrong = 0, with_contacts = 0;
  for (int slot = 0; slot < sweep.slots(); ++slot) {
    const fast::ContactParts<fast::OgcActivation> parts{view, view.contact_rows[slot], {}};
    const auto sum = fast::SerialTeam<8>{}.sum<fast::ForceAndBlock>(parts.vertex_facet(), parts.edge_edge());
    const auto v = static_cast<std::size_t>(view.vertices[slot].vertex);
    wrong += std::memcmp(&sum.force, &sums.force[v], sizeof(sum.force)) != 0 ? 1 : 0;
    wrong += std::memcmp(&sum.block, &sums.block[v], sizeof(sum.block)) != 0 ? 1 : 0;
    with_contacts += view.contact_rows[slot].vertex_facet.count + view.contact_rows[slot].edge_edge.count > 0 ? 1 : 0;
  }
  CHECK(wrong == 0);
  CHECK(with_contacts > 100);
}

TEST_CASE("contact_forces: the same bits again, with one and two threads, in the backend's memory and after a move",
          "[unit]") {
  for (const ContactWorld& world : tests::contact_worlds()) {
    Evaluation at(world);
    const fast::ContactForceSums sums = at.forces.evaluate(at.contacts, world.x, world.sliding());
    for (const std::size_t threads : {1, 2}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      CHECK(same_bits(at.forces.evaluate(at.contacts, world.x, world.sliding()), sums));
    }
    fast::ContactForces moved = std::move(at.forces);
    fast::ContactForceSums own = sums;
    std::fill(own.force.begin(), own.force.end(), compare::Vec3f{1, 1, 1});
    std::fill(own.friction.begin(), own.friction.end(), compare::Vec3f{1, 1, 1});
    std::fill(own.block.begin(), own.block.end(), fast::ContactBlock{1, 1, 1, 1, 1, 1});
    const fast::SlidingResident sliding{world.start.data(), world.time_step};
    own.energy = moved.evaluate_resident(at.contacts, world.x.data(), sliding,
                                         {own.force.data(), own.friction.data(), own.block.data()});
    CHECK(same_bits(own, sums));
    // Each result alone, and the energy alone.
    Positions force(world.x.size());
    CHECK(moved.evaluate_resident(at.contacts, world.x.data(), sliding, {.force = force.data()}).total() ==
          sums.energy.total());
    CHECK((force == sums.force));
    CHECK(moved.evaluate_resident(at.contacts, world.x.data(), {}, {}).total() == sums.energy.total());
  }
}

TEST_CASE("contact_forces: a guard's contacts are those of its last detection", "[unit]") {
  ContactWorld world = tests::contact_worlds()[2];
  fast::Guard guard(world.mesh.connectivity(), world.previous,
                    {.contact_radius = world.options.contact_radius, .query_radius = 0.1F, .detection_fraction = 1});
  fast::ContactForces forces = world.forces();
  const auto sums = [&] {
    return forces.evaluate({guard.contacts(), guard.detected_at_resident()}, world.x, world.sliding());
  };
  CHECK(same_bits(sums(), sums_of(world)));
  const std::size_t count = world.x.size();
  Positions out(count);
  const fast::GuardReport report = guard.step(world.previous, Positions(count, {0.001F, 0.002F, -0.001F}), out);
  CHECK_FALSE(report.detected);
  CHECK(same_bits(sums(), sums_of(world)));
  guard.detect();
  world.previous = out;
  CHECK(same_bits(sums(), sums_of(world)));
}

TEST_CASE("contact_forces: wrong input is refused by argument, vertex and value", "[unit]") {
  const ContactWorld world = tests::contact_worlds()[0];
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto refused = [](auto action, const std::string& part) {
    CHECK_THROWS_WITH(action(), ContainsSubstring(part));
    CHECK_THROWS_AS(action(), compare::InputError);
  };
  const auto made = [&](auto change) {
    return [&world, change] {
      ContactWorld wrong = world;
      change(wrong);
      wrong.forces();
    };
  };
  refused(made([](ContactWorld& w) { w.options.contact_radius = 0; }), "contact_radius is 0, but a positive number");
  refused(made([&](ContactWorld& w) { w.options.contact_stiffness = nan; }), "contact_stiffness is nan");
  refused(made([](ContactWorld& w) { w.options.friction = -0.5F; }), "friction is -0.5, but 0 or");
  refused(made([](ContactWorld& w) { w.options.friction_velocity = 0; }), "friction_velocity is 0");
  refused(made([](ContactWorld& w) { w.rest.pop_back(); }), "rest: 71 vectors for 72 vertices");
  refused(made([&](ContactWorld& w) { w.rest[5].z = nan; }), "rest: vertex 5 has (");
  refused(made([](ContactWorld& w) { w.colours = {1, 2}; }), "colours: 2 numbers for 72 vertices");
  refused(made([](ContactWorld& w) {
            w.colours.assign(72, 0);
            w.colours[7] = -1;
          }),
          "colours: vertex 7 has -1");

  Evaluation at(world);
  Positions broken = world.x, few(5);
  broken[9].y = nan;
  const auto ask = [&](const Positions& x, const Positions& start, double time_step) {
    return [&, time_step] { at.forces.evaluate(at.contacts, x, {start, time_step}); };
  };
  refused(ask(few, world.start, 1), "positions: 5 vectors for 72 vertices");
  refused(ask(broken, world.start, 1), "positions: vertex 9 has (");
  refused(ask(world.x, few, 1), "start: 5 vectors");
  refused(ask(world.x, broken, 1), "start: vertex 9 has (");
  for (const double time_step : {0.0, -1.0, 1e-50, 1e50, double{nan}})
    refused(ask(world.x, world.start, time_step), "time_step is ");
  refused([&] { at.forces.evaluate({}, world.x); }, "contacts: no contacts of a detection");
  refused([&] { at.forces.evaluate_resident({at.contacts.view, nullptr}, world.x.data(), {}, {}); }, "contacts: ");
  refused(
      [&] {
        at.forces.evaluate_resident(at.contacts, world.x.data(), {world.start.data(), 0}, {});
      },
      "time_step is 0");
  const fast::Mesh empty(0, {});
  CHECK(fast::ContactForces(empty, {}, world.options).evaluate({}, {}).energy.total() == 0);
  if (!fast::backend_info(fast::Backend::cuda).usable)
    CHECK_THROWS_AS(world.forces(fast::Backend::cuda), compare::ResourceError);
}
