// Tests the rejection of pairs in single precision. A rejected pair must not be a contact in the exact decision, at any
// scale and near each limit. For rods nearly all pairs must be rejected.
#include "fast/kernels/block.hpp"

#include <cmath>
#include <random>
#include <vector>

#include "fast/cpu/backend.hpp"
#include "fast/kernels/detect_edge_edge.hpp"
#include "fast/stages/surface.hpp"
#include "tests/catch.hpp"
#include "tests/fast/meshes.hpp"

namespace {

using namespace ogc;
using namespace ogc::fast;

struct Counts {
  int pairs = 0, rejected = 0, contacts = 0, wrong = 0;
};

/// Counts the pairs of edges without a common vertex: all pairs, rejected pairs, contacts, and contacts that were
/// rejected. Contacts are decided as if each pair were nearer than r.
Counts count(const tests::TestMesh& mesh) {
  const compare::Topology topology = mesh.topology();
  Surface<CpuBackend> surface(topology, {});
  const SurfaceView view = surface.view();
  std::vector<PaddedVec> padded;
  for (const compare::Vec3f& x : mesh.positions) padded.emplace_back(Vec{x.x, x.y, x.z});
  const PaddedVecs positions{padded.data()};
  const CollectEdgeEdge decide{view, positions, 1};
  Counts counts;
  for (int e = 0; e < view.edge_count; ++e) {
    for (int f = e + 1; f < view.edge_count; ++f) {
      const EdgeEnds p = view.edges[e], q = view.edges[f];
      if (p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b) continue;
      const bool rejected = is_surely_no_contact(p, q, view, positions), contact = decide(e, f, true).bucket >= 0;
      ++counts.pairs;
      counts.rejected += rejected ? 1 : 0;
      counts.contacts += contact ? 1 : 0;
      counts.wrong += rejected && contact ? 1 : 0;
    }
  }
  return counts;
}

/// Returns ±2⁻ᵏ or 0.
float rung(std::mt19937& random) {
  if (random() % 4 == 0) return 0;
  const float size = std::ldexp(1.0F, -static_cast<int>(random() % 26));
  return random() % 2 == 0 ? size : -size;
}

/// Returns rods of unit steps on a lattice, with or without a sheet. Each step is changed by ±2⁻ᵏ or 0, so that the
/// rods have nearly or exactly right angles, reversals, parallel and straight parts, and ends above ends.
tests::TestMesh rods(std::mt19937& random) {
  tests::TestMesh mesh;
  const auto between = [&](int low, int high) {
    return static_cast<float>(low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1)));
  };
  for (auto k = 1 + random() % 3; k > 0; --k) {
    compare::Vec3f at{between(-2, 2), between(-2, 2), between(-2, 2)};
    for (std::size_t i = 0, steps = 2 + random() % 5; i <= steps; ++i) {
      const auto v = static_cast<compare::Index>(mesh.positions.size());
      if (i > 0) mesh.loose_edges.push_back({v - 1, v});
      mesh.positions.push_back(at);
      at = {at.x + between(-1, 1) + rung(random), at.y + between(-1, 1) + rung(random),
            at.z + between(-1, 1) + rung(random)};
    }
  }
  if (random() % 3 == 0) mesh.add(tests::jittered(tests::sheet(3, 1.0F, between(-1, 1)), std::abs(rung(random)), 7));
  const float scale = std::ldexp(1.0F, static_cast<int>(random() % 61) - 30), shift = random() % 3 == 0 ? 100.0F : 0.0F;
  for (compare::Vec3f& x : mesh.positions) x = {(x.x + shift) * scale, (x.y - shift) * scale, x.z * scale};
  return mesh;
}

}  // namespace

TEST_CASE("no contact: nothing is rejected that the exact decision keeps, next to each limit and in any scale",
          "[property]") {
  std::mt19937 random(11);
  Counts all;
  for (int k = 0; k < 4'000; ++k) {
    const Counts one = count(rods(random));
    all.pairs += one.pairs, all.rejected += one.rejected, all.contacts += one.contacts, all.wrong += one.wrong;
  }
  CHECK(all.wrong == 0);
  CHECK(all.rejected > all.pairs / 4);
  CHECK(all.contacts > all.pairs / 100);
}

TEST_CASE("no contact: of a bent rod nearly all pairs that are none are rejected, straight or not", "[property]") {
  for (const float bend : {0.0F, 0.001F, 0.1F, 0.5F}) {
    tests::TestMesh mesh;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> angle(-bend, bend);
    float x = 0, y = 0, heading = 0.3F;
    for (compare::Index v = 0; v < 60; ++v, heading += angle(random)) {
      if (v > 0) mesh.loose_edges.push_back({v - 1, v});
      mesh.positions.push_back({x, y, 0.01F * angle(random)});
      x += std::cos(heading), y += std::sin(heading);
    }
    const Counts counts = count(mesh);
    CHECK(counts.wrong == 0);
    CHECK(counts.rejected + counts.contacts >= counts.pairs - counts.pairs / 100);
  }
}

TEST_CASE("no contact: a collapsed edge, a point on the other edge and numbers that are none are left to decide",
          "[unit]") {
  tests::TestMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 0, 0}, {0.5F, 0, 0}, {0.5F, 1, 0}, {3, 0, 0}, {4, 0, 0}};
  mesh.loose_edges = {{0, 1}, {1, 2}, {2, 3}, {4, 5}, {2, 6}, {6, 7}};
  const compare::Topology topology = mesh.topology();
  Surface<CpuBackend> surface(topology, {});
  std::vector<PaddedVec> padded;
  for (const compare::Vec3f& x : mesh.positions) padded.emplace_back(Vec{x.x, x.y, x.z});
  const auto rejects = [&](EdgeEnds p, EdgeEnds q) {
    return is_surely_no_contact(p, q, surface.view(), {padded.data()});
  };
  CHECK(rejects({0, 1}, {2, 6}));
  CHECK(rejects({2, 6}, {0, 1}));
  CHECK_FALSE(rejects({0, 1}, {2, 3}));
  CHECK_FALSE(rejects({0, 1}, {4, 5}));
  padded[6].y = std::nanf("");
  CHECK_FALSE(rejects({0, 1}, {2, 6}));
}
