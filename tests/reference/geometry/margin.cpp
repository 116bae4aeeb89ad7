// Tests the sensitivity that measures the grey zone: compares the written derivatives of the margins with forward
// differentiation of the formulas.
#include "reference/geometry/margin.hpp"

#include "compare/judge/cases/random.hpp"
#include "reference/geometry/formulas.hpp"
#include "reference/geometry/sensitivity.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using compare::Vec3f;
using reference::Margin;
using reference::MarginKind;

namespace {

using Number = reference::Dual<9>;
using Corner = reference::Point<Number>;

Number gap(const reference::Quotient<Number>& d, float radius) {
  return d.numerator - Number(double{radius} * radius) * d.denominator;
}

Number formula(const Margin& m, const std::array<Corner, 4>& at) {
  switch (m.kind) {
    case MarginKind::along: return along(at[0], at[1], at[2]);
    case MarginKind::side: return side(at[0], at[1], at[2], at[3]);
    case MarginKind::turn: return turn(at[0], at[1], at[2], at[3]);
    case MarginKind::parallel: return parallel(at[0], at[1], at[2], at[3]);
    case MarginKind::gap_points: return gap(squared_distance_points(at[0], at[1]), m.radius);
    case MarginKind::gap_line: return gap(squared_distance_line(at[0], at[1], at[2]), m.radius);
    case MarginKind::gap_plane: return gap(squared_distance_plane(at[0], at[1], at[2], at[3]), m.radius);
    default: return gap(squared_distance_lines(at[0], at[1], at[2], at[3]), m.radius);
  }
}

double differentiated(const Margin& m) {
  std::array<std::array<double, 3>, 4> delta{};
  std::array<Corner, 4> at{};
  for (std::size_t i = 1; i < 4; ++i) {
    delta[i] = {double{m.at[i].x} - m.at[0].x, double{m.at[i].y} - m.at[0].y, double{m.at[i].z} - m.at[0].z};
    const std::size_t first = 3 * (i - 1);
    at[i] = {Number(delta[i][0], first), Number(delta[i][1], first + 1), Number(delta[i][2], first + 2)};
  }
  const Number value = formula(m, at);
  double sum = 0;
  for (std::size_t i = 0; i < 9; ++i) sum += std::abs(value.slope[i] * delta[1 + i / 3][i % 3]);
  return sum;
}

/// Returns a margin with random coordinates in the unit box, on a lattice, or in a plane. So terms may also vanish.
Margin some_margin(MarginKind kind, compare::Random& random) {
  Margin margin{kind};
  const int family = random.below(3);
  const auto number = [&] { return static_cast<float>(family == 1 ? random.below(5) - 2 : random.between(-1, 1)); };
  for (Vec3f& p : margin.at) {
    const float x = number(), y = number();
    p = {x, y, family == 2 ? 0.25f : number()};
  }
  if (kind >= MarginKind::gap_points) margin.radius = static_cast<float>(random.unit());
  return margin;
}

}  // namespace

TEST_CASE("margin: the sum of derivatives times coordinates is that of the differentiated formula, for each kind",
          "[property]") {
  for (int kind = 0; kind <= static_cast<int>(MarginKind::gap_lines); ++kind) {
    for (std::uint64_t i = 0; i < 2000; ++i) {
      compare::Random random("margin", "sensitivity", static_cast<std::uint64_t>(kind), i);
      const Margin margin = some_margin(static_cast<MarginKind>(kind), random);
      const double exact = differentiated(margin);
      INFO("kind " << kind << ", case " << i);
      // Both numbers are sums of products of coordinate differences up to 4, with about twenty roundings. The formula
      // of `parallel` has a factor of 10⁶.
      REQUIRE(reference::sensitivity(margin) ==
              Approx(exact).epsilon(1e-12).margin(kind == static_cast<int>(MarginKind::parallel) ? 1e-7 : 1e-12));
    }
  }
}
