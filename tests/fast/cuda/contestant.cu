// Tests that the device gives the host's bits. Detections do so in every build, because each operation is rounded.
// Whole steps do so in the strict build, where neither compiler contracts operations.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

#include <cuda_runtime.h>

#include "compare/stages/closest_face.hpp"
#include "compare/stages/closest_points.hpp"
#include "tests/catch.hpp"

#include "compare/problem/error.hpp"
#include "compare/problem/scene.hpp"
#include "compare/record/steps_csv.hpp"
#include "experiments/scenes/registry.hpp"
#include "fast/contact_sets.hpp"
#include "fast/cpu/simulation.hpp"
#include "fast/cuda/buffer.cuh"
#include "fast/cuda/cuda.hpp"
#include "fast/resident_state.hpp"

using namespace ogc;
using compare::Vec3f;

namespace {

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// Returns a random point whose coordinates are −8 … 8 times a power of two from 2⁻⁸ to 1. Many coordinates coincide,
/// so touching, parallel and coplanar pairs are frequent.
Vec3f random_point(std::mt19937& random) {
  const float unit = std::ldexp(1.0f, -static_cast<int>(random() % 9));
  const auto coordinate = [&] { return unit * static_cast<float>(static_cast<int>(random() % 17) - 8); };
  return {coordinate(), coordinate(), coordinate()};
}

/// Holds two crumpled square sheets of n × n vertices, one inside the other.
struct Crumpled {
  std::vector<Vec3f> positions;
  std::vector<compare::Triangle> triangles;
};

Crumpled crumpled_sheets(int n) {
  Crumpled sheets;
  std::mt19937 random(11);
  for (int sheet = 0; sheet < 2; ++sheet) {
    const int first = static_cast<int>(sheets.positions.size());
    for (int i = 0; i < n * n; ++i) {
      const auto noise = [&] { return std::ldexp(static_cast<float>(random() % 1024), -16); };
      sheets.positions.push_back({0.01f * static_cast<float>(i % n) + noise(),
                                  0.003f * static_cast<float>(sheet) + noise(),
                                  0.01f * static_cast<float>(i / n) + noise()});
      if (i % n == n - 1 || i / n == n - 1) continue;
      sheets.triangles.push_back({first + i, first + i + 1, first + i + n});
      sheets.triangles.push_back({first + i + 1, first + i + n + 1, first + i + n});
    }
  }
  return sheets;
}

// Compares by member, because nvcc's pass over the host code loses the judge's defaulted comparisons.
bool same_face(const compare::Face& a, const compare::Face& b) { return a.kind == b.kind && a.index == b.index; }
bool same_contact(const compare::VertexFacetContact& a, const compare::VertexFacetContact& b) {
  return a.vertex == b.vertex && same_face(a.face, b.face) && a.owner == b.owner;
}
bool same_contact(const compare::EdgeEdgeContact& a, const compare::EdgeEdgeContact& b) {
  return same_face(a.first, b.first) && same_face(a.second, b.second) && a.first_edge == b.first_edge &&
         a.second_edge == b.second_edge;
}
template <class Contact>
bool same_contacts(const std::vector<Contact>& a, const std::vector<Contact>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Contact& x, const Contact& y) { return same_contact(x, y); });
}

bool same_sets(const fast::ContactSets& a, const fast::ContactSets& b) {
  return same_contacts(a.vertex_facet, b.vertex_facet) && same_contacts(a.edge_edge, b.edge_edge) &&
         same_bits(a.d_min_vertex, b.d_min_vertex) && same_bits(a.d_min_edge, b.d_min_edge) &&
         same_bits(a.d_min_triangle, b.d_min_triangle) && same_bits(a.bound, b.bound);
}

compare::Snapshot after(compare::Simulation& simulation, int steps) {
  simulation.advance(steps);
  return simulation.snapshot();
}

bool same_state(const compare::Snapshot& a, const compare::Snapshot& b) {
  return a.step == b.step && same_bits(a.positions, b.positions) && same_bits(a.velocities, b.velocities) &&
         same_bits(a.bounds, b.bounds);
}

}  // namespace

TEST_CASE("closest faces and closest points have the host's bits", "[gpu]") {
  std::mt19937 random(5);
  compare::ClosestFaceIn faces;
  compare::ClosestPointsIn points;
  for (int i = 0; i < 100'000; ++i) {
    faces.point.push_back(random_point(random));
    faces.triangle.push_back({random_point(random), random_point(random), random_point(random)});
    points.first.push_back({random_point(random), random_point(random)});
    points.second.push_back({random_point(random), random_point(random)});
  }
  const compare::Contestant host = fast::contestant(fast::Backend::cpu), device = fast::cuda_contestant();
  const compare::ClosestFaceOut a = host.closest_face(faces), b = device.closest_face(faces);
  CHECK((a.feature == b.feature));
  CHECK(same_bits(a.weights, b.weights));
  CHECK(same_bits(a.distance, b.distance));
  CHECK(same_bits(a.distance_below, b.distance_below));
  const compare::ClosestPointsOut c = host.closest_points(points), d = device.closest_points(points);
  CHECK((c.first_feature == d.first_feature));
  CHECK((c.second_feature == d.second_feature));
  CHECK((c.nearly_parallel == d.nearly_parallel));
  CHECK(same_bits(c.parameters, d.parameters));
  CHECK(same_bits(c.contact_distance, d.contact_distance));
  CHECK(same_bits(c.distance_below, d.distance_below));
}

TEST_CASE("contact sets, smallest distances and bounds have the host's bits", "[gpu]") {
  const Crumpled sheets = crumpled_sheets(60);
  const auto vertices = static_cast<compare::Index>(sheets.positions.size());
  const fast::Mesh mesh(vertices, sheets.triangles);
  fast::ContactFinder host(mesh), device(mesh, fast::Backend::cuda);
  for (const float radius : {0.001f, 0.004f, 0.02f}) {
    const fast::ContactQuery query{.contact_radius = radius, .query_radius = 1.5f * radius};
    const fast::ContactSets a = host.find(sheets.positions, query), b = device.find(sheets.positions, query);
    CHECK(same_sets(a, b));
    CHECK(same_sets(b, device.find(sheets.positions, query)));
  }
}

TEST_CASE("positions that are on the device already give the same sets", "[gpu]") {
  const Crumpled sheets = crumpled_sheets(30);
  const auto vertices = static_cast<compare::Index>(sheets.positions.size());
  fast::ContactFinder finder(fast::Mesh(vertices, sheets.triangles), fast::Backend::cuda);
  const fast::ContactQuery query{.contact_radius = 0.004f, .query_radius = 0.006f};
  const fast::ContactSets sets = finder.find(sheets.positions, query);
  fast::CudaBuffer<Vec3f> positions;
  positions.upload(sheets.positions.data(), sheets.positions.size());
  const fast::ContactView view = finder.find_resident(positions.data(), query);
  int vertex_facet = 0, edge_edge = 0;
  std::vector<float> bound(sheets.positions.size());
  REQUIRE(cudaMemcpy(&vertex_facet, view.vertex_facet_count, sizeof(int), cudaMemcpyDeviceToHost) == cudaSuccess);
  REQUIRE(cudaMemcpy(&edge_edge, view.edge_edge_count, sizeof(int), cudaMemcpyDeviceToHost) == cudaSuccess);
  REQUIRE(cudaMemcpy(bound.data(), view.bound, bound.size() * sizeof(float), cudaMemcpyDeviceToHost) == cudaSuccess);
  CHECK(static_cast<std::size_t>(vertex_facet) == sets.vertex_facet.size());
  CHECK(static_cast<std::size_t>(edge_edge) == sets.edge_edge.size());
  CHECK(same_bits(bound, sets.bound));
}

TEST_CASE("columns stay on the device, beyond later calls and the finder, and have the host's bits", "[gpu]") {
  const Crumpled sheets = crumpled_sheets(30);
  const fast::Mesh mesh(static_cast<compare::Index>(sheets.positions.size()), sheets.triangles);
  const fast::ContactQuery query{.contact_radius = 0.004f, .query_radius = 0.006f};
  const fast::ContactColumns host = fast::ContactFinder(mesh).find_columns(sheets.positions, query);
  CHECK(host.vertex_facet.size() > 20);
  fast::CudaBuffer<Vec3f> positions;
  positions.upload(sheets.positions.data(), sheets.positions.size());
  auto finder = std::make_unique<fast::ContactFinder>(mesh, fast::Backend::cuda);
  const fast::ContactColumns there = finder->find_columns_resident(positions.data(), query),
                             other = finder->find_columns(sheets.positions, {.contact_radius = 1, .query_radius = 1});
  finder.reset();
  CHECK(there.device == 0);
  CHECK(other.bound.data() != there.bound.data());
  const fast::ContactColumns back = there.copied_to_host();
  CHECK(back.device == fast::ContactColumns::on_host);
  CHECK(back.smallest_distance == host.smallest_distance);
  CHECK(std::ranges::equal(back.vertex_facet, host.vertex_facet));
  CHECK(std::ranges::equal(back.vertex_facet_kind, host.vertex_facet_kind));
  CHECK(std::ranges::equal(back.edge_edge, host.edge_edge));
  CHECK(std::ranges::equal(back.edge_edge_kind, host.edge_edge_kind));
  for (const auto column : {&fast::ContactColumns::d_min_vertex, &fast::ContactColumns::d_min_edge,
                            &fast::ContactColumns::d_min_triangle, &fast::ContactColumns::bound})
    CHECK(std::ranges::equal(back.*column, host.*column));
  finder = std::make_unique<fast::ContactFinder>(mesh, fast::Backend::cuda);
  CHECK_THROWS_AS(finder->find_resident(sheets.positions.data(), query), compare::InputError);
}

TEST_CASE("a simulation repeats to the bit, whatever the frames and however small its lists began", "[gpu]") {
  const compare::Scene scene = experiments::make_scene("cloth_on_sphere", experiments::Scale::smoke);
  constexpr int steps = 40;
  const compare::Snapshot expected = after(*fast::start_cuda(scene, {}), steps);
  CHECK(expected.step == steps);
  CHECK(same_state(after(*fast::start_cuda(scene, {}), steps), expected));
  CHECK(same_state(after(*fast::start_cuda(scene, {}, 1), steps), expected));
  CHECK(same_state(after(*fast::start_cuda(scene, {.profile = true}), steps), expected));
  const auto one_by_one = fast::start_cuda(scene, {});
  for (int k = 0; k < steps; ++k) one_by_one->advance(1);
  CHECK(same_state(one_by_one->snapshot(), expected));
}

TEST_CASE("a simulation on the device that is replaced by a new one after each step comes to the same bits and rows",
          "[gpu]") {
  for (const compare::Bounds bounds : {compare::Bounds::ball, compare::Bounds::planes}) {
    INFO("bounds " << static_cast<int>(bounds));
    compare::Scene scene = experiments::make_scene("cloth_on_sphere", experiments::Scale::smoke);
    scene.settings.bounds = bounds;
    constexpr int steps = 40;
    const auto whole = fast::start_cuda(scene, {}, 1);
    std::vector<compare::StepMetrics> expected = whole->advance(steps), rows;
    compare::Snapshot state = fast::start_cuda(scene, {}, 1)->snapshot();
    for (int k = 0; k < steps; ++k) {
      const auto next = fast::start_cuda(scene, {});
      next->restore(state);
      rows.push_back(next->advance(1).at(0));
      state = next->snapshot();
    }
    CHECK(same_state(state, whole->snapshot()));
    CHECK(state.capacities == whole->snapshot().capacities);
    CHECK(state.search_limits == whole->snapshot().search_limits);
    for (auto* each : {&rows, &expected})
      for (compare::StepMetrics& row : *each) row.wall_ms = 0;
    CHECK(compare::step_lines(rows, 0) == compare::step_lines(expected, 0));
  }
}

TEST_CASE("the resident state is the snapshot's, and other streams read it before it is overwritten", "[gpu]") {
  const auto simulation = fast::start_cuda(experiments::make_scene("cloth_on_sphere", experiments::Scale::smoke), {});
  fast::ResidentState& state = fast::resident_state(*simulation);
  const compare::Snapshot start = simulation->snapshot();
  const std::size_t count = start.positions.size(), bytes = count * sizeof(Vec3f), large = 1 << 28;
  CHECK(state.device_number() == 0);
  fast::CudaBuffer<Vec3f> copies[2];
  for (auto& copy : copies) copy.resize(count);
  fast::CudaBuffer<std::byte> from, to;
  from.resize(large), to.resize(large);
  cudaStream_t stream = nullptr;
  REQUIRE(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking) == cudaSuccess);
  for (int round = 0; round < 2; ++round) {
    const compare::Snapshot before = simulation->snapshot();
    // Some 30 ms of copies, before those of the state.
    for (int k = 0; k < 200; ++k) cudaMemcpyAsync(to.data(), from.data(), large, cudaMemcpyDeviceToDevice, stream);
    cudaMemcpyAsync(copies[0].data(), state.positions_resident(), bytes, cudaMemcpyDeviceToDevice, stream);
    cudaMemcpyAsync(copies[1].data(), state.velocities_resident(), bytes, cudaMemcpyDeviceToDevice, stream);
    CHECK(cudaStreamQuery(stream) == cudaErrorNotReady);
    state.wait_for_device();
    CHECK(cudaStreamQuery(stream) == cudaSuccess);
    simulation->advance(5);
    std::vector<Vec3f> found(count);
    copies[0].download(found.data(), count);
    CHECK(same_bits(found, before.positions));
    copies[1].download(found.data(), count);
    CHECK(same_bits(found, before.velocities));
    CHECK(!same_bits(state.positions(), before.positions));
    CHECK(same_bits(state.velocities(), simulation->snapshot().velocities));
  }
  simulation->restore(start);
  CHECK(same_bits(state.positions(), start.positions));
  REQUIRE(cudaStreamDestroy(stream) == cudaSuccess);
}

TEST_CASE("a lists' growth is reported and every step is timed", "[gpu]") {
  const compare::Scene scene = experiments::make_scene("cloth_on_sphere", experiments::Scale::smoke);
  const std::vector<compare::StepMetrics> rows = fast::start_cuda(scene, {}, 1)->advance(30);
  REQUIRE(rows.size() == 30);
  std::int64_t repeats = 0;
  for (const compare::StepMetrics& row : rows) {
    CHECK(row.wall_ms > 0);
    CHECK((row.status & (compare::step_not_finite | compare::step_bound_violated)) == 0);
    repeats += row.repeats;
  }
  CHECK(repeats > 0);
}

#if defined(OGC_STRICT)
TEST_CASE("in the strict build a step has the host's bits", "[gpu]") {
  for (const char* name : {"cloth_on_sphere", "twist"})
    for (const double settled_move : {0.0, 1e-4}) {
      compare::Scene scene = experiments::make_scene(name, experiments::Scale::smoke);
      scene.settings.settled_move = settled_move;
      const auto host = fast::start_cpu(scene, {}), device = fast::start_cuda(scene, {});
      for (int step = 1; step <= 25; ++step) {
        INFO(name << ", settled_move " << settled_move << ", step " << step);
        const compare::StepMetrics expected = host->advance(1).at(0), row = device->advance(1).at(0);
        CHECK(row.iterations == expected.iterations);
        CHECK(row.last_motion == Approx(expected.last_motion));
        CHECK(same_state(device->snapshot(), host->snapshot()));
      }
    }
}
#endif
