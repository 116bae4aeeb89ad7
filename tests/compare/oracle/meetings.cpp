#include "compare/oracle/meetings.hpp"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <random>

#include "compare/oracle/audit.hpp"
#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/oracle/rings.hpp"
#include "tests/reference/ipc/exact_meeting.hpp"

using namespace ogc::compare;
using ogc::tests::add_ring;
using ogc::tests::exactly_meet;
using ogc::tests::linking_number;
using ogc::tests::Points4;
using ogc::tests::sense;

namespace {

constexpr MeetingKind vertex = MeetingKind::vertex_triangle, edges = MeetingKind::edge_edge;

/// Rounds a coordinate to a multiple of 2⁻²⁰, so that the integers of the brute force represent it exactly.
double coarse(double x) { return std::ldexp(std::nearbyint(std::ldexp(x, 20)), -20); }

/// Random triangles and loose edges in the unit cube; every vertex moves by up to `reach`.
struct Heap {
  std::vector<Vec3> from, to;
  Topology topology;
  Heap(unsigned seed, double reach) {
    std::mt19937 engine(seed);
    const auto draw = [&](double low, double high) {
      return coarse(std::uniform_real_distribution<double>(low, high)(engine));
    };
    std::vector<Triangle> triangles;
    std::vector<Edge> loose;
    for (Index v = 0; v < 36; ++v) {
      const Vec3 x{draw(0, 1), draw(0, 1), draw(0, 1)};
      from.push_back(x);
      to.push_back({x.x + draw(-reach, reach), x.y + draw(-reach, reach), x.z + draw(-reach, reach)});
    }
    for (Index v = 0; v + 3 < 20; v += 2) triangles.push_back({v, v + 1, v + 3});
    for (Index v = 20; v + 1 < 36; v += v % 5 == 4 ? 2 : 1) loose.push_back({v, v + 1});
    topology = build_topology(36, triangles, loose);
  }
  bool exactly(MeetingKind kind, const std::array<Index, 4>& vertices) const {
    Points4 x, delta;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 &a = from[at(vertices[k])], &b = to[at(vertices[k])];
      x[k] = {a.x, a.y, a.z};
      delta[k] = {b.x - a.x, b.y - a.y, b.z - a.z};
    }
    return exactly_meet(kind == edges, x, delta);
  }
  std::vector<std::array<Index, 3>> brute_force() const {
    std::vector<std::array<Index, 3>> found;
    for (Index v = 0; v < topology.vertex_count; ++v)
      for (Index t = 0; t < static_cast<Index>(topology.triangles.size()); ++t) {
        const Triangle& c = topology.triangles[at(t)];
        if (topology.vertex_edges[at(v)].empty() || std::ranges::find(c, v) != c.end()) continue;
        if (exactly(vertex, {v, c[0], c[1], c[2]})) found.push_back({0, v, t});
      }
    for (Index e = 0; e < static_cast<Index>(topology.edges.size()); ++e)
      for (Index f = e + 1; f < static_cast<Index>(topology.edges.size()); ++f) {
        const Edge &a = topology.edges[at(e)], &b = topology.edges[at(f)];
        if (a[0] == b[0] || a[0] == b[1] || a[1] == b[0] || a[1] == b[1]) continue;
        if (exactly(edges, {a[0], a[1], b[0], b[1]})) found.push_back({1, e, f});
      }
    return found;
  }
};

std::vector<std::array<Index, 3>> names(const MeetingsResult& result) {
  std::vector<std::array<Index, 3>> found;
  for (const Meeting& m : result.meetings) found.push_back({m.kind == edges ? 1 : 0, m.first, m.second});
  return found;
}

}  // namespace

TEST_CASE("meetings: of heaps of triangles and curves that move a little or much, exactly the pairs that integers find",
          "[property]") {
  std::size_t found = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    const Heap heap(seed, seed % 3 == 0 ? 0.02 : seed % 3 == 1 ? 0.1 : 0.6);
    const MeetingsResult result = meetings(heap.topology, heap.from, heap.to);
    CAPTURE(seed);
    REQUIRE(names(result) == heap.brute_force());
    found += result.count;
    CHECK(result.pairs_in_doubt <= result.pairs_tested);
    const MeetingsResult back = meetings(heap.topology, heap.to, heap.from);
    CHECK(names(back) == names(result));
  }
  CHECK(found > 50);
}

TEST_CASE("meetings: a state without intersections and a motion without meetings end without intersections",
          "[property]") {
  int clean = 0, passed = 0;
  for (unsigned seed = 100; seed < 400; ++seed) {
    Heap heap(seed, 0.3);
    for (std::size_t v = 0; v < heap.from.size(); ++v) {  // every four vertices have their own range of z
      heap.from[v].z = coarse(heap.from[v].z * 0.02 + 0.1 * double(v / 4));
      heap.to[v].z = coarse(heap.from[v].z + (heap.to[v].x - heap.from[v].x) * (seed % 2 == 0 ? 0.1 : 1));
    }
    if (audit(heap.topology, heap.from).count > 0) continue;
    const bool met = meetings(heap.topology, heap.from, heap.to).count > 0;
    const bool intersects = audit(heap.topology, heap.to).count > 0;
    REQUIRE_FALSE((intersects && !met));
    clean += !met, passed += met;
  }
  CHECK(clean > 10);
  CHECK(passed > 10);
}

TEST_CASE("meetings: a curve that passes through a curve leaves two states free of intersections, and is found",
          "[unit]") {
  const Topology topology = build_topology(4, {}, std::vector<Edge>{{0, 1}, {2, 3}});
  const std::vector<Vec3> above{{-1, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 1, 0}};
  std::vector<Vec3> below = above;
  below[0].z = below[1].z = -3;
  CHECK(audit(topology, above).count == 0);
  CHECK(audit(topology, below).count == 0);
  const MeetingsResult result = meetings(topology, above, below);
  REQUIRE(result.count == 1);
  CHECK(result.meetings[0] == Meeting{edges, 0, 1, 0.25});
  CHECK(describe(result.meetings[0], topology) ==
        "edge (vertices 0, 1) meets edge (vertices 2, 3) after 0.25 of the motion");
  below[0].z = below[1].z = 0x1p-30;
  CHECK(meetings(topology, above, below).count == 0);
}

TEST_CASE(
    "meetings: two hooked rings that are pulled apart pass through each other, and their linking number changes by "
    "the signed count",
    "[property]") {
  const Index n = 24;
  std::vector<Vec3> from;
  std::vector<Edge> loose;
  add_ring(from, loose, n, {0, 0, 0}, {1, 0, 0.1}, {0, 1, 0.05});
  add_ring(from, loose, n, {1, 0.03, 0}, {1, 0.07, 0.2}, {0.05, 0.1, 1});
  const Topology topology = build_topology(2 * n, {}, loose);
  std::vector<Vec3> to = from;
  for (std::size_t v = at(n); v < to.size(); ++v) to[v].x += 3;
  CHECK(audit(topology, from).count == 0);
  CHECK(audit(topology, to).count == 0);
  CHECK(std::abs(linking_number(from, n)) == 1);
  CHECK(linking_number(to, n) == 0);
  const MeetingsResult result = meetings(topology, from, to);
  CHECK(result.count % 2 == 1);
  int change = 0;
  for (const Meeting& m : result.meetings) {
    // The second ring is translated, so two edges meet at most once. When they meet, the second edge passes from one
    // side of the first edge to the other side.
    std::vector<Vec3> before = from, after = from;
    const auto place = [&](std::vector<Vec3>& x, double t) {
      for (std::size_t v = at(n); v < x.size(); ++v) x[v].x = from[v].x + 3 * t;
    };
    place(before, m.time - 1e-6), place(after, m.time + 1e-6);
    // Returns the edge in the direction of its ring; stored edges have the smaller vertex first.
    const auto along = [&](Index e) {
      const Edge& edge = topology.edges[at(e)];
      return edge[1] - edge[0] == 1 ? edge : Edge{edge[1], edge[0]};
    };
    change += (sense(after, along(m.first), along(m.second)) - sense(before, along(m.first), along(m.second))) / 2;
  }
  CHECK(std::abs(change) == std::abs(linking_number(to, n) - linking_number(from, n)));
  // No edges meet if both rings move together, or if the second ring moves so little that the rings stay linked.
  for (std::size_t v = 0; v < to.size(); ++v) to[v] = {from[v].x + 3, from[v].y - 2, from[v].z + 7};
  CHECK(meetings(topology, from, to).count == 0);
  to = from;
  for (std::size_t v = at(n); v < to.size(); ++v) to[v].x += 0.2;
  CHECK(meetings(topology, from, to).count == 0);
}

TEST_CASE("meetings: what touches counts in the motion to the touch and in the one from it", "[unit]") {
  const Topology topology = build_topology(4, {}, std::vector<Edge>{{0, 1}, {2, 3}});
  const std::vector<Vec3> above{{-1, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 1, 0}};
  std::vector<Vec3> touching = above;
  touching[0].z = touching[1].z = 0;
  CHECK(meetings(topology, above, touching).meetings == std::vector{Meeting{edges, 0, 1, 1}});
  CHECK(meetings(topology, touching, above).meetings == std::vector{Meeting{edges, 0, 1, 0}});
  CHECK(meetings(topology, touching, touching).count == 1);
}

TEST_CASE("meetings: what the audit leaves out is left out", "[unit]") {
  const std::vector<Vec3> above{{-1, 0, 1}, {1, 0, 1}, {0, -1, 0}, {0, 1, 0}};
  std::vector<Vec3> below = above;
  below[0].z = below[1].z = -1;
  const Topology apart = build_topology(4, {}, std::vector<Edge>{{0, 1}, {2, 3}});
  CHECK(meetings(apart, above, below, std::vector<Index>{0, 0, 0, 0}).count == 0);
  CHECK(meetings(apart, above, below, std::vector<Index>{0, 0, 1, 1}).count == 1);
  const Exclusions excluded{.groups = {}, .partners = partner_rows(4, std::vector<std::array<Index, 2>>{{1, 2}})};
  CHECK(meetings(apart, above, below, excluded).count == 0);
  const Topology joined = build_topology(4, {}, std::vector<Edge>{{0, 1}, {1, 2}, {2, 3}});
  // only the first and the last edge meet, since the middle edge shares a vertex with both
  CHECK(meetings(joined, above, below).count == 1);
}

TEST_CASE("meetings: lists at most what it is asked for, on any number of threads the same", "[property]") {
  const Heap heap(3, 0.6);
  const MeetingsResult all = meetings(heap.topology, heap.from, heap.to);
  const MeetingsResult some = meetings(heap.topology, heap.from, heap.to, {}, 3);
  CHECK(some.count == all.count);
  CHECK(some.meetings == std::vector(all.meetings.begin(), all.meetings.begin() + 3));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(meetings(heap.topology, heap.from, heap.to).meetings == all.meetings);
}

TEST_CASE("meetings: a state of another mesh, or one that is not finite, is refused", "[unit]") {
  const Topology topology = build_topology(4, {}, std::vector<Edge>{{0, 1}, {2, 3}});
  const std::vector<Vec3> x(4);
  std::vector<Vec3> broken = x;
  broken[2].y = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(meetings(topology, x, std::vector<Vec3>(3)), InputError);
  CHECK_THROWS_AS(meetings(topology, x, broken), InputError);
  CHECK_THROWS_AS(meetings(topology, broken, x), InputError);
}

TEST_CASE("meetings: what a way will cost is told by all of a small mesh and by a sample of a large one", "[unit]") {
  const Heap heap(7, 0.3);
  const MeetingsCost small = meetings_cost(heap.topology, heap.from, heap.to);
  CHECK(small.pairs == static_cast<double>(meetings(heap.topology, heap.from, heap.to).pairs_tested));
  CHECK(small.seconds > 0);
  CHECK(small.bytes > 2 * heap.from.size() * sizeof(Vec3));
  // The swept box of each of 6,000 rods in a row meets only the boxes of its neighbours.
  std::vector<Vec3> from, to;
  std::vector<Edge> rods;
  for (Index k = 0; k < 6000; ++k) {
    for (const double side : {0., 1.}) {
      from.push_back({double(k), side, 0});
      to.push_back({k + 1.5, side, 0});
    }
    rods.push_back({2 * k, 2 * k + 1});
  }
  const Topology row = build_topology(static_cast<Index>(from.size()), {}, rods);
  CHECK(meetings(row, from, to).pairs_tested == 5999);
  CHECK(meetings_cost(row, from, to).pairs == Approx(6000).epsilon(0.02));
  from.pop_back();
  CHECK_THROWS_AS(meetings_cost(row, from, to), InputError);
}

TEST_CASE("meetings: a braid of 65,000 edges a step on is proved in seconds", "[property]") {
  // The strands of each pair are wound about each other at a distance of 0.7 contact radii. All strands are slanted, so
  // that boxes of near edges overlap. Each coordinate moves by up to 0.05 of a radius.
  const Index strands = 65, segments = 1000;
  const double radius = 1e-3;
  std::vector<Vec3> from, to;
  std::vector<Edge> loose;
  std::mt19937 engine(1);
  std::uniform_real_distribution<double> shift(-0.05 * radius, 0.05 * radius);
  for (Index s = 0; s < strands; ++s)
    for (Index k = 0; k <= segments; ++k) {
      const double along = double(k) * 2 * radius, angle = along / (4 * radius) + double(s % 2) * 3.14159;
      const double a = double(s / 2) * 4 * radius + 0.35 * radius * std::cos(angle),
                   b = 0.35 * radius * std::sin(angle);
      const Vec3 x{along / std::sqrt(3) + a / std::sqrt(2) + b / std::sqrt(6),
                   along / std::sqrt(3) - a / std::sqrt(2) + b / std::sqrt(6),
                   along / std::sqrt(3) - 2 * b / std::sqrt(6)};
      from.push_back(x);
      to.push_back({x.x + shift(engine), x.y + shift(engine), x.z + shift(engine)});
      if (k > 0) loose.push_back({static_cast<Index>(from.size()) - 2, static_cast<Index>(from.size()) - 1});
    }
  const Topology topology = build_topology(static_cast<Index>(from.size()), {}, loose);
  const auto begin = std::chrono::steady_clock::now();
  const MeetingsResult result = meetings(topology, from, to);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  WARN(loose.size() << " edges: " << seconds << " s, " << result.pairs_tested << " pairs, " << result.pairs_in_doubt
                    << " decided without rounding");
  CHECK(result.count == 0);
  CHECK(result.pairs_tested > loose.size() / 3);
  CHECK(result.pairs_in_doubt < result.pairs_tested / 100);
}
