#include "fast/stages/skin.hpp"

#include <random>

#include "compare/problem/error.hpp"
#include "fast/cpu/backend.hpp"
#include "fast/probes/contact_engine.hpp"
#include "fast/stages/simulation.hpp"
#include "tests/catch.hpp"
#include "tests/fast/meshes.hpp"

namespace {

using namespace ogc;
using namespace ogc::fast;
using tests::TestMesh;

constexpr float radius = 0.3F;
constexpr float margin = usual_skin / 8 * radius;  // where nothing has moved since the search before
constexpr float farthest = 7 * margin / 32;

using Positions = std::vector<compare::Vec3f>;

/// Layers closer to each other than r, edges longer and shorter than r, a triangle as large as all of it, and a vertex
/// far from everything.
TestMesh surfaces() {
  TestMesh mesh;
  for (std::uint32_t k = 0; k < 3; ++k)
    mesh.add(tests::jittered(tests::sheet(9, 1.0F, 0.25F * static_cast<float>(k)), 0.1F, k));
  mesh.add(tests::jittered(tests::sheet(7, 0.15F, 1.5F), 0.03F, 7));
  mesh.add({{{-9, -0.2F, -9}, {18, -0.2F, -9}, {4, -0.2F, 18}}, {{0, 1, 2}}, {}});
  mesh.add({{{4, 9, 4}, {5, 9, 4}, {4, 9, 5}}, {{0, 1, 2}}, {}});
  return mesh;
}

/// Each vertex moved by a vector of this length in a random direction.
Positions moved(Positions positions, float length, std::mt19937& random) {
  std::normal_distribution<float> normal;
  for (auto& x : positions) {
    const Vec d{normal(random), normal(random), normal(random)};
    const float scale = length / std::max(1e-3F, std::sqrt(dot(d, d)));
    x = {x.x + scale * d.x, x.y + scale * d.y, x.z + scale * d.z};
  }
  return positions;
}

/// Curves without triangles, each wound about its own axis, closer to each other than r.
TestMesh curves() {
  TestMesh mesh;
  for (int c = 0; c < 6; ++c) {
    TestMesh curve;
    for (int k = 0; k < 80; ++k) {
      const float t = 0.15F * static_cast<float>(k);
      curve.positions.push_back({0.4F * std::cos(t) + 0.35F * static_cast<float>(c % 3), 0.1F * t,
                                 0.4F * std::sin(t) + 0.3F * static_cast<float>(c / 3)});
      if (k > 0) curve.loose_edges.push_back({k - 1, k});
    }
    mesh.add(curve);
  }
  return mesh;
}

/// Two rods that cross and are pressed together, each held at one end.
compare::Scene crossing_rods(double skin) {
  compare::Scene scene;
  scene.name = "rods";
  for (const bool along_x : {true, false}) {
    compare::Mesh mesh;
    for (compare::Index k = 0; k < 60; ++k) {
      const double s = 1e-3 * (k - 30);
      mesh.positions.push_back({along_x ? s : 0.2e-3, along_x ? 2.8e-3 : 0, along_x ? 0.1e-3 : s});
      if (k > 0) mesh.loose_edges.push_back({k - 1, k});
    }
    compare::Body body;
    body.name = along_x ? "upper" : "lower";
    body.material.rod = compare::RodMaterial{
        .density = 1e-3, .stretch = 0.1, .bend = 2e-7, .damping = 0, .diameter = 1e-3};
    append_body(scene, body, mesh);
  }
  scene.motions = {{.name = "held", .vertices = {60, 61, 118, 119}, .keyframes = {}}};
  scene.settings.time_step = 4e-4;
  scene.settings.iterations = 4;
  scene.settings.contact_radius = 3e-3;
  set_setting(scene.settings, "skin", skin);
  compare::round_to_single(scene);
  return scene;
}

ContactSets afresh(const compare::Topology& topology, const Positions& positions, float r_q, float r = radius) {
  CpuBackend backend;
  return BackendContactEngine<CpuBackend>(backend, topology, {})
      .find(positions, {.contact_radius = r, .query_radius = r_q});
}

}  // namespace

TEST_CASE(
    "skin: pairs kept by a search give the bits of a search, wherever vertices are within their drift and whatever r_q "
    "is",
    "[property]") {
  const TestMesh mesh = surfaces();
  const compare::Topology topology = mesh.topology();
  std::mt19937 random(1);
  for (const float r_q : {radius, 0.5F, 2.0F}) {
    CpuBackend backend;
    BackendContactEngine<CpuBackend> engine(backend, topology, {});
    const auto find = [&](const Positions& positions, float query) {
      return engine.find(positions, {.contact_radius = radius, .query_radius = query});
    };
    // a search, and searches that keep pairs, until these have room
    for (int k = 0; k < 4; ++k) find(mesh.positions, r_q);
    const SkinState before = engine.detection().skin_state();
    REQUIRE(before.listings >= 1);
    CHECK(before.count < 20000);  // of 280,000 edge pairs and 140,000 of vertices and facets
    int rechecks = 0;
    for (const float share : {0.0F, 0.1F, 0.5F, 0.999F}) {
      for (int k = 0; k < 12; ++k) {
        const Positions positions = moved(mesh.positions, share * farthest, random);
        const float query = r_q + (static_cast<float>(k % 4) - 2) / 4 * margin;
        if (query < radius) continue;
        ++rechecks;
        CHECK(find(positions, query) == afresh(topology, positions, query));
      }
    }
    CHECK(engine.detection().skin_state().rechecks - before.rechecks == rechecks);
    CHECK(engine.detection().skin_state().searches == before.searches);
  }
}

TEST_CASE(
    "skin: detections along a walk are those of a search, through all changes between searching, keeping and looking "
    "again",
    "[property]") {
  const TestMesh mesh = surfaces();
  const compare::Topology topology = mesh.topology();
  std::mt19937 random(2);
  CpuBackend backend;
  BackendContactEngine<CpuBackend> engine(backend, topology, {});
  Positions positions = mesh.positions;
  for (int k = 0; k < 80; ++k) {
    positions = moved(positions, (k % 10 == 0 ? 0.5F : 0.02F) * radius, random);
    CHECK(engine.find(positions, {.contact_radius = radius, .query_radius = 0.8F}) ==
          afresh(topology, positions, 0.8F));
  }
  const SkinState state = engine.detection().skin_state();
  CHECK(state.searches >= 5);
  CHECK(state.listings >= 5);
  CHECK(state.rechecks >= 30);
}

TEST_CASE(
    "skin: nothing is looked at again beyond the drift, for a larger r_q, or where coordinates are too large for the "
    "margin",
    "[unit]") {
  const TestMesh mesh = surfaces();
  const compare::Topology topology = mesh.topology();
  const auto looks_again_after = [&](const compare::Vec3f& shift, float r_q) {
    CpuBackend backend;
    BackendContactEngine<CpuBackend> engine(backend, topology, {});
    Positions positions = mesh.positions;
    if (shift.y != 0)
      for (auto& x : positions) x.y += shift.y;
    // until the list has room
    for (int k = 0; k < 4; ++k) engine.find(positions, {.contact_radius = radius, .query_radius = 0.8F});
    positions[5].x += shift.x;
    engine.find(positions, {.contact_radius = radius, .query_radius = r_q});
    return engine.detection().skin_state().mode == SkinMode::recheck;
  };
  CHECK(looks_again_after({0, 0, 0}, 0.8F));
  CHECK(looks_again_after({0.99F * farthest, 0, 0}, 0.8F));
  CHECK_FALSE(looks_again_after({1.01F * farthest, 0, 0}, 0.8F));
  CHECK(looks_again_after({0, 0, 0}, 0.8F + 0.49F * margin));
  CHECK_FALSE(looks_again_after({0, 0, 0}, 0.8F + 0.51F * margin));
  constexpr float largest = 4096 * usual_skin * radius;
  CHECK(looks_again_after({0, 0.97F * largest, 0}, 0.8F));
  CHECK_FALSE(looks_again_after({0, 1.03F * largest, 0}, 0.8F));
}

TEST_CASE("skin: of curves without triangles detections along a walk are those of a search, too", "[property]") {
  const TestMesh mesh = curves();
  const compare::Topology topology = mesh.topology();
  std::mt19937 random(3);
  CpuBackend backend;
  BackendContactEngine<CpuBackend> engine(backend, topology, {});
  Positions positions = mesh.positions;
  for (int k = 0; k < 60; ++k) {
    positions = moved(positions, (k % 15 == 0 ? 0.5F : 0.03F) * radius, random);
    const ContactSets found = engine.find(positions, {.contact_radius = radius, .query_radius = 1.5F * radius});
    CHECK(found == afresh(topology, positions, 1.5F * radius));
    CHECK(found.edge_edge.size() > 100);
  }
  CHECK(engine.detection().skin_state().rechecks >= 15);
}

TEST_CASE("skin: simulations of rods alone look again where they are told to, with the same bits", "[property]") {
  const auto run = [](double skin, SkinState& state) {
    ResidentSimulation<CpuBackend> simulation(CpuBackend{}, crossing_rods(skin), {}, "");
    std::vector<compare::StepMetrics> rows;
    for (int frame = 0; frame < 30; ++frame)
      for (compare::StepMetrics& row : simulation.advance(5)) rows.push_back(std::move(row));
    state = simulation.detection().skin_state();
    return std::tuple(simulation.snapshot().positions, simulation.snapshot().orientations,
                      rows.back().edge_edge_contacts, rows.back().smallest_distance);
  };
  SkinState never, usual, narrow;
  const auto expected = run(0, never);
  CHECK(std::get<2>(expected) > 0);
  CHECK(never.rechecks + never.listings == 0);
  CHECK(run(1, usual) == expected);
  CHECK(usual.rechecks > 10);
  CHECK(run(0.25, narrow) == expected);
}

TEST_CASE("skin: a simulation has none by itself, and what searches at each detection is refused one", "[unit]") {
  compare::Scene scene = crossing_rods(0);
  CHECK(skin_share(scene) == 0);
  scene.settings.bounds = compare::Bounds::planes;
  CHECK(skin_share(scene) == 0);
  set_setting(scene.settings, "skin", 0.5);
  CHECK_THROWS_AS(skin_share(scene), compare::InputError);
  scene.settings.bounds = compare::Bounds::ball;
  CHECK(skin_share(scene) == 0.5F);
  scene.settings.guess = compare::Guess::pairs;
  CHECK_THROWS_AS(skin_share(scene), compare::InputError);
}

TEST_CASE("skin: pairs kept for one radius are of no use for another", "[unit]") {
  const TestMesh mesh = surfaces();
  const compare::Topology topology = mesh.topology();
  for (const float r : {0.5F * radius, 1.5F * radius, 3 * radius}) {
    CpuBackend backend;
    BackendContactEngine<CpuBackend> engine(backend, topology, {});
    for (int k = 0; k < 4; ++k) engine.find(mesh.positions, {.contact_radius = radius, .query_radius = 1});
    REQUIRE(engine.detection().skin_state().mode == SkinMode::recheck);
    CHECK(engine.find(mesh.positions, {.contact_radius = r, .query_radius = 1}) ==
          afresh(topology, mesh.positions, 1, r));
  }
}

TEST_CASE("skin: a list without room for its pairs is not used, and is given room", "[unit]") {
  const TestMesh mesh = surfaces();
  const compare::Topology topology = mesh.topology();
  const auto* x = reinterpret_cast<const Vec*>(mesh.positions.data());
  CpuBackend backend;
  Detection<CpuBackend> detection(backend, topology, {}, 100000, 40.0F);
  const float r_q = 0.8F;
  for (int k = 0; k < 3; ++k) detection.detect(x, radius, &r_q, 0.45F);
  CHECK(detection.skin_state().rechecks == 0);
  CHECK(detection.make_room());
  CHECK_FALSE(detection.make_room());
  for (int k = 0; k < 3; ++k) detection.detect(x, radius, &r_q, 0.45F);
  CHECK(detection.skin_state().rechecks == 1);
}

TEST_CASE(
    "skin: nothing is kept where vertices moved too far for any margin, and ever less often where lists came to "
    "nothing",
    "[unit]") {
  const TestMesh mesh = surfaces();
  const compare::Topology topology = mesh.topology();
  const auto state_after = [&](int detections, float move) {
    CpuBackend backend;
    Detection<CpuBackend> detection(backend, topology, {}, 100000, usual_skin);
    const float r_q = 0.8F;
    Positions positions = mesh.positions;
    for (int k = 0; k < detections; ++k) {
      detection.detect(reinterpret_cast<const Vec*>(positions.data()), radius, &r_q, 0.45F);
      positions[3].z += k % 2 == 0 ? move : 2 * radius;  // a move that promises rest, then one that no list survives
    }
    return detection.skin_state();
  };
  constexpr float most = usual_skin * radius / 3 * 7 / 32;
  CHECK(state_after(2, 0).listings == 1);
  CHECK(state_after(2, 0.99F * most).listings == 1);
  CHECK(state_after(2, 1.01F * most).listings == 0);
  const SkinState often = state_after(200, 0);
  CHECK(often.rechecks == 0);
  CHECK(often.listings >= 4);
  CHECK(often.listings <= 8);  // with waits of 1, 3, 7, 15, 31 and then 63 searches
}

TEST_CASE("skin: it begins with 128 KiB of pairs, and is given room for half as many again as found none", "[unit]") {
  const TestMesh mesh = surfaces();
  const compare::Topology topology = mesh.topology();
  const Surface<CpuBackend> surface(topology, {});
  Skin<CpuBackend> skin(surface.view(), usual_skin);
  const int first = skin.view(radius).capacity;
  CHECK(static_cast<std::size_t>(first) * sizeof(NotedPair) == 128 << 10);
  skin.view(radius).state->count = first;
  CHECK_FALSE(skin.make_room());
  for (const int most : {first + 1, 100001}) {
    SkinState* state = skin.view(radius).state;
    state->most = most, state->count = most / 2;
    CHECK(skin.make_room());
    CHECK(skin.view(radius).capacity == most + most / 2);
    CHECK(skin.state().most == 0);
  }
}

TEST_CASE("skin: a detection that is not asked for one searches each time", "[unit]") {
  const TestMesh mesh = surfaces();
  const compare::Topology topology = mesh.topology();
  CpuBackend backend;
  Detection<CpuBackend> detection(backend, topology, {});
  const float r_q = 0.8F;
  for (int k = 0; k < 5; ++k) {
    do detection.detect(reinterpret_cast<const Vec*>(mesh.positions.data()), radius, &r_q, 0.45F);
    while (detection.grow());
  }
  CHECK(detection.skin_state().listings == 0);
  CHECK(detection.skin_state().rechecks == 0);
}
