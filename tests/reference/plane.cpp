// Tests stage plane on two sheets an eighth of an edge apart, whose planes are derived by hand: each planted fault is
// found, and no other fault is reported.
#include "reference/geometry/plane.hpp"

#include "reference/geometry/pair_planes.hpp"
#include "reference/geometry/primitive_distances.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/reference/mesh_zoo.hpp"
#include "tests/reference/meshes.hpp"

using namespace ogc;
using namespace ogc::tests;
using compare::PrimitivePair;
using compare::VertexPlane;

namespace {

constexpr int side = 3, sheet_vertices = side * side;
constexpr float gap = 0.125f, query_radius = 0.75f, relaxation = 0.4375f;

/// Returns the sheet in which all vertices of a pair lie, or -1 if they lie in both.
template <class Vertices>
int sheet_of(const Vertices& vertices) {
  int lower = 0, upper = 0;
  for (const Index v : vertices) ++(v < sheet_vertices ? lower : upper);
  return lower == 0 ? 1 : (upper == 0 ? 0 : -1);
}

/// The sheets at z = 0 and z = gap. For each pair of primitives of different sheets, every vertex of the pair has one
/// plane.
struct TwoSheets {
  Surface surface = together(grid(side), grid(side, gap));
  compare::Topology topology = surface.topology();
  std::vector<std::uint8_t> is_fixed = std::vector<std::uint8_t>(surface.positions.size(), 0);
  std::vector<std::vector<VertexPlane>> rows{surface.positions.size()};
  /// Within a sheet the nearest pair is a vertex and the hypotenuse opposite to it, √½ apart.
  std::vector<float> bound = std::vector<float>(surface.positions.size(), relaxation * 0.7f);
  std::size_t pairs = 0;

  TwoSheets() {
    for (Index v = 0; v < topology.vertex_count; ++v)
      for (std::size_t t = 0; t < topology.triangles.size(); ++t)
        add({PrimitivePair::Kind::vertex_triangle, v, static_cast<Index>(t)}, std::array{v}, topology.triangles[t]);
    for (std::size_t e = 0; e < topology.edges.size(); ++e)
      for (std::size_t f = e + 1; f < topology.edges.size(); ++f)
        add({PrimitivePair::Kind::edge_edge, static_cast<Index>(e), static_cast<Index>(f)}, topology.edges[e],
            topology.edges[f]);
  }

  compare::PlaneGuarantee truth() const {
    compare::PlaneOut out{{{0}, {}}, bound};
    for (const auto& row : rows) {
      out.planes.items.insert(out.planes.items.end(), row.begin(), row.end());
      out.planes.offsets.push_back(static_cast<Index>(out.planes.items.size()));
    }
    return reference::plane_guarantee({&topology, {}, surface.positions, is_fixed, query_radius, relaxation}, out);
  }

 private:
  template <class First, class Second>
  void add(const PrimitivePair& pair, const First& first, const Second& second) {
    const int a = sheet_of(first), b = sheet_of(second);
    if (a == b) return;
    const auto bear = [&](Index v, int sheet, float normal) {
      const float way = sheet == 0 ? relaxation * gap : (1 - relaxation) * gap;
      rows[static_cast<std::size_t>(v)].push_back({pair, {0, 0, normal}, double{normal} * way});
    };
    // The normal points from the first side to the second.
    const float up = a == 0 ? 1 : -1;
    for (const Index v : first) bear(v, a, up);
    for (const Index v : second) bear(v, b, -up);
  }
};

}  // namespace

TEST_CASE("plane: two sheets with planes between them, each vertex as free as its own sheet leaves it", "[unit]") {
  const TwoSheets sheets;
  const compare::PlaneGuarantee truth = sheets.truth();
  CHECK(truth.kept());
  CHECK(truth.separated > 100);
}

TEST_CASE("plane: every fault of an answer is found", "[unit]") {
  // The faults are planted at a vertex in the middle of the lower sheet, and at one of its planes.
  constexpr std::size_t vertex = 4, some = 3;
  const auto with = [](const std::function<void(TwoSheets&)>& fault) {
    TwoSheets sheets;
    fault(sheets);
    return sheets.truth();
  };
  SECTION("a plane that one vertex does not bear") {
    const auto truth = with([](TwoSheets& s) { s.rows[vertex].erase(s.rows[vertex].begin() + some); });
    CHECK(truth.uncovered == 1);
    CHECK(truth.worst == TwoSheets().rows[vertex][some].pair);
  }
  SECTION("a side that bears none") {
    CHECK(with([](TwoSheets& s) {
            for (int v = sheet_vertices; v < 2 * sheet_vertices; ++v) s.rows[static_cast<std::size_t>(v)].clear();
          }).uncovered > 100);
  }
  SECTION("a flipped normal") {
    const auto truth = with([](TwoSheets& s) { s.rows[vertex][some].normal.z *= -1; });
    CHECK(truth.uncovered == 1);
  }
  SECTION("a normal of other bits") {
    CHECK(with([](TwoSheets& s) { s.rows[vertex][some].normal.x = 0x1p-60f; }).uncovered == 1);
  }
  SECTION("offsets that leave no room between them") {
    const double other = double{1 - relaxation} * double{gap};
    CHECK(with([&](TwoSheets& s) { s.rows[vertex][some].offset = other; }).uncovered == 1);
    CHECK(with([&](TwoSheets& s) { s.rows[vertex][some].offset = std::nextafter(other, 0.0); }).kept());
  }
  SECTION("a half-space that X does not keep") {
    const auto truth = with([](TwoSheets& s) { s.rows[vertex][some].offset = -0x1p-1000; });
    CHECK(truth.broken == 1);
    CHECK_FALSE(truth.kept());
  }
  SECTION("a ball larger than a pair without a plane allows") {
    CHECK(with([](TwoSheets& s) { s.bound[vertex] = relaxation * 0.71f; }).uncovered > 0);
    CHECK(with([](TwoSheets& s) { s.bound[vertex] = std::nanf(""); }).too_large == 1);
  }
  SECTION("a ball larger than what was searched") {
    CHECK(with([](TwoSheets& s) { s.bound[vertex] = relaxation * 0.76f; }).too_large == 1);
  }
}

TEST_CASE("plane: a pair without planes is covered by balls of its exact distance", "[unit]") {
  TwoSheets sheets;
  for (auto& row : sheets.rows) row.clear();
  for (float& b : sheets.bound) b = relaxation * gap;
  CHECK(sheets.truth().kept());
  CHECK(sheets.truth().separated == 0);
  sheets.bound[4] = std::nextafter(relaxation * gap, 1.0f);
  CHECK(sheets.truth().uncovered > 0);
}

TEST_CASE("plane: a fixed side bears none, and stands where it is", "[unit]") {
  TwoSheets sheets;
  for (std::size_t v = sheet_vertices; v < 2 * sheet_vertices; ++v) {
    sheets.is_fixed[v] = 1;
    sheets.rows[v].clear();
  }
  CHECK(sheets.truth().kept());
  for (VertexPlane& plane : sheets.rows[4]) plane.offset = double{gap};
  CHECK(sheets.truth().uncovered > 0);
}

TEST_CASE("plane: positions that leave a half-space are counted, however near", "[unit]") {
  const compare::VertexPlanes planes{{0, 1}, {{{}, {0.1f, 0.2f, 0.3f}, 0}}};
  const Vec3f on{-3, 0, 1};  // 0.3f − 3 · 0.1f = 7·10⁻⁹ > 0, because floats are no exact tenths
  CHECK(reference::broken_planes(planes, std::array{on}) == 1);
  CHECK(reference::broken_planes(planes, std::array{Vec3f{0, 0, 0}}) == 0);
  CHECK(reference::broken_planes({}, std::array{on}) == 0);
}

TEST_CASE("plane: arrays of other meshes are refused", "[unit]") {
  TwoSheets sheets;
  sheets.bound.pop_back();
  CHECK_THROWS_AS(sheets.truth(), compare::InputError);
}

TEST_CASE("pair_planes: of every mesh they hold all pairs within r_q, and no vertex has less room than its ball",
          "[property]") {
  for (const Specimen& specimen : mesh_zoo()) {
    CAPTURE(specimen.name);
    const auto topology = specimen.surface.topology();
    std::vector<std::uint8_t> is_fixed(specimen.surface.positions.size(), 0);
    for (std::size_t v = 0; v < is_fixed.size(); v += 7) is_fixed[v] = 1;
    const float r_q = 2 * specimen.radius;
    const compare::PlaneIn in{&topology, specimen.surface.groups, specimen.surface.positions, is_fixed, r_q, 0.45f};
    const compare::PlaneOut out = reference::pair_planes(in);
    CHECK(reference::plane_guarantee(in, out).kept());
    const auto balls = reference::exact_bounds(question(specimen.surface, topology, specimen.radius, r_q), 0.45f);
    std::size_t narrower = 0, most = 0;
    for (std::size_t v = 0; v < balls.size(); ++v) {
      narrower += out.bound[v] < balls[v];
      most = std::max(most, out.planes.of(static_cast<Index>(v)).size());
    }
    CHECK(narrower == 0);
    CHECK(most <= compare::planes_of_vertex);
  }
}

namespace {

/// Two triangles above one another, so near that all their pairs must have planes.
struct TwoTriangles {
  compare::Topology topology = compare::build_topology(6, std::vector<compare::Triangle>{{0, 1, 2}, {3, 4, 5}});
  std::vector<Vec3f> positions{{0, 0, 0},           {1, 0, 0},           {0, 1, 0},
                               {0.25f, 0.25f, gap}, {1.25f, 0.25f, gap}, {0.25f, 1.25f, gap}};
  std::vector<std::uint8_t> is_fixed = std::vector<std::uint8_t>(6, 0);

  compare::PlaneIn in() const { return {&topology, {}, positions, is_fixed, 0.25f, relaxation}; }
};

}  // namespace

TEST_CASE("plane: what an answer takes from the vertices is told", "[unit]") {
  TwoTriangles two;
  compare::PlaneOut out = reference::pair_planes(two.in());
  SECTION("nothing") {
    const compare::PlaneFreedom free = reference::plane_freedom(two.in(), out);
    CHECK(free.due > 0);
    CHECK(free.missing == 0);
    CHECK(free.needless == 0);
    CHECK(free.narrowing <= compare::plane_narrowing_tolerance);
    CHECK(std::ranges::max(free.ball_shortfall) <= compare::plane_ball_tolerance);
  }
  SECTION("planes that are due") {
    const std::size_t due = reference::plane_freedom(two.in(), out).due;
    out.planes = {};
    CHECK(reference::plane_freedom(two.in(), out).missing == due);
  }
  SECTION("room between two sides, however little") {
    // Both sides together lose 2⁻¹⁷ of the gap, and Σ|δ| (case size) is at most 23 gaps. So the accepted loss, 3 · 2⁻²⁴
    // · Σ|δ|, is smaller.
    const double height = 0x1p-18 * gap;
    for (VertexPlane& plane : out.planes.items) plane.offset -= height;
    CHECK(reference::plane_freedom(two.in(), out).narrowing > compare::plane_narrowing_tolerance);
  }
  SECTION("a ball") {
    out.bound[3] *= 1 - 0x1p-16f;
    CHECK(reference::plane_freedom(two.in(), out).ball_shortfall[3] > compare::plane_ball_tolerance);
    CHECK(reference::plane_freedom(two.in(), out).ball_shortfall[2] <= compare::plane_ball_tolerance);
  }
  SECTION("half-spaces of pairs that are none") {
    // The pair is vertex 1 and the upper triangle, 0.28 m apart.
    out.planes.items.front().pair = {compare::PrimitivePair::Kind::vertex_triangle, 1, 1};
    CHECK(reference::plane_freedom(two.in(), out).needless == 1);
  }
}

TEST_CASE("plane: a fixed side leaves the other all the room", "[unit]") {
  TwoTriangles two;
  std::fill(two.is_fixed.begin(), two.is_fixed.begin() + 3, std::uint8_t{1});
  compare::PlaneOut out = reference::pair_planes(two.in());
  CHECK(reference::plane_guarantee(two.in(), out).kept());
  CHECK(reference::plane_freedom(two.in(), out).narrowing <= compare::plane_narrowing_tolerance);
  // Planes that leave γ_p of the gap instead of 2γ_p are too narrow by γ_p = 0.4375 of the gap. The error scale of the
  // narrowing is 2⁻²⁴ Σ|δ| (case size), and Σ|δ| is at most 23 gaps.
  for (VertexPlane& plane : out.planes.items) plane.offset -= double{relaxation} * double{gap};
  CHECK(reference::plane_freedom(two.in(), out).narrowing > 1e5);
}

TEST_CASE("plane: nothing bounds a vertex inside a solid, and no pair has one", "[unit]") {
  TwoTriangles two;
  two.positions.push_back({0.3f, 0.3f, 0.0625f});
  two.is_fixed.push_back(0);
  two.topology.vertex_count = 7;
  two.topology.off_surface = {0, 0, 0, 0, 0, 0, 1};
  compare::PlaneOut out = reference::pair_planes(two.in());
  CHECK(out.bound[6] == std::numeric_limits<float>::max());
  CHECK(out.planes.of(6).empty());
  CHECK(reference::plane_guarantee(two.in(), out).kept());
  CHECK(reference::plane_freedom(two.in(), out).bounded_inside == 0);
  out.bound[6] = 0.1f;
  CHECK(reference::plane_freedom(two.in(), out).bounded_inside == 1);
}
