#include "compare/laws/elastic.hpp"

#include <cmath>

#include "compare/laws/law.hpp"
#include "compare/problem/error.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::compare;
using law_measures::elastic;

namespace {

// Returns two right triangles on either side of an edge of length 1 along z; each is 1 wide.
Scene flap() {
  Scene scene;
  Material material;
  material.membrane = MembraneModel::st_venant_kirchhoff;
  material.lame_mu = 3;
  material.lame_lambda = 2;
  material.bending_stiffness = 0.25;
  append_body(scene, {.name = "flap", .material = material},
              {.positions = {{0, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {1, 0, 0}},
               .triangles = {{0, 2, 1}, {0, 1, 3}},
               .loose_edges = {}});
  return scene;
}

}  // namespace

TEST_CASE("laws' elastic energy: a stretched triangle, a bent hinge, both by hand", "[unit]") {
  const Scene scene = flap();
  std::vector<Vec3> x = scene.rest_positions;
  const std::vector<Vec3> none(4);
  CHECK(elastic(scene, x, none).energy == 0);
  // The second triangle is stretched to s across the edge. The only entry of its Green strain G is (s² − 1)/2, its
  // energy density is ψ = (λ/2 + μ) G², and its area is 1/2.
  const double s = 1.2, strain = (s * s - 1) / 2;
  x[3] = {s, 0, 0};
  CHECK(elastic(scene, x, none).energy == Approx(4 * strain * strain / 2));
  // The second triangle rotates by θ about the edge. Then E = c θ²/2 and dE/dθ = c θ, with c = 3 k_b · 1/(1/2 + 1/2)
  // (method.md §4.7).
  const double angle = 0.7;
  x[3] = {std::cos(angle), std::sin(angle), 0};
  const std::vector<Vec3> turning{{}, {}, {}, {-std::sin(angle), std::cos(angle), 0}};
  CHECK(elastic(scene, x, turning).energy == Approx(0.75 * angle * angle / 2));
  CHECK(elastic(scene, x, turning).change == Approx(0.75 * angle));
}

// The energy varies over the length of a cell, 0.03 m. So along a displacement of 1 m its third derivative is about 10³
// = 1/0.03² times its first. A central difference with t = 10⁻⁵ thus has a relative error of t²/6 · 10³ = 2 · 10⁻⁸, and
// rounding adds less. The tolerance is fifty times as large.
TEST_CASE("laws' elastic energy: its change is that of the energy, on the pinned sheet", "[unit]") {
  const Scene scene = find_law("pinned_sheet").scenes(LawSize::least).at(0);
  std::vector<Vec3> x = scene.rest_positions, along(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) {
    const double k = static_cast<double>(v);
    x[v].y += 0.01 * std::sin(3 * k);
    x[v].x += 0.004 * std::cos(5 * k);
    along[v] = {std::sin(7 * k), std::cos(11 * k), std::sin(13 * k)};
  }
  const auto shifted = [&](double t) {
    std::vector<Vec3> y = x;
    for (std::size_t v = 0; v < y.size(); ++v) {
      y[v].x += t * along[v].x;
      y[v].y += t * along[v].y;
      y[v].z += t * along[v].z;
    }
    return elastic(scene, y, along).energy;
  };
  const double t = 1e-5;
  CHECK(elastic(scene, x, along).change == Approx((shifted(t) - shifted(-t)) / (2 * t)).epsilon(1e-6));
}

TEST_CASE("laws' elastic energy: another model is refused", "[unit]") {
  Scene scene = flap();
  const std::vector<Vec3> none(4);
  scene.bodies[0].material.bending = BendingModel::isometric_quadratic;
  CHECK_THROWS_AS(elastic(scene, scene.rest_positions, none), InputError);
  scene.bodies[0].material.bending = BendingModel::none;
  CHECK(elastic(scene, scene.rest_positions, none).energy == 0);
  scene.bodies[0].material.membrane = MembraneModel::stable_neo_hookean;
  CHECK_THROWS_AS(elastic(scene, scene.rest_positions, none), InputError);
}
