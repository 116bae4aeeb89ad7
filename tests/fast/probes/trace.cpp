// Tests that a trace records the simulation's own step, and that recording changes no bit.
#include "fast/probes/probe_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "compare/judge/cases/generators.hpp"
#include "fast/cpu/backend.hpp"
#include "fast/cpu/simulation.hpp"
#include "fast/stages/way.hpp"
#include "tests/catch.hpp"
#include "tests/fast/scenes.hpp"

using namespace ogc;
using namespace ogc::fast;
using namespace ogc::fast::test;

namespace {

bool same_bits(const std::vector<compare::Vec3f>& a, const std::vector<compare::Vec3f>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(compare::Vec3f)) == 0;
}

// Returns a sheet thrown askew at a fixed sheet: several rounds, contacts, detections between iterations.
compare::Scene thrown_sheet() {
  compare::Scene scene = empty_scene();
  add_sheet(scene, 7, 0.06, 0.006, false);
  add_sheet(scene, 6, 0.08, 0, true);
  for (std::size_t v = 0; v < 49; ++v) {
    scene.mesh.positions[v].y += 0.05 * scene.mesh.positions[v].x;
    scene.velocities[v] = {0.2, -1.5, 0.1};
  }
  scene.settings.iterations = 7;
  compare::round_to_single(scene);
  return scene;
}

compare::StepOut traced(const compare::Scene& scene, int list_capacity = 0) {
  const compare::Topology topology = compare::build_topology(scene);
  return probe_step<CpuBackend>({&scene, &topology}, list_capacity);
}

std::int64_t count(const compare::StepOut& out, compare::StepEventKind kind) {
  return std::count_if(out.events.begin(), out.events.end(),
                       [&](const compare::StepEvent& event) { return event.kind == kind; });
}

}  // namespace

TEST_CASE("a traced step gives the bits of an untraced one, and as many events as its row counts", "[property]") {
  const compare::Scene scene = thrown_sheet();
  const auto untraced = start_cpu(scene, {});
  const compare::StepMetrics row = untraced->advance(1).at(0);
  const compare::Snapshot end = untraced->snapshot();
  const compare::StepOut trace = traced(scene);
  CHECK(same_bits(trace.position, end.positions));
  CHECK(same_bits(trace.velocity, end.velocities));
  CHECK(trace.query_radius == end.query_radius);
  CHECK(count(trace, compare::StepEventKind::detection) == row.discrete_detections);
  CHECK(count(trace, compare::StepEventKind::guess) == row.guess_rounds);
  CHECK(count(trace, compare::StepEventKind::sweep) == 7);
  CHECK(row.guess_rounds > 1);
  CHECK(row.discrete_detections > row.guess_rounds);
  CHECK(trace.events.back().cut == row.vertices_cut);
  CHECK(same_bits(trace.events.back().position, end.positions));
}

namespace {

/// Returns by how much a vertex moved at most along an axis between two events [m].
double largest_move(const compare::StepEvent& before, const compare::StepEvent& after) {
  double largest = 0;
  for (std::size_t v = 0; v < after.position.size(); ++v)
    for (float compare::Vec3f::*axis : {&compare::Vec3f::x, &compare::Vec3f::y, &compare::Vec3f::z})
      largest = std::max(largest, std::abs(double{after.position[v].*axis} - before.position[v].*axis));
  return largest;
}

/// Returns how many events a step has with this setting, given the events without it.
std::size_t settled_length(const std::vector<compare::StepEvent>& events, float settled_move) {
  for (std::size_t i = 1; i + 1 < events.size(); ++i) {
    const compare::StepEvent& event = events[i];
    if (event.kind != compare::StepEventKind::sweep || event.cut > 0 ||
        events[i + 1].kind == compare::StepEventKind::detection)
      continue;
    if (largest_move(events[i - 1], event) <= double{settled_move}) return i + 1;
  }
  return events.size();
}

}  // namespace

TEST_CASE(
    "with settled_move a step ends after the first iteration that moves nothing farther, cuts nothing and asks for no "
    "detection, and has the same bits up to there",
    "[property]") {
  for (const char* generator : {"settled", "settled.planes"}) {
    // steps that end early, and that do not; iterations after which a step goes on only because of a cut or a detection
    int early = 0, whole = 0, cut = 0, detects = 0;
    constexpr std::uint64_t cases = 250;
    for (std::uint64_t index = 0; index < cases; ++index) {
      INFO(generator << " " << index);
      const compare::TestCase test = compare::generate({compare::Stage::step, generator, 3, index, "", {}});
      const auto& data = compare::case_of<compare::StepCase>(test.data);
      compare::Scene scene = *data.scene;
      const double own = std::exchange(scene.settings.settled_move, 0);
      REQUIRE(own > 0);
      const std::vector<compare::StepEvent> all = traced(scene).events;
      const std::size_t some = all.size() - 1 - index % (all.size() - 1);
      const auto move = static_cast<float>(largest_move(all[some - 1], all[some]));
      for (const float settled_move : {static_cast<float>(own), move, std::nextafter(move, 0.0f)}) {
        scene.settings.settled_move = settled_move;
        const compare::StepOut out = traced(scene);
        REQUIRE(out.events.size() == (settled_move > 0 ? settled_length(all, settled_move) : all.size()));
        for (std::size_t i = 0; i < out.events.size(); ++i) {
          REQUIRE(out.events[i].kind == all[i].kind);
          REQUIRE(out.events[i].cut == all[i].cut);
          REQUIRE(same_bits(out.events[i].position, all[i].position));
        }
        CHECK(same_bits(out.position, out.events.back().position));
      }
      const std::size_t length = settled_length(all, static_cast<float>(own));
      ++(length < all.size() ? early : whole);
      for (std::size_t i = 1; i + 1 < length; ++i) {
        if (all[i].kind != compare::StepEventKind::sweep || largest_move(all[i - 1], all[i]) > own) continue;
        const bool is_followed = all[i + 1].kind == compare::StepEventKind::detection;
        cut += all[i].cut > 0 && !is_followed;
        detects += all[i].cut == 0 && is_followed;
      }
    }
    INFO(generator << ": " << early << " end early, " << whole << " do not; " << cut << " cuts, " << detects
                   << " detections");
    CHECK(early > static_cast<int>(cases) / 10);
    CHECK(whole > static_cast<int>(cases) / 10);
    CHECK(cut > 0);
    CHECK(detects > 0);
  }
}

TEST_CASE("the last detection of a trace is the one that the state's certificate names", "[property]") {
  const compare::Scene scene = thrown_sheet();
  const auto untraced = start_cpu(scene, {});
  untraced->advance(1);
  const compare::Snapshot end = untraced->snapshot();
  const compare::StepOut trace = traced(scene);
  const auto last = std::find_if(trace.events.rbegin(), trace.events.rend(),
                                 [](const auto& e) { return e.kind == compare::StepEventKind::detection; });
  CHECK(same_bits(last->position, end.previous));
  CHECK(last->bound == end.bounds);
}

TEST_CASE("a simulation tells the states at which it detected: those of its trace, and looking changes no bit",
          "[property]") {
  const compare::Scene scene = thrown_sheet();
  for (const int list_capacity : {0, 1}) {  // 1: the lists grow, and only the last attempt counts
    const auto seen = start_cpu(scene, {}, list_capacity), unseen = start_cpu(scene, {}, list_capacity);
    std::vector<std::vector<compare::Vec3f>> states;
    const std::vector<compare::StepMetrics> rows = dynamic_cast<compare::WayTeller&>(*seen).advance_telling(states);
    REQUIRE(rows.size() == 1);
    CHECK(std::ssize(states) == rows[0].discrete_detections);
    CHECK(states.size() > 2);
    std::vector<std::vector<compare::Vec3f>> traced_states;
    for (const compare::StepEvent& event : traced(scene, list_capacity).events)
      if (event.kind == compare::StepEventKind::detection) traced_states.push_back(event.position);
    CHECK(std::ranges::equal(states, traced_states, same_bits));
    unseen->advance(1);
    for (int k = 0; k < 3; ++k) seen->advance(1), unseen->advance(1);  // without an observer
    CHECK(same_bits(seen->snapshot().positions, unseen->snapshot().positions));
  }
}

TEST_CASE("of a step that was repeated because its lists grew the trace tells the last attempt", "[property]") {
  const compare::Scene scene = thrown_sheet();
  const compare::StepOut roomy = traced(scene), tight = traced(scene, 1);
  REQUIRE(tight.events.size() == roomy.events.size());
  CHECK(same_bits(tight.position, roomy.position));
  std::size_t contacts = 0;
  for (std::size_t i = 0; i < tight.events.size(); ++i) {
    const compare::StepEvent &a = tight.events[i], &b = roomy.events[i];
    CHECK(a.kind == b.kind);
    CHECK(a.cut == b.cut);
    CHECK(same_bits(a.position, b.position));
    CHECK(a.vertex_facet.contacts == b.vertex_facet.contacts);
    CHECK(a.edge_edge.contacts == b.edge_edge.contacts);
    CHECK(a.vertex_facet.d_min_triangle == b.vertex_facet.d_min_triangle);
    CHECK(a.bound == b.bound);
    contacts += a.vertex_facet.contacts.size();
  }
  CHECK(contacts > 10);
}

TEST_CASE("a scene in which nothing is free has a trace of one round and idle sweeps", "[unit]") {
  compare::Scene scene = empty_scene();
  add_sheet(scene, 3, 0.1, 0, true);
  scene.settings.iterations = 2;
  const compare::StepOut trace = traced(scene);
  CHECK(trace.events.size() == 4);
  CHECK(same_bits(trace.position, compare::to_single(scene.mesh.positions)));
  CHECK(trace.colour == std::vector<compare::Index>(9, -1));
}
