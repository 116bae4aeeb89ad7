// Tests that laws can fail. A converged solve by Newton's method obeys each law. A solve with another value of a
// constant breaks the law, which still assumes the original value.
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include "compare/laws/law.hpp"
#include "compare/laws/measures.hpp"
#include "compare/problem/error.hpp"
#include "reference/contestant.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::compare;

namespace {

Trajectory moved(const Scene& asked, const Scene& simulated) {
  Trajectory run{.scene = asked,
                 .by = {.is_solved = true, .has_contact_energy = true},
                 .states = {{asked.mesh.positions, asked.velocities}},
                 .rows = {}};
  const auto simulation = reference::newton().start(simulated, {});
  for (std::int64_t n = 0; n < simulated.settings.steps; ++n) {
    run.rows.push_back(simulation->advance(1).at(0));
    REQUIRE((run.rows.back().status & ~step_list_grew) == step_clean);
    const Snapshot snapshot = simulation->snapshot();
    run.states.push_back({to_double(snapshot.positions), to_double(snapshot.velocities)});
  }
  return run;
}

using Change = std::function<void(Scene&)>;

std::vector<Reading> asked(const Law& law, const Change& change) {
  std::vector<Trajectory> runs;
  for (const Scene& scene : law.scenes(LawSize::least)) {
    Scene other = scene;
    if (change) change(other);
    round_to_single(other);
    runs.push_back(moved(scene, other));
  }
  return law.read(runs);
}

Change gravity_times(double factor) {
  return [factor](Scene& scene) {
    scene.gravity = {factor * scene.gravity.x, factor * scene.gravity.y, factor * scene.gravity.z};
  };
}

Change times(double Material::*constant, double factor) {
  return [constant, factor](Scene& scene) {
    for (Body& body : scene.bodies) body.material.*constant *= factor;
  };
}

/// The change that each law must notice.
const std::map<std::string_view, Change> changes{
    {"free_fall", gravity_times(1.001)},
    {"free_fall_order", gravity_times(1.01)},
    {"momentum",
     [](Scene& scene) {
       scene.gravity = {0, -0.05, 0};
     }},
    {"spin", [](Scene& scene) { scene.settings.time_step /= 2; }},
    {"slope_slides", times(&Material::friction, 0.95)},
    {"slope_sticks", times(&Material::friction, 0.8)},
    {"slope_frictionless", [](Scene& scene) { scene.bodies[0].material.friction = 0.02; }},
    {"sliding_stops", times(&Material::friction, 0.9)},
    {"block_slides", times(&Material::friction, 0.95)},
    {"block_sticks", times(&Material::friction, 0.8)},
    {"weight_on_floor", gravity_times(1.01)},
    {"stack_at_rest", gravity_times(1.01)},
    {"lifts_off", gravity_times(0.99)},
    {"partner_leaves", gravity_times(0.99)},
    {"beyond_contact", [](Scene& scene) { scene.settings.contact_radius = 0.0101; }},
    {"lets_go", times(&Material::contact_stiffness, 1.5)},
    {"bounces", times(&Material::contact_stiffness, 1.5)},
    {"pinch_sticks", times(&Material::friction, 0.95)},
    {"conveyor", times(&Material::friction, 0.9)},
    {"hanging_strip", times(&Material::lame_mu, 0.95)},
    {"hanging_bar", times(&Material::solid_mu, 0.95)},
    {"cantilever_hinge", times(&Material::bending_stiffness, 0.95)},
    {"cantilever_tetrahedron", times(&Material::solid_mu, 0.95)},
    {"cantilever_bar", times(&Material::solid_mu, 0.2)},
    {"pendulum", gravity_times(1.05)},
    {"pinned_sheet",
     [](Scene& scene) {
       scene.motions[0].velocity = {1, 0, 0};  // the force that moves the corner does work on the sheet
     }},
};

/// Returns a run whose states all equal the start, at rest.
Trajectory still(const Scene& scene) {
  const std::size_t steps = static_cast<std::size_t>(scene.settings.steps);
  return {.scene = scene,
          .by = {.is_solved = true, .has_contact_energy = true},
          .states = std::vector<LawState>(steps + 1, {scene.mesh.positions, scene.velocities}),
          .rows = std::vector<StepMetrics>(steps)};
}

}  // namespace

TEST_CASE("laws: a converged solve obeys them, and another constant breaks them", "[property]") {
  for (const auto& [name, change] : changes) {
    const Law& law = find_law(name);
    const std::vector<Reading> right = asked(law, {}), wrong = asked(law, change);
    INFO(law.name << ": " << worst(right)->what << ", " << worst(right)->measured << " for " << worst(right)->answer
                  << " within " << worst(right)->tolerance << "; changed " << worst(wrong)->measured);
    CHECK(verdict(right) == Verdict::holds);
    CHECK(verdict(wrong) == Verdict::broken);
  }
}

TEST_CASE("laws of rods hold of their closed answers, and of nothing a tenth off", "[unit]") {
  for (const char* name : {"cantilever_rod", "catenary", "cord_in_channel"}) {
    const Law& law = find_law(name);
    INFO(name);
    std::vector<Trajectory> runs(2, still(law.scenes(LawSize::least).at(0)));
    CHECK(verdict(law.read(runs)) == Verdict::holds);
    for (Vec3& x : runs[0].states.back().positions) x.y *= 1.1;
    CHECK(verdict(law.read(runs)) == Verdict::broken);
  }
}

// In the last step an outer corner is moved by Δ = 1 cm, and everything else is at rest. So the step leaves a force f
// at this corner only: −f = M Δ/h² + ∇U − M a, with the elastic energy U and the acceleration a by gravity. From f,
// Equation (5) of beams.cpp derives a limit of the gained energy. The limit applies to few sweeps, but not to many.
TEST_CASE("laws: energy is gained by what few sweeps leave, and by nothing else", "[unit]") {
  const Law& pinned = find_law("pinned_sheet");
  const std::vector<Scene> scenes = pinned.scenes(LawSize::least);
  const auto gained = [&](const Scene& scene, double elastic, bool is_pulled) {
    Trajectory run = still(scene);
    run.by.is_solved = false;
    for (StepMetrics& row : run.rows) row.kinetic_energy = 1;
    run.rows.back().elastic_energy = elastic;
    if (is_pulled) run.states.back().positions.back().z += 0.01;
    return pinned.read(std::span(&run, 1)).at(0);
  };
  CHECK(verdict(gained(scenes[0], 0.005, false)) == Verdict::holds);
  CHECK(verdict(gained(scenes[0], 0.02, false)) == Verdict::broken);
  const double limit = gained(scenes[0], 0.02, true).limit;
  CHECK(limit > 0.02);
  CHECK(verdict(gained(scenes[0], 0.99 * limit, true)) == Verdict::limit);
  CHECK(verdict(gained(scenes[0], 1.01 * limit, true)) == Verdict::broken);
  CHECK(gained(scenes[1], 0.02, true).limit == 0);
}

TEST_CASE("laws of a cord that hangs, of a sheet that another moves, of one that a unit changes", "[unit]") {
  const Law& thrown = find_law("cord_falls");
  Trajectory hung = still(thrown.scenes(LawSize::least).at(0));
  CHECK(verdict(thrown.read(std::span(&hung, 1))) == Verdict::broken);
  for (const char* name : {"far_apart", "lengths_by_powers"}) {
    const Law& law = find_law(name);
    INFO(name);
    std::vector<Trajectory> runs;
    for (const Scene& scene : law.scenes(LawSize::least)) runs.push_back(still(scene));
    CHECK(verdict(law.read(runs)) == Verdict::holds);
    runs[1].states[3].positions[7].x += 1e-4;
    CHECK(verdict(law.read(runs)) == Verdict::broken);
  }
}

TEST_CASE("laws: every one is tested here, and has its row in compare/laws.md", "[unit]") {
  std::ifstream file(OGC_SOURCE_DIR "/compare/laws.md");
  std::ostringstream page;
  page << file.rdbuf();
  const std::vector<std::string_view> scripted{"cord_falls",      "cantilever_rod", "catenary",
                                               "cord_in_channel", "far_apart",      "lengths_by_powers"};
  CHECK(laws().size() == changes.size() + scripted.size());
  for (const Law& law : laws()) {
    INFO(law.name);
    CHECK(page.str().find("| `" + std::string(law.name) + "` |") != std::string::npos);
    CHECK((changes.contains(law.name) || std::ranges::find(scripted, law.name) != scripted.end()));
  }
}

TEST_CASE("laws: readings are held by side, tolerance and limit", "[unit]") {
  const Reading both{.what = "a", .unit = "1", .measured = 1.2, .answer = 1, .tolerance = 0.1, .limit = 0.3};
  CHECK(verdict(both) == Verdict::limit);
  Reading other = both;
  other.measured = 0.5;
  CHECK(verdict(other) == Verdict::broken);
  other.side = Side::at_most;
  CHECK(verdict(other) == Verdict::holds);
  other.measured = std::nan("");
  CHECK(verdict(other) == Verdict::broken);
  const std::vector<Reading> all{both, other};
  CHECK(verdict(all) == Verdict::broken);
  CHECK(worst(all) == &all[1]);
  CHECK(worst({}) == nullptr);
  CHECK_THROWS_AS(find_law("free_fal"), InputError);
}

// Friction changes the velocity v to v' = v − h b f₁(v'/ε), with the deceleration b of full friction and the friction
// velocity ε. Let h b = ε, v = 7/4 ε and y' = v'/ε < 1. Then y' = 7/4 − (2 y' − y'²), so y'² − 3 y' + 7/4 = 0 and y' =
// (3 − √2)/2.
TEST_CASE("laws: the step of a body with friction solves its equation", "[unit]") {
  using law_measures::slid;
  CHECK(slid(1.75, 0, 10, 1, 0.1) == Approx((3 - std::sqrt(2.)) / 2));
  CHECK(slid(-1.75, 0, 10, 1, 0.1) == Approx(-(3 - std::sqrt(2.)) / 2));
  CHECK(slid(5, 2, 3, 0.01, 0.1) == Approx(4.9));
  CHECK(slid(0, 0, 3, 0.01, 0.1) == Approx(0).margin(1e-15));
}

TEST_CASE("laws: the step of a mass on a contact's spring", "[unit]") {
  using law_measures::bounced;
  const auto free = bounced({1, 2}, -10, 100, 0.5, 0.01);
  CHECK(free.x == Approx(1 + 0.02 - 0.001));
  CHECK(free.v == Approx(1.9));
  // With h² k_c/m = 1 the answer lies halfway between the target 0.4 and r = 0.5.
  CHECK(bounced({0.4, 0}, 0, 1e4, 0.5, 0.01).x == Approx(0.45));
}
