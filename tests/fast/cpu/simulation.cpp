#include "fast/cpu/simulation.hpp"

#include <cmath>
#include <cstring>

#include <tbb/global_control.h>

#include "compare/record/steps_csv.hpp"
#include "fast/resident_state.hpp"
#include "tests/catch.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

using Rows = std::vector<compare::StepMetrics>;

bool same_bits(const std::vector<compare::Vec3f>& a, const std::vector<compare::Vec3f>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(compare::Vec3f)) == 0;
}

// Returns a sheet that falls askew on a fixed sheet: contacts of all kinds, friction, damping, several detections a
// step.
compare::Scene drop_scene() {
  compare::Scene scene = empty_scene();
  compare::Material material;
  material.bending_damping = 2e-6, material.membrane_damping = 2e-6;
  add_sheet(scene, 12, 0.10, 0.012, false, material);
  add_sheet(scene, 9, 0.12, 0, true, material);
  for (compare::Index v = 0; v < 144; ++v) {
    compare::Vec3& x = scene.mesh.positions[static_cast<std::size_t>(v)];
    x.y += 0.1 * x.x + 0.05 * x.z;
  }
  for (auto& velocity : scene.velocities) velocity = {0.1, -0.3, 0.05};
  for (std::size_t v = 144; v < scene.velocities.size(); ++v) scene.velocities[v] = {};
  return scene;
}

struct Outcome {
  Rows rows;
  compare::Snapshot end;
};

Outcome run(const compare::Scene& scene, std::int64_t steps, const compare::SimulationOptions& options = {},
            int capacity = 0) {
  const auto simulation = start_cpu(scene, options, capacity);
  Outcome outcome;
  outcome.rows = simulation->advance(steps);
  outcome.end = simulation->snapshot();
  return outcome;
}

double mean(const std::vector<compare::Vec3f>& x, std::size_t first, std::size_t count, float compare::Vec3f::*axis) {
  double sum = 0;
  for (std::size_t v = first; v < first + count; ++v) sum += x[v].*axis;
  return sum / static_cast<double>(count);
}

// A cloth of 64 vertices, laid a hundredth of a millimetre within the radius above a fixed plane.
compare::Scene cloth_on_plane() {
  compare::Scene scene = empty_scene();
  compare::Material material;
  material.contact_stiffness = 10;
  add_sheet(scene, 8, 0.06, 0.00499, false, material);
  add_sheet(scene, 6, 0.10, 0, true, material);
  return scene;
}

}  // namespace

TEST_CASE("a cloth far from everything falls as -g h^2 n(n+1)/2 until the guess loop runs out of rounds, and says when",
          "[property]") {
  compare::Scene scene = empty_scene();
  add_sheet(scene, 10, 0.1, 1.0, false);
  const auto simulation = start_cpu(scene, {});
  const double g = 9.81f, h = scene.settings.time_step;
  double followed = 0;
  bool capped = false;
  for (int n = 1; n <= 100; ++n) {
    const compare::StepMetrics row = simulation->advance(1).at(0);
    REQUIRE(row.status == compare::step_clean);
    if (row.guess_rounds == scene.settings.guess_rounds && row.momentum_lost_guess > 1e-3) {
      capped = true;
      break;
    }
    const double fall = g * h * h * n * (n + 1) / 2;
    const auto x = simulation->snapshot().positions;
    double worst = 0;
    for (const compare::Vec3f& p : x) worst = std::max(worst, std::abs(p.y - (1.0f - fall)));
    // Each step rounds a position below 4 m to 2^-23 m once. Its velocity keeps this error, which grows to at most
    // n(n+1)/2 times as much. These errors strain the sheet. The internal forces that the sweep leaves displace
    // vertices by up to the same amount.
    REQUIRE(worst <= n * (n + 1) * 0x1p-23);
    REQUIRE(row.momentum_lost_end <= 1e-4);
    followed = g * h * n;
  }
  CHECK(capped);
  // Bounds allow this speed [m/s]: each of the 16 rounds of a step of 1/100 s moves a vertex by γ_p times an edge of
  // about 11 mm.
  CHECK(followed > 3.0);
  CHECK(followed < 16 * 0.45 * 0.012 / h);
}

TEST_CASE("the printed single round falls behind free fall at once where bounds are small, and reports the loss",
          "[property]") {
  compare::Scene scene = empty_scene();
  add_sheet(scene, 10, 0.1, 1.0, false);
  for (auto& v : scene.velocities) v = {0, -2, 0};
  scene.settings.guess_rounds = 1;
  const compare::StepMetrics row = run(scene, 1).rows.at(0);
  CHECK(row.guess_rounds == 1);
  CHECK(row.momentum_lost_guess > 0.5);
}

TEST_CASE("a cloth laid on a fixed plane rests just below a radius where sets are found before each iteration",
          "[property]") {
  compare::Scene scene = cloth_on_plane();
  scene.settings.detection_every = 1;
  const Outcome outcome = run(scene, 60);
  REQUIRE(outcome.rows.size() == 60);
  for (std::size_t v = 0; v < 64; ++v) {
    CHECK(outcome.end.positions[v].y > 0.0049);
    CHECK(outcome.end.positions[v].y < 0.00501);
    CHECK(std::abs(outcome.end.velocities[v].y) < 1e-3);
  }
  CHECK(outcome.rows.back().contact_energy > 0);
  CHECK(outcome.rows.back().vertex_facet_contacts >= 64);
}

TEST_CASE(
    "found once a step, the sets miss what a vertex just above a radius falls into, and the cloth chatters within a "
    "step of free fall",
    "[property]") {
  compare::Scene scene = cloth_on_plane();
  const double h = scene.settings.time_step;
  const Outcome outcome = run(scene, 100);
  for (std::size_t v = 0; v < 64; ++v) CHECK(std::abs(outcome.end.positions[v].y - 0.005) < 9.81 * h * h);
}

// Membrane and contact are soft compared with the inertia m/h² of 0.2 N/m, so that few sweeps suffice. The patch starts
// inside the plane's contact radius, and the normal force there brakes it in the first sweep. A stiff membrane would
// recover slowly from this, and stiff contacts do not converge (see the previous test).
TEST_CASE("a patch on a tilted plane holds with enough friction and slides at g (sin a - mu cos a) without",
          "[property]") {
  const double tilt = 0.35, h = 0.01;
  const auto slide = [&](double friction) {
    compare::Scene scene = empty_scene();
    compare::Material material;
    material.friction = friction;
    material.contact_stiffness = 1;
    material.lame_lambda = material.lame_mu = 1e-3;
    material.bending_stiffness = 1e-10;
    add_sheet(scene, 6, 0.05, 0.00499, false, material);
    add_sheet(scene, 8, 0.2, 0, true, material);
    scene.gravity = {9.81 * std::sin(tilt), -9.81 * std::cos(tilt), 0};
    scene.settings.iterations = 40;
    scene.settings.detection_every = 1;
    const Outcome outcome = run(scene, 6);
    return mean(outcome.end.velocities, 0, 36, &compare::Vec3f::x);
  };
  CHECK(slide(0.6) < 0.01);  // below eps_v: it sticks
  CHECK(slide(0.1) == Approx(9.81 * (std::sin(tilt) - 0.1 * std::cos(tilt)) * 6 * h).epsilon(0.03));
  CHECK(slide(0) == Approx(9.81 * std::sin(tilt) * 6 * h).epsilon(0.03));
}

TEST_CASE("the smallest distance of a row is that of the last detection, whatever share of it a bound is",
          "[property]") {
  for (const double share : {0.45, 0.3, 0.1}) {
    compare::Scene scene = empty_scene();
    scene.gravity = {};
    scene.settings.bounds_relaxation = share;
    compare::Material soft;
    soft.contact_stiffness = 1e-3;
    const double gap = 0.003;  // below r, and far below the sheets' spacing of 20 mm
    add_sheet(scene, 6, 0.1, gap, false, soft);
    add_sheet(scene, 6, 0.1, 0, true, soft);
    const compare::StepMetrics near = run(scene, 1).rows.at(0);
    REQUIRE(near.discrete_detections == 1);  // made at the start; no vertex leaves its bound later
    // The gap is rounded to single precision, the distance is lowered by its error bound, and the bound is rounded
    // down: about ten times 2⁻²⁴.
    CHECK(near.smallest_distance == Approx(gap).epsilon(32 * 0x1p-24));
    for (std::size_t v = 0; v < 36; ++v) scene.mesh.positions[v].y = 0.5;
    const compare::StepMetrics far = run(scene, 1).rows.at(0);
    CHECK(far.smallest_distance == Approx(far.query_radius).epsilon(32 * 0x1p-24));
  }
}

TEST_CASE(
    "the same scene gives the same bits twice, with other numbers of threads, in other frames, with profile and "
    "without energies",
    "[property]") {
  const compare::Scene scene = drop_scene();
  const Outcome first = run(scene, 12);
  CHECK(first.rows.back().edge_edge_contacts > 20);
  CHECK(same_bits(run(scene, 12).end.positions, first.end.positions));
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(same_bits(run(scene, 12).end.positions, first.end.positions));
  }
  {
    const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
    CHECK(same_bits(run(scene, 12).end.positions, first.end.positions));
  }
  compare::SimulationOptions options;
  options.profile = true;
  options.energies = false;
  const Outcome profiled = run(scene, 12, options);
  CHECK(same_bits(profiled.end.positions, first.end.positions));
  CHECK(std::isnan(profiled.rows[0].kinetic_energy));
  const auto simulation = start_cpu(scene, {});
  for (int k = 0; k < 12; ++k) simulation->advance(1);
  CHECK(same_bits(simulation->snapshot().positions, first.end.positions));
}

TEST_CASE("whether iterations are asked one by one or in groups whether a detection is due changes no bit",
          "[property]") {
  for (const std::int64_t every : {0, 1, 2, 3}) {
    INFO("detection_every " << every);
    compare::Scene scene = drop_scene();
    scene.settings.iterations = 13;  // two groups and a shorter one
    scene.settings.detection_fraction = every == 0 ? 1e-3 : 1;
    scene.settings.detection_every = every;
    const Outcome grouped = run(scene, 12);  // the first frame always groups iterations
    compare::SimulationOptions options;
    options.profile = true;  // one iteration at a time
    const Outcome profiled = run(scene, 12, options);
    const auto simulation = start_cpu(scene, {});
    std::int64_t redetections = 0;
    for (std::size_t k = 0; k < 12; ++k) {  // the previous frame decides whether a frame groups iterations
      const compare::StepMetrics row = simulation->advance(1).at(0), &expected = grouped.rows.at(k),
                                 &profiled_row = profiled.rows.at(k);
      for (const compare::StepMetrics* other : {&expected, &profiled_row}) {
        CHECK(row.discrete_detections == other->discrete_detections);
        CHECK(row.vertices_cut == other->vertices_cut);
        CHECK(row.iterations == other->iterations);
        CHECK(row.kinetic_energy == other->kinetic_energy);
      }
      CHECK(row.iterations == 13);
      redetections += row.discrete_detections - row.guess_rounds;
    }
    CHECK(redetections == (every == 0 ? redetections : 12 * (12 / every)));  // no detection follows the last iteration
    CHECK(redetections > 0);
    CHECK(same_bits(simulation->snapshot().positions, grouped.end.positions));
    CHECK(same_bits(profiled.end.positions, grouped.end.positions));
  }
}

TEST_CASE("a step that settles has the row and the bits of a step with as many iterations", "[property]") {
  constexpr double moves[] = {2e-3, 5e-4, 1e-4, 2e-5};
  compare::Scene scene = drop_scene();
  scene.settings.iterations = 12;
  compare::Snapshot state = start_cpu(scene, {})->snapshot();
  std::vector<int> measured(2);  // steps that end early after an even and an odd number of iterations
  for (std::size_t k = 0; k < 60; ++k) {
    INFO("step " << k);
    scene.settings.settled_move = moves[k % 4];
    state.step = 299;  // step 300 measures forces for nearly all numbers of iterations
    const auto settles = start_cpu(scene, {});
    settles->restore(state);
    Rows row = settles->advance(1);
    compare::Scene with_as_many = scene;
    with_as_many.settings.settled_move = 0;
    with_as_many.settings.iterations = row.at(0).iterations;
    const auto other = start_cpu(with_as_many, {});
    other->restore(state);
    Rows expected = other->advance(1);
    state = settles->snapshot();
    CHECK(same_bits(state.positions, other->snapshot().positions));
    CHECK(same_bits(state.velocities, other->snapshot().velocities));
    CHECK(state.bounds == other->snapshot().bounds);
    const bool is_measured = !std::isnan(expected.at(0).left_residual);
    CHECK(row[0].left_residual > 0);
    if (is_measured && row[0].iterations < 12) ++measured[static_cast<std::size_t>(row[0].iterations % 2)];
    for (compare::StepMetrics* each : {&row[0], &expected[0]}) {
      each->wall_ms = 0;
      if (!is_measured) each->left_residual = each->left_rounding = each->left_held = 0;
    }
    CHECK(compare::step_lines(row, 0) == compare::step_lines(expected, 0));
  }
  CHECK(measured[0] > 0);
  CHECK(measured[1] > 0);
}

TEST_CASE("a cloth that comes to rest settles, whether iterations are asked one by one or in groups", "[property]") {
  compare::Scene scene = cloth_on_plane();
  scene.settings.detection_every = 2;
  scene.settings.settled_move = 1e-6;
  const Outcome grouped = run(scene, 60);
  const auto simulation = start_cpu(scene, {});  // the previous frame decides whether a frame groups iterations
  std::int64_t iterations = 0;
  for (std::size_t k = 0; k < 60; ++k) {
    const compare::StepMetrics row = simulation->advance(1).at(0), &expected = grouped.rows.at(k);
    CHECK(row.iterations == expected.iterations);
    CHECK(row.discrete_detections == expected.discrete_detections);
    CHECK(row.kinetic_energy == expected.kinetic_energy);
    CHECK(row.last_motion == expected.last_motion);
    iterations += row.iterations;
  }
  CHECK(same_bits(simulation->snapshot().positions, grouped.end.positions));
  CAPTURE(grouped.rows.front().iterations, grouped.rows.back().iterations, iterations);
  CHECK(grouped.rows.front().iterations > grouped.rows.back().iterations);
  CHECK(iterations < 600);
  for (std::size_t v = 0; v < 64; ++v) CHECK(std::abs(grouped.end.positions[v].y - 0.00495) < 6e-5);
  scene.settings.settled_move = 0;
  for (const compare::StepMetrics& row : run(scene, 60).rows) CHECK(row.iterations == 10);
}

TEST_CASE("lists that start with room for one contact give the same bits, and the repeats are counted", "[property]") {
  const compare::Scene scene = drop_scene();
  const Outcome roomy = run(scene, 12), tight = run(scene, 12, {}, 1);
  CHECK(same_bits(roomy.end.positions, tight.end.positions));
  CHECK(same_bits(roomy.end.velocities, tight.end.velocities));
  std::int64_t repeats = 0;
  for (const auto& row : tight.rows) {
    CHECK(((row.status & compare::step_list_grew) != 0) == (row.repeats > 0));
    repeats += row.repeats;
  }
  CHECK(repeats > 0);
  REQUIRE(tight.rows.size() == roomy.rows.size());
  for (std::size_t k = 0; k < tight.rows.size(); ++k) {
    CHECK(tight.rows[k].step == static_cast<std::int64_t>(k) + 1);
    CHECK(tight.rows[k].discrete_detections == roomy.rows[k].discrete_detections);
    CHECK(tight.rows[k].kinetic_energy == roomy.rows[k].kinetic_energy);
  }
}

TEST_CASE("stored positions lie within the bounds of the last detection", "[property]") {
  const auto simulation = start_cpu(drop_scene(), {});
  for (int k = 0; k < 12; ++k) {
    REQUIRE(simulation->advance(1).at(0).status == compare::step_clean);
    const compare::Snapshot s = simulation->snapshot();
    for (std::size_t v = 0; v < s.positions.size(); ++v) {
      const double x = static_cast<double>(s.positions[v].x) - s.previous[v].x,
                   y = static_cast<double>(s.positions[v].y) - s.previous[v].y,
                   z = static_cast<double>(s.positions[v].z) - s.previous[v].z;
      REQUIRE(x * x + y * y + z * z <= static_cast<double>(s.bounds[v]) * s.bounds[v]);
    }
    REQUIRE(s.query_radius >= 0.005f);
    REQUIRE(s.query_radius <= 0.02f);
  }
}

TEST_CASE("energy only falls while a cloth drops, touches and slides", "[property]") {
  compare::Scene scene = drop_scene();
  for (auto& body : scene.bodies) body.material.contact_stiffness = 10;
  scene.settings.iterations = 60;
  scene.settings.detection_every = 1;
  const Outcome outcome = run(scene, 15);
  double before = INFINITY, start = 0;
  for (const auto& row : outcome.rows) {
    const double total = row.kinetic_energy + row.elastic_energy + row.contact_energy + row.gravity_energy;
    if (!std::isfinite(before)) start = row.kinetic_energy;
    // A step begins at a truncated guess. If its sweeps do not converge, the energy may rise by at most a thousandth of
    // the first kinetic energy.
    CHECK(total <= before + 1e-3 * start);
    before = total;
  }
}

TEST_CASE("handles that move faster than bounds allow fall behind, and catch up once they rest", "[property]") {
  compare::Scene scene = empty_scene();
  scene.gravity = {0, 0, 0};
  add_sheet(scene, 10, 0.1, 0, false);
  compare::PrescribedMotion motion;
  for (compare::Index v = 0; v < 10; ++v) motion.vertices.push_back(v);
  motion.velocity = {-8, 0, 0};  // 80 mm per step
  motion.end = 0.02;
  scene.motions.push_back(motion);
  scene.settings.guess_rounds = 1;
  const Outcome outcome = run(scene, 60);
  CHECK(outcome.rows[1].largest_lag > 0.01);
  CHECK(outcome.rows.back().largest_lag <= 1e-6);
  for (const auto& row : outcome.rows) CHECK(row.status == compare::step_clean);
  CHECK(outcome.end.positions[0].x == Approx(-0.05 - 0.16).epsilon(1e-5));
}

TEST_CASE("the share at the bound is that of the vertices that move", "[unit]") {
  compare::Scene scene = drop_scene();
  compare::PrescribedMotion fast;
  fast.vertices = {0, 1, 2, 3};
  fast.velocity = {0, 20, 0};
  scene.motions.push_back(fast);
  for (const compare::StepMetrics& row : run(scene, 3).rows) {
    CHECK(row.vertices_cut >= 4);
    CHECK(row.share_cut == static_cast<double>(row.vertices_cut) / 144);
  }
  for (compare::Body& body : scene.bodies) body.fixed = true;
  scene.motions.clear();
  scene.velocities.assign(scene.velocities.size(), {});
  CHECK(run(scene, 1).rows.at(0).share_cut == 0);
}

TEST_CASE("a slow handle is where its motion says after each step", "[unit]") {
  compare::Scene scene = empty_scene();
  add_sheet(scene, 6, 0.1, 0, false);
  compare::PrescribedMotion motion;
  motion.vertices = {0, 1, 2, 3, 4, 5};
  motion.angular_velocity = 0.5;
  scene.motions.push_back(motion);
  compare::round_to_single(scene);
  const auto simulation = start_cpu(scene, {});
  simulation->advance(3);
  const auto targets = compare::prescribed_targets(scene, scene.motions[0], 4 * scene.settings.time_step);
  CHECK(simulation->advance(1).at(0).largest_lag == 0);
  const auto x = simulation->snapshot().positions;
  for (std::size_t k = 0; k < 6; ++k) CHECK(x[k] == targets[k]);
}

TEST_CASE("a dense start is counted before the first step, so no step is repeated, and nothing else shows it",
          "[property]") {
  for (const compare::Bounds bounds : {compare::Bounds::ball, compare::Bounds::planes}) {
    INFO("bounds " << static_cast<int>(bounds));
    const compare::Scene scene = dense_stack(bounds);
    const auto counted = start_cpu(scene, {}), grown = start_cpu(scene, {}, 1);
    const compare::Snapshot start = counted->snapshot(), other = grown->snapshot();
    CHECK(same_bits(start.positions, other.positions));
    CHECK(same_bits(start.previous, other.previous));
    CHECK(start.bounds == other.bounds);
    CHECK(start.search_limits == other.search_limits);
    CHECK(start.planes.items.size() == other.planes.items.size());
    const Rows rows = counted->advance(3);
    for (const compare::StepMetrics& row : rows) CHECK(row.repeats == 0);
    CHECK(rows[0].vertex_facet_contacts + rows[0].edge_edge_contacts > 1024 + 4 * 800);
    CHECK(grown->advance(3)[0].repeats > 0);
    CHECK(same_bits(counted->snapshot().positions, grown->snapshot().positions));
    CHECK(counted->snapshot().bounds == grown->snapshot().bounds);
  }
}

TEST_CASE("lists grow before they are full, after the same steps whatever the frames, and with the same bits",
          "[property]") {
  const compare::Scene scene = drop_scene();
  const Outcome roomy = run(scene, 40);
  int most = 0;
  for (const compare::StepMetrics& row : roomy.rows)
    most = std::max(most, static_cast<int>(row.vertex_facet_contacts + row.edge_edge_contacts));
  const int capacity = most + most / 20;  // suffices, but becomes nearly full
  const auto whole = start_cpu(scene, {}, capacity), stepwise = start_cpu(scene, {}, capacity);
  const Rows rows = whole->advance(40);
  REQUIRE(rows.size() == 40);
  for (const compare::StepMetrics& row : rows) {
    CHECK(row.repeats == 0);
    stepwise->advance(1);
  }
  const compare::Snapshot a = whole->snapshot(), b = stepwise->snapshot();
  CHECK(a.capacities[0] > capacity);
  CHECK(a.capacities == b.capacities);
  CHECK(same_bits(a.positions, b.positions));
  CHECK(same_bits(a.positions, roomy.end.positions));
}

// A step leaves data that a snapshot does not have: the trees, sorted every 16 steps, contacts, bounds, and the strain
// and angles from which damping starts. None of them may change a result, so each step is taken by a new simulation.
TEST_CASE("a simulation that is replaced by a new one after each step comes to the same bits and the same rows",
          "[property]") {
  for (const compare::Bounds bounds : {compare::Bounds::ball, compare::Bounds::planes}) {
    INFO("bounds " << static_cast<int>(bounds));
    compare::Scene scene = drop_scene();
    scene.settings.bounds = bounds;
    constexpr std::int64_t steps = 40;
    Outcome whole = run(scene, steps, {}, 1);
    compare::Snapshot state = start_cpu(scene, {}, 1)->snapshot();
    Rows rows;
    for (std::int64_t k = 0; k < steps; ++k) {
      const auto next = start_cpu(scene, {});
      next->restore(state);
      rows.push_back(next->advance(1).at(0));
      state = next->snapshot();
    }
    CHECK(same_bits(state.positions, whole.end.positions));
    CHECK(same_bits(state.velocities, whole.end.velocities));
    CHECK(state.bounds == whole.end.bounds);
    CHECK(state.capacities == whole.end.capacities);
    CHECK(state.search_limits == whole.end.search_limits);
    CHECK(state.search_limits.empty() == (bounds == compare::Bounds::ball));
    std::int64_t repeats = 0;
    for (Rows* each : {&rows, &whole.rows})
      for (compare::StepMetrics& row : *each) row.wall_ms = 0, repeats += row.repeats;
    CHECK(repeats > 0);
    CHECK(compare::step_lines(rows, 0) == compare::step_lines(whole.rows, 0));
  }
}

TEST_CASE("before the first step a simulation is at the start of its scene, and nothing was detected", "[unit]") {
  const compare::Scene scene = drop_scene();
  const compare::Snapshot state = start_cpu(scene, {})->snapshot();
  CHECK(state.step == 0);
  CHECK(state.query_radius == 0);
  CHECK(state.bounds == std::vector<float>(state.positions.size(), 0.0F));
  CHECK(same_bits(state.positions, compare::to_single(scene.mesh.positions)));
  CHECK(same_bits(state.velocities, compare::to_single(scene.velocities)));
  CHECK(same_bits(state.previous, state.positions));
}

TEST_CASE("the resident state is the snapshot's, at one address, and other libraries' simulations have none",
          "[unit]") {
  const auto simulation = start_cpu(drop_scene(), {});
  ResidentState& state = resident_state(*simulation);
  const compare::Snapshot start = simulation->snapshot();
  const compare::Vec3f *x = state.positions_resident(), *v = state.velocities_resident();
  const auto check = [&] {
    const compare::Snapshot now = simulation->snapshot();
    const std::size_t count = now.positions.size();
    CHECK(same_bits({x, x + count}, now.positions));
    CHECK(same_bits({v, v + count}, now.velocities));
    CHECK(same_bits(state.positions(), now.positions));
    CHECK(same_bits(state.velocities(), now.velocities));
    CHECK(state.positions_resident() == x);
    return now;
  };
  CHECK(state.device_number() == -1);
  check();
  simulation->advance(3);
  CHECK(!same_bits(check().positions, start.positions));
  simulation->restore(start);
  CHECK(same_bits(check().positions, start.positions));

  struct Other : compare::Simulation {
    Rows advance(std::int64_t) override { return {}; }
    compare::Snapshot snapshot() override { return {}; }
    void restore(const compare::Snapshot&) override {}
    std::string device() const override { return {}; }
  } other;
  CHECK_THROWS_AS(resident_state(other), std::invalid_argument);
}

TEST_CASE("capacities of other lists and search limits of other meshes are refused", "[unit]") {
  compare::Snapshot state = start_cpu(drop_scene(), {})->snapshot();
  for (const std::vector<std::int64_t>& wrong :
       {std::vector<std::int64_t>{1}, {1, 0}, {1, std::int64_t{1} << 40}, {1, 1, 1}}) {
    state.capacities = wrong;
    CHECK_THROWS_AS(start_cpu(drop_scene(), {})->restore(state), std::invalid_argument);
  }
  compare::Scene scene = drop_scene();
  scene.settings.bounds = compare::Bounds::planes;
  compare::Snapshot limited = start_cpu(scene, {})->snapshot();
  limited.search_limits.pop_back();
  CHECK_THROWS_AS(start_cpu(scene, {})->restore(limited), std::invalid_argument);
}

TEST_CASE("a position that overflows stops the run with the last good state", "[unit]") {
  compare::Scene scene = drop_scene();
  scene.velocities[3] = {1e30, 0, 0};
  const Outcome outcome = run(scene, 5);
  REQUIRE(outcome.rows.size() == 1);
  CHECK(outcome.rows[0].status == compare::step_not_finite);
  CHECK(outcome.end.step == 0);
  CHECK(same_bits(outcome.end.positions, compare::to_single(scene.mesh.positions)));
}

TEST_CASE("scenes in which nothing is free, odd numbers of iterations and every width run", "[unit]") {
  compare::Scene still = empty_scene();
  add_sheet(still, 4, 0.1, 0, true);
  CHECK(run(still, 3).rows.back().iterations == 10);
  compare::Scene scene = drop_scene();
  scene.settings.iterations = 7;
  std::vector<double> heights;
  for (const std::int64_t lanes : {2, 4, 8, 16}) {
    scene.settings.lanes = lanes;
    const Outcome outcome = run(scene, 5);
    CHECK(outcome.rows.back().status == compare::step_clean);
    heights.push_back(mean(outcome.end.positions, 0, 144, &compare::Vec3f::y));
  }
  for (const double height : heights) CHECK(height == Approx(heights[0]).epsilon(1e-4));
}

TEST_CASE("re-detection after a set number of iterations is counted", "[unit]") {
  compare::Scene scene = drop_scene();
  const std::int64_t few = run(scene, 1).rows[0].discrete_detections;
  scene.settings.detection_every = 2;
  const compare::StepMetrics row = run(scene, 1).rows[0];
  CHECK(row.discrete_detections >= 1 + 4);
  CHECK(row.discrete_detections > few);
}

TEST_CASE("each activation, model and form of damping changes the result of a run, and each run is clean",
          "[property]") {
  std::vector<compare::Scene> scenes(1, drop_scene());
  for (int kind = 1; kind < 5; ++kind) {
    scenes.push_back(drop_scene());
    scenes.back().settings.contact_activation = static_cast<compare::ContactActivation>(kind);
  }
  const auto add = [&](auto change) {
    scenes.push_back(drop_scene());
    change(scenes.back());
  };
  add([](compare::Scene& scene) { scene.settings.damping = compare::DampingForm::per_vertex; });
  add([](compare::Scene& scene) { scene.bodies[0].material.membrane = compare::MembraneModel::st_venant_kirchhoff; });
  add([](compare::Scene& scene) { scene.bodies[0].material.bending = compare::BendingModel::isometric_quadratic; });
  add([](compare::Scene& scene) { scene.springs = {{3, 140, 0.5, 0, 1e-3}}; });
  std::vector<std::vector<compare::Vec3f>> ends;
  for (compare::Scene& scene : scenes) {
    // contacts become deeper than r/2
    for (compare::Body& body : scene.bodies) body.material.contact_stiffness *= 1e-4;
    const Outcome outcome = run(scene, 24);
    REQUIRE(outcome.rows.size() == 24);
    CHECK(outcome.rows.back().status == compare::step_clean);
    CHECK(outcome.rows.back().elastic_energy > 0);
    for (const auto& other : ends) CHECK_FALSE(same_bits(outcome.end.positions, other));
    ends.push_back(outcome.end.positions);
  }
}

namespace {

/// Returns two sheets beside each other in one plane, 8 mm apart, at rest and without gravity. Each border vertex of
/// the second sheet is stitched to the border of the first.
compare::Scene seam_scene(bool excluded) {
  compare::Scene scene = empty_scene();
  scene.gravity = {};
  add_sheet(scene, 9, 0.08, 0, false);
  add_sheet(scene, 7, 0.08, 0, false);
  for (std::size_t v = 81; v < 130; ++v) {
    scene.mesh.positions[v].x += 0.088;
    scene.rest_positions[v].x += 0.088;
  }
  for (int k = 0; k < 7; ++k) {
    const double place = 8 * k / 6.0;
    const int below = std::min(7, static_cast<int>(place));
    add_stitch(scene, 81 + k, 72 + below, 73 + below, place - below, 20);
  }
  if (!excluded) scene.excluded_pairs.clear();
  round_to_single(scene);
  return scene;
}

/// Returns the length of the longest stitch [m].
double widest_gap(const compare::Scene& scene, const std::vector<compare::Vec3f>& x) {
  double widest = 0;
  for (const compare::Spring& s : scene.springs) {
    const auto at = [&](compare::Index v) { return x[static_cast<std::size_t>(v)]; };
    const auto apart = [&](float compare::Vec3f::*axis) {
      const double other = s.third < 0 ? at(s.second).*axis
                                       : (1 - s.ratio) * (at(s.second).*axis) + s.ratio * (at(s.third).*axis);
      return at(s.first).*axis - other;
    };
    widest = std::max(widest,
                      std::hypot(apart(&compare::Vec3f::x), apart(&compare::Vec3f::y), apart(&compare::Vec3f::z)));
  }
  return widest;
}

}  // namespace

TEST_CASE("a seam of stitches closes where the pairs beside it are no contacts, and stays open where they are",
          "[property]") {
  const compare::Scene seam = seam_scene(true), repelled = seam_scene(false);
  const Outcome closed = run(seam, 150), open = run(repelled, 150);
  CHECK(closed.rows.back().status == compare::step_clean);
  CHECK(open.rows.back().status == compare::step_clean);
  // A stitch of 20 N/m acts against a contact of at most k_c r/2; they balance at more than r/10. Without contacts,
  // only the sheets resist a stitch.
  CHECK(widest_gap(seam, closed.end.positions) < 0.05 * seam.settings.contact_radius);
  CHECK(widest_gap(repelled, open.end.positions) > 0.1 * seam.settings.contact_radius);
}

TEST_CASE("a surface that keyframes deform carries a sheet along, and follows its keyframes", "[property]") {
  compare::Scene scene = empty_scene();
  add_sheet(scene, 8, 0.06, 6e-3, false);
  add_sheet(scene, 9, 0.10, 0, false);
  scene.bodies[1].material.membrane = compare::MembraneModel::none;
  scene.bodies[1].material.bending = compare::BendingModel::none;
  compare::PrescribedMotion motion;
  motion.name = "swell";
  motion.keyframes.times = {0, 0.1, 0.4};
  for (const double time : motion.keyframes.times)
    for (compare::Index v = 64; v < 145; ++v) {
      const compare::Vec3 x = scene.mesh.positions[static_cast<std::size_t>(v)];
      if (time == 0) motion.vertices.push_back(v);
      motion.keyframes.positions.push_back({static_cast<float>(x.x),
                                            static_cast<float>(x.y + time * (0.1 + 0.5 * std::cos(20 * x.x))),
                                            static_cast<float>(x.z)});
    }
  scene.motions.push_back(motion);
  const Outcome outcome = run(scene, 50);
  CHECK(outcome.rows.back().status == compare::step_clean);
  CHECK(outcome.rows.back().largest_lag == 0);  // at rest since t = 0.4 s
  for (std::size_t k = 0; k < 81; ++k) {
    const compare::Vec3f& x = outcome.end.positions[64 + k];
    CHECK(x == motion.keyframes.positions[162 + k]);
  }
  // The surface has risen by 0.4 (0.1 + 0.5 cos 20 x) ≥ 0.2 m under the sheet, which began 6 mm above the surface.
  CHECK(mean(outcome.end.positions, 0, 64, &compare::Vec3f::y) > 0.2);
}
