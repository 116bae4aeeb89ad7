#include "reference/ipc/barrier.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "reference/energies/stencils/stencil_derivatives.hpp"
#include "reference/ipc/barrier_kernels.hpp"
#include "reference/ipc/pairs.hpp"
#include "tests/catch.hpp"
#include "tests/reference/energies/stencils.hpp"
#include "tests/reference/energies/stencils/side_by_side.hpp"

using namespace ogc;
using namespace ogc::reference;
using namespace ogc::tests;
using compare::ContactSides;
using compare::Index;
using reference::HessianProjection;

namespace {

using Many = boost::multiprecision::cpp_bin_float_100;

Many exact_barrier(const Many& gap, const Many& support) {
  return -(gap - support) * (gap - support) * log(gap / support);
}

/// A mesh of separate pieces, with the other data of its PairMesh.
struct Pieces {
  State x;
  compare::Topology topology;
  compare::Exclusions exclusions;
  std::vector<float> rest;
  PairMesh mesh() const { return {topology, exclusions, rest}; }
};

Pieces pieces(State x, const std::vector<compare::Triangle>& triangles, const std::vector<compare::Edge>& edges = {}) {
  Pieces p;
  p.topology = compare::build_topology(static_cast<Index>(x.size()), triangles, edges);
  p.exclusions.groups.assign(x.size(), -1);
  for (const compare::Edge& e : p.topology.edges) {
    const Triple<double> d = x[static_cast<std::size_t>(e[1])] - x[static_cast<std::size_t>(e[0])];
    p.rest.push_back(static_cast<float>(dot(d, d)));
  }
  p.x = std::move(x);
  return p;
}

BarrierSet barriers(const Pieces& p, const BarrierShape& shape) {
  return barriers_at(p.mesh(), shape, near_pairs(p.mesh(), p.x, p.x, shape.reach()), p.x);
}

template <std::size_t N>
std::array<Triple<double>, N> corners(const BarrierTerm& term, const State& x) {
  std::array<Triple<double>, N> at;
  for (std::size_t k = 0; k < N; ++k) at[k] = x[static_cast<std::size_t>(term.vertex[k])];
  return at;
}

double energy(const BarrierTerm& term, const BarrierShape& shape, const State& x) {
  if (term.count == 2) return term.energy(shape, corners<2>(term, x));
  if (term.count == 3) return term.energy(shape, corners<3>(term, x));
  return term.energy(shape, corners<4>(term, x));
}

double total(const Pieces& p, const BarrierShape& shape) {
  double sum = 0;
  for (const BarrierTerm& term : barriers(p, shape).terms) sum += energy(term, shape, p.x);
  return sum;
}

}  // namespace

TEST_CASE("barrier: value, slope and curvature are those of -(g - H)^2 ln(g/H), from near zero to its end",
          "[property]") {
  for (const double support : {1e-6, 0.3}) {
    for (double share = 1e-12; share < 1; share *= 3) {
      const double gap = share * support;
      const Second<1> b = barrier_slopes(gap, support);
      const Many g(gap), h(support), step = g * Many("1e-25");
      const Many before = exact_barrier(g - step, h), here = exact_barrier(g, h), after = exact_barrier(g + step, h);
      // Near the end of its support H the barrier is proportional to (1 − g/H)³, with the gap g. 1 − g/H has a rounding
      // error of 2⁻⁵³.
      const double loss = 1e-14 / (1 - share);
      CHECK(b.value == Approx(static_cast<double>(here)).epsilon(3 * loss));
      CHECK(b.slope[0] == Approx(static_cast<double>((after - before) / (2 * step))).epsilon(3 * loss));
      CHECK(b.bend(0) == Approx(static_cast<double>((after - 2 * here + before) / (step * step))).epsilon(3 * loss));
    }
    CHECK(barrier(support, support) == 0);
    CHECK(barrier(2 * support, support) == 0);
  }
}

TEST_CASE("barrier: a vertex over a triangle, its rim and its corner has one term of the right vertices", "[unit]") {
  const BarrierShape shape{0.1, 0};
  const std::vector<compare::Triangle> triangle{{0, 1, 2}};
  const auto above = [&](double x, double y) {
    return barriers(pieces({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {x, y, 0.05}, {x, y, 5}}, triangle, {{3, 4}}), shape)
        .terms;
  };
  // The edge {3, 4} points upwards. So its closest point to each edge of the triangle is vertex 3, and each edge nearer
  // than d̂ adds 1 to the weight of the vertex's term.
  const auto inside = above(0.25, 0.25);
  REQUIRE(inside.size() == 1);
  CHECK(inside[0].count == 4);
  const auto rim = above(-0.05, 0.5);
  REQUIRE(rim.size() == 1);
  CHECK((rim[0].count == 3 && rim[0].vertex == std::array<Index, 4>{3, 0, 2, -1}));
  CHECK(rim[0].weight == 2);
  const auto corner = above(-0.05, -0.05);
  REQUIRE(corner.size() == 1);
  CHECK((corner[0].count == 2 && corner[0].vertex == std::array<Index, 4>{0, 3, -1, -1}));
  CHECK(corner[0].weight == 3);  // the triangle and its two edges at the corner
}

TEST_CASE("barrier: merged terms have the energy of all pairs one by one", "[property]") {
  const BarrierShape shape{0.2, 0};
  Draw draw(3);
  for (int i = 0; i < 50; ++i) {
    State x;
    for (int k = 0; k < 10; ++k) x.push_back({draw.between(0, 0.5), draw.between(0, 0.5), draw.between(0, 0.5)});
    const Pieces p = pieces(x, {{0, 1, 2}, {1, 2, 3}, {4, 5, 6}, {5, 6, 7}}, {{8, 9}});
    const auto pairs = near_pairs(p.mesh(), p.x, p.x, shape.reach());
    double apart = 0;
    for (const PrimitivePair& pair : pairs)
      for (const BarrierTerm& term : barriers_at(p.mesh(), shape, {pair}, p.x).terms) apart += energy(term, shape, p.x);
    CHECK(total(p, shape) == Approx(apart).epsilon(1e-12));
  }
}

TEST_CASE(
    "barrier: the pairs found with the tree are all pairs within reach, without shared vertices or a common rigid "
    "group",
    "[property]") {
  Draw draw(4);
  const double reach = 0.2;
  State x;
  for (int k = 0; k < 60; ++k) x.push_back({draw.between(0, 1), draw.between(0, 1), draw.between(0, 1)});
  std::vector<compare::Triangle> triangles;
  for (Index k = 0; k + 2 < 60; k += 2) triangles.push_back({k, k + 1, k + 2});
  Pieces p = pieces(x, triangles);
  for (std::size_t v = 0; v < 20; ++v) p.exclusions.groups[v] = 0;
  State to = x;
  for (auto& c : to) c = c + Triple<double>{draw.between(-0.1, 0.1), 0, draw.between(-0.1, 0.1)};
  const auto found = near_pairs(p.mesh(), x, to, reach);
  const auto shares = [](const auto& a, const auto& b) {
    return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
  };
  for (const double t : {0.0, 0.5, 1.0}) {
    State at = x;
    for (std::size_t v = 0; v < at.size(); ++v) at[v] = x[v] + t * (to[v] - x[v]);
    for (Index v = 0; v < 60; ++v)
      for (Index k = 0; k < static_cast<Index>(triangles.size()); ++k) {
        const auto& corner = p.topology.triangles[static_cast<std::size_t>(k)];
        const bool fixed = v < 20 && std::all_of(corner.begin(), corner.end(), [](Index c) { return c < 20; });
        const PrimitivePair pair{ContactSides::point_triangle, v, k};
        const bool listed = std::find(found.begin(), found.end(), pair) != found.end();
        if (fixed || shares(std::array{v}, corner)) {
          REQUIRE_FALSE(listed);
          continue;
        }
        const std::array<Triple<double>, 4> c = corners_of({v, corner[0], corner[1], corner[2]}, at);
        if (form_distance(closest_form(ContactSides::point_triangle, c), c) < reach) REQUIRE(listed);
      }
  }
}

TEST_CASE("barrier: gradient and Hessian are those of the energy, mollified or not, with and without thickness",
          "[property]") {
  Draw draw(5);
  int mollified = 0, lines = 0;
  for (int i = 0; i < 400; ++i) {
    const BarrierShape shape{0.5, i % 2 == 0 ? 0 : 0.05};
    const double angle = i % 4 < 2 ? draw.between(0.001, 0.02) : draw.between(0.2, 1.5);
    State x{{0, 0, 0},
            {1, 0, 0},
            {0.3 - 0.5 * std::cos(angle), -0.5 * std::sin(angle), 0.2},
            {0.3 + 0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.201}};
    if (i % 3 == 0) x[2][0] += 1.1, x[3][0] += 1.1;
    const Pieces p = pieces(x, {}, {{0, 1}, {2, 3}});
    const auto terms = barriers(p, shape).terms;
    if (terms.size() != 1 || terms[0].count != 4) continue;
    const BarrierTerm& term = terms[0];
    ++(term.rest_squared > 0 ? mollified : lines);
    const auto at = corners<4>(term, x);
    const auto of = [&](const auto& variables) { return term.energy(shape, variables); };
    const StencilDerivatives d = stencil_derivatives<4>(at, HessianProjection::none, of);
    CHECK(d.energy == Approx(of(at)).epsilon(1e-12));
    const double step = 1e-6;
    double stiffest = 0;
    for (const double h : d.hessian) stiffest = std::max(stiffest, std::abs(h));
    for (std::size_t k = 0; k < 12; ++k) {
      auto ahead = at, behind = at;
      ahead[k / 3][k % 3] += step, behind[k / 3][k % 3] -= step;
      CHECK(d.gradient[k] == Approx((of(ahead) - of(behind)) / (2 * step)).epsilon(0).margin(1e-5 * stiffest * 1e-2));
      const auto to = stencil_derivatives<4>(ahead, HessianProjection::none, of),
                 from = stencil_derivatives<4>(behind, HessianProjection::none, of);
      for (std::size_t j = 0; j < 12; ++j)
        CHECK(d.hessian[12 * k + j] ==
              Approx((to.gradient[j] - from.gradient[j]) / (2 * step)).epsilon(0).margin(1e-5 * stiffest));
    }
  }
  CHECK(mollified > 20);
  CHECK(lines > 20);
}

TEST_CASE(
    "barriers side by side have the derivatives of each alone, to the bit, mollified ones and other forms among them",
    "[property]") {
  std::vector<const BarrierKernels*> all{&barrier_kernels_baseline};
  if (has_avx2()) all.push_back(&barrier_kernels_avx2);
  Draw draw(15);
  for (const BarrierKernels* kernels : all)
    for (int round = 0; round < 60; ++round) {
      std::vector<ShapedBarrier> points, lines, planes;
      std::vector<Corners<2>> of_2;
      std::vector<Corners<3>> of_3;
      std::vector<Corners<4>> of_4;
      for (std::size_t i = 0; i < batch_width; ++i) {
        const auto term = [&](std::uint8_t count, FormKind form) {
          BarrierTerm barrier;
          barrier.count = count;
          barrier.form = {form, {0, 1, 2, 3}, {}};
          barrier.weight = draw.between(0.1, 3);
          return ShapedBarrier{barrier, {0.5, round % 2 == 0 ? 0 : 0.05}};
        };
        points.push_back(term(2, FormKind::points));
        lines.push_back(term(3, FormKind::point_line));
        planes.push_back(term(4, i % 2 == 0 ? FormKind::lines : FormKind::point_plane));
        if (round % 3 == 0 && i % 4 < 2) {
          planes.back().barrier.rest_squared = 1;
          planes.back().barrier.form = {i % 4 == 0 ? FormKind::points : FormKind::lines, {0, 2, 1, 3}, {}};
        }
        Corners<4> x{{{0.2, 0.3, 0.1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
        for (auto& p : x)
          for (double& c : p) c += draw.between(-0.05, 0.05);
        x[0][2] += draw.between(0.05, 0.5);
        of_2.push_back({x[0], x[1]});
        of_3.push_back({x[0], x[1], x[2]});
        of_4.push_back(x);
      }
      const auto alone = [](const auto& of, const auto& x, HessianProjection projection) {
        return stencil_derivatives<std::tuple_size_v<std::decay_t<decltype(x)>>>(
            x, projection, [&](const auto& at) { return of.energy(at); });
      };
      check_against_alone<2>(kernels->of_2, points, of_2, alone);
      check_against_alone<3>(kernels->of_3, lines, of_3, alone);
      check_against_alone<4>(kernels->of_4, planes, of_4, alone);
    }
}

TEST_CASE("barrier: the energy does not jump where closest features change, parallel edges included", "[property]") {
  const BarrierShape shape{0.2, 0};
  // A vertex slides over a triangle and beyond it; a short edge rotates above a long edge.
  const auto largest_jump = [&](auto pieces_at) {
    double largest = 0, before = total(pieces_at(0.0), shape), highest = before;
    for (int k = 1; k <= 4000; ++k) {
      const double now = total(pieces_at(k / 4000.0), shape);
      largest = std::max(largest, std::abs(now - before));
      highest = std::max(highest, now);
      before = now;
    }
    return largest / highest;
  };
  CHECK(largest_jump([](double t) {
          return pieces({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.5 + 2 * t, 0.3, 0.05}}, {{0, 1, 2}});
        }) < 0.02);
  CHECK(largest_jump([](double t) {
          const double angle = 0.1 * (t - 0.5), low = -0.3 * std::sin(angle);
          return pieces({{0, 0, 0}, {1, 0, 0}, {0.2, low, 0.05}, {0.2 + 0.6 * std::cos(angle), -low, 0.05}}, {},
                        {{0, 1}, {2, 3}});
        }) < 0.02);
}

TEST_CASE("barrier: pairs without a gap are named, not acted upon", "[unit]") {
  const Pieces p = pieces({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.25, 0.25, 0.01}}, {{0, 1, 2}});
  const BarrierSet set = barriers(p, {0.1, 0.02});
  CHECK(set.terms.empty());
  REQUIRE(set.touching.size() == 1);
  CHECK(describe(p.topology, set.touching[0]) == "vertex 3 and triangle 0 (vertices 0, 1, 2)");
}
