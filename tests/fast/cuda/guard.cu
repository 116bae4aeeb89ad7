// Tests guards on the device: the same properties as on the host, and the host's bits.
#include <algorithm>
#include <vector>

#include <cuda_runtime.h>

#include "tests/catch.hpp"

#include "fast/cuda/buffer.cuh"
#include "fast/cuda/cuda.hpp"
#include "tests/fast/guards.hpp"

using namespace ogc;
using tests::Positions;

namespace {

fast::GuardOptions options_of(compare::Bounds bounds) { return {.query_radius = 0.5F, .bounds = bounds}; }

/// Returns whether all coordinates are equal; 0 and −0 are, since a sum with 0 may change one into the other.
bool same_positions(const Positions& a, const Positions& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const compare::Vec3f& x, const compare::Vec3f& y) {
    return x.x == y.x && x.y == y.y && x.z == y.z;
  });
}

Positions downloaded(const compare::Vec3f* from, std::size_t count) {
  Positions to(count);
  REQUIRE(cudaMemcpy(to.data(), from, count * sizeof(to[0]), cudaMemcpyDeviceToHost) == cudaSuccess);
  return to;
}

}  // namespace

TEST_CASE("guard: no state and no way on the device has an intersection, whatever is proposed", "[gpu]") {
  for (const compare::Bounds bounds : {compare::Bounds::ball, compare::Bounds::planes}) {
    for (const std::uint32_t seed : {1U, 2U}) {
      for (const tests::TestMesh& mesh : {tests::random_faces(seed), tests::crumpled_layers(seed)}) {
        INFO("bounds " << static_cast<int>(bounds) << ", seed " << seed);
        fast::Guard guard(mesh.connectivity(), mesh.positions, options_of(bounds), fast::Backend::cuda);
        const tests::GuardRun run = tests::run_guard(guard, seed, 16, {.size = 1, .pull = 0.25F, .foreign = true});
        CHECK(run.intersections == 0);
        CHECK(run.meetings == 0);
        CHECK(run.cut > 0);
        CHECK(run.detections > 0);
        CHECK(run.moved > 1);
      }
    }
  }
}

TEST_CASE("guard: parallel triangles stay apart on the device", "[gpu]") {
  std::mt19937 random(4000);
  std::uniform_real_distribution<float> exponent(-12, -1);
  double moved = 0;
  for (int pair = 0; pair < 60; ++pair) {
    const float gap = std::pow(10.0F, exponent(random));
    const tests::TestMesh mesh = tests::parallel_triangles(gap, random);
    const auto bounds = pair % 2 == 0 ? compare::Bounds::ball : compare::Bounds::planes;
    INFO("pair " << pair << ", gap " << gap);
    fast::Guard guard(mesh.connectivity(), mesh.positions, options_of(bounds), fast::Backend::cuda);
    for (const float size : {1.0F, 4 * gap}) {
      const tests::GuardRun run = tests::run_guard(guard, static_cast<std::uint32_t>(pair), 6, {.size = size});
      CHECK(run.intersections == 0);
      CHECK(run.meetings == 0);
      moved += run.moved;
    }
  }
  CHECK(moved > 1);
}

// Balls are computed operation by operation, so they have the host's bits in every build; a slide has them where
// nothing is contracted.
TEST_CASE("guard: the device's steps have the host's bits and reports", "[gpu]") {
#if defined(OGC_STRICT)
  const std::vector<compare::Bounds> all_bounds{compare::Bounds::ball, compare::Bounds::planes};
#else
  const std::vector<compare::Bounds> all_bounds{compare::Bounds::ball};
#endif
  for (const compare::Bounds bounds : all_bounds) {
    const tests::TestMesh mesh = tests::random_faces(3);
    fast::Guard host(mesh.connectivity(), mesh.positions, options_of(bounds)),
        device(mesh.connectivity(), mesh.positions, options_of(bounds), fast::Backend::cuda);
    tests::run_guard(
        host, 3, 16, {.size = 0.3F, .foreign = true},
        [&](const Positions&, const Positions& wanted, const Positions& after, const fast::GuardReport& report) {
          Positions out(after.size());
          // `wanted` itself as positions, without moves, gives the same proposals.
          const fast::GuardReport own = device.step(wanted, Positions(after.size()), out);
          CHECK(same_positions(device.positions(), out));
          CHECK(same_positions(out, after));
          CHECK(own.cut == report.cut);
          CHECK(own.detected == report.detected);
          CHECK(own.most_restricted == report.most_restricted);
          // Sums have the same order on both backends, but the device may contract the squares: 3 roundings of 2⁻⁵³.
          CHECK(own.asked == Approx(report.asked).epsilon(0x1p-50));
          CHECK(own.lost == Approx(report.lost).epsilon(0x1p-50));
        });
  }
}

TEST_CASE("guard: positions and moves on the device give the same steps, also if the result replaces them", "[gpu]") {
  for (const compare::Bounds bounds : {compare::Bounds::ball, compare::Bounds::planes}) {
    const tests::TestMesh mesh = tests::crumpled_layers(4);
    const std::size_t count = mesh.positions.size();
    const Positions moves(count, {0.25F, -0.5F, 0.125F});
    fast::Guard plain(mesh.connectivity(), mesh.positions, options_of(bounds), fast::Backend::cuda),
        resident(mesh.connectivity(), mesh.positions, options_of(bounds), fast::Backend::cuda);
    fast::CudaBuffer<compare::Vec3f> x, dx;
    x.upload(mesh.positions.data(), count);
    dx.upload(moves.data(), count);
    Positions out = mesh.positions;
    for (int step = 0; step < 4; ++step) {
      const fast::GuardReport report = plain.step(out, moves, out);
      CHECK(resident.step_resident(x.data(), dx.data(), x.data()).lost == report.lost);
      CHECK(same_positions(downloaded(x.data(), count), out));
      CHECK(same_positions(downloaded(resident.positions_resident(), count), out));
    }
    x.upload(mesh.positions.data(), count);
    resident.reset_resident(x.data());
    CHECK(same_positions(resident.positions(), mesh.positions));
    const fast::ContactView view = resident.contacts();
    std::vector<float> bound(count);
    REQUIRE(cudaMemcpy(bound.data(), view.bound, count * sizeof(float), cudaMemcpyDeviceToHost) == cudaSuccess);
    CHECK(*std::max_element(bound.begin(), bound.end()) > 0);
  }
}
