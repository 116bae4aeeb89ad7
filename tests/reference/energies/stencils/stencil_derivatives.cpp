#include "reference/energies/stencils/stencil_derivatives.hpp"

#include <Eigen/Dense>

#include "reference/energies/mollifier.hpp"
#include "reference/energies/stencil_terms.hpp"
#include "reference/solvers/kinds/kinds.hpp"
#include "tests/catch.hpp"
#include "tests/reference/energies/stencils.hpp"

using namespace ogc;
using namespace ogc::reference;
using namespace ogc::tests;
using compare::ContactSides;
using reference::HessianProjection;

namespace {

template <std::size_t N>
using Corners = std::array<Triple<double>, N>;
using Matrix = Eigen::MatrixXd;

template <std::size_t N>
Corners<N> random_corners(Draw& draw, double size) {
  Corners<N> x;
  for (auto& p : x)
    for (double& c : p) c = draw.between(-size, size);
  return x;
}

template <std::size_t N>
Matrix hessian_of(const StencilDerivatives& d) {
  Matrix h(3 * N, 3 * N);
  for (std::size_t i = 0; i < 3 * N; ++i)
    for (std::size_t j = 0; j < 3 * N; ++j)
      h(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = d.hessian[12 * i + j];
  return h;
}

/// Compares the gradient with differences of the energy, and the Hessian with differences of the gradient. `length`:
/// distance over which the energy changes by its own size. With steps of 10⁻⁵ `length`, truncation errs by about 10⁻¹⁰
/// of the third derivative, rounding by 10⁻¹⁶/10⁻⁵ of the value.
template <std::size_t N, class Energy>
void check_against_differences(const Corners<N>& x, double length, Energy energy) {
  const StencilDerivatives at = stencil_derivatives<N>(x, HessianProjection::none, energy);
  CHECK(at.energy == Approx(energy(x)).epsilon(1e-9).margin(1e-300));
  const double step = 1e-5 * length;
  double steepest = 0, stiffest = 0;
  for (const double g : at.gradient) steepest = std::max(steepest, std::abs(g));
  for (const double h : at.hessian) stiffest = std::max(stiffest, std::abs(h));
  for (std::size_t i = 0; i < 3 * N; ++i) {
    Corners<N> ahead = x, behind = x;
    ahead[i / 3][i % 3] += step;
    behind[i / 3][i % 3] -= step;
    const double noise = 1e-15 * std::abs(at.energy) / step;
    CHECK(at.gradient[i] == Approx((energy(ahead) - energy(behind)) / (2 * step))
                                .epsilon(0)
                                .margin(1e-6 * (steepest + stiffest * length) + noise));
    const StencilDerivatives to = stencil_derivatives<N>(ahead, HessianProjection::none, energy);
    const StencilDerivatives from = stencil_derivatives<N>(behind, HessianProjection::none, energy);
    for (std::size_t j = 0; j < 3 * N; ++j)
      CHECK(at.hessian[12 * i + j] == Approx((to.gradient[j] - from.gradient[j]) / (2 * step))
                                          .epsilon(0)
                                          .margin(1e-6 * (stiffest + steepest / length)));
  }
}

/// Checks that net force and net torque are zero, that the Hessian is symmetric, and that `clamp` and `absolute`
/// project its eigenvalues.
template <std::size_t N, class Energy>
void check_structure(const Corners<N>& x, bool turns_freely, Energy energy) {
  const StencilDerivatives at = stencil_derivatives<N>(x, HessianProjection::none, energy);
  Point force{}, torque{};
  double moduli = 0;
  for (std::size_t k = 0; k < N; ++k) {
    const Point g{at.gradient[3 * k], at.gradient[3 * k + 1], at.gradient[3 * k + 2]}, turn = outer(x[k], g);
    for (std::size_t axis = 0; axis < 3; ++axis) force[axis] += g[axis], torque[axis] += turn[axis];
    moduli += tests::norm(g);
  }
  CHECK(tests::norm(force) <= 1e-13 * moduli);
  // Gradients contain the rounding errors of coordinate differences, which slender stencils amplify.
  if (turns_freely) CHECK(tests::norm(torque) <= 1e-9 * moduli * tests::norm(x[0] - x[N - 1]));
  const Matrix h = hessian_of<N>(at);
  CHECK((h - h.transpose()).cwiseAbs().maxCoeff() <= 1e-14 * h.cwiseAbs().maxCoeff());
  const Eigen::SelfAdjointEigenSolver<Matrix> exact(h);
  const double size = h.cwiseAbs().maxCoeff();
  for (const bool absolute : {false, true}) {
    const auto projection = absolute ? HessianProjection::absolute : HessianProjection::clamp;
    Eigen::VectorXd values = exact.eigenvalues();
    for (double& value : values) value = absolute ? std::abs(value) : std::max(value, 0.0);
    const Matrix expected = exact.eigenvectors() * values.asDiagonal() * exact.eigenvectors().transpose();
    CHECK((hessian_of<N>(stencil_derivatives<N>(x, projection, energy)) - expected).cwiseAbs().maxCoeff() <=
          1e-11 * size);
  }
}

template <std::size_t N, class Energy>
void check_all(const Corners<N>& x, double length, bool turns_freely, Energy energy) {
  check_against_differences<N>(x, length, energy);
  check_structure<N>(x, turns_freely, energy);
}

MembraneTerm membrane_term(Draw& draw) {
  MembraneTerm term;
  term.gradient = {{{-90, -110}, {100, 10}, {-10, 100}}};
  term.area = 5e-5;
  term.lambda = 10, term.mu = 7, term.damping = draw.between(0, 0.5);
  term.start = {draw.between(-0.1, 0.1), draw.between(-0.1, 0.1), draw.between(-0.1, 0.1)};
  return term;
}

}  // namespace

TEST_CASE(
    "membrane: gradient and Hessian over all corners are those of the energy, at stretched, compressed and collapsed "
    "triangles",
    "[property]") {
  Draw draw(1);
  for (int i = 0; i < 20; ++i) {
    const MembraneTerm term = membrane_term(draw);
    Corners<3> x = random_corners<3>(draw, 0.01);
    if (i % 4 == 1) x[2] = x[1];
    if (i % 4 == 2) x[2] = 0.5 * (x[0] + x[1]);
    check_all<3>(x, 0.01, term.damping == 0, [&](const auto& at) { return term.energy(at); });
    MembraneTerm elastic = term;
    elastic.damping = 0;
    check_structure<3>(x, true, [&](const auto& at) { return elastic.energy(at); });
  }
}

TEST_CASE(
    "stable Neo-Hookean membrane: gradient and Hessian over all corners are those of the energy, stretched and "
    "compressed",
    "[property]") {
  Draw draw(6);
  for (int i = 0; i < 20; ++i) {
    MembraneTerm term = membrane_term(draw);
    term.model = compare::MembraneModel::stable_neo_hookean;
    const double stretch = draw.between(0.3, 2);
    Corners<3> x{{{0, 0, 0}, {0.01 * stretch, 0, 0}, {0, 0.01 * stretch, 0}}};
    for (auto& p : x)
      for (double& c : p) c += draw.between(-1e-3, 1e-3);
    check_all<3>(x, 1e-3, false, [&](const auto& at) { return term.energy(at); });
    term.damping = 0;
    check_structure<3>(x, true, [&](const auto& at) { return term.energy(at); });
  }
}

TEST_CASE("isometric bending and springs: gradient and Hessian over all vertices are those of the energy",
          "[property]") {
  Draw draw(7);
  for (int i = 0; i < 20; ++i) {
    const double side = 0.01;
    HingeTerm hinge{.vertex = {},
                    .stiffness = 5e-7,
                    .rest_angle = 0,
                    .damping = draw.between(0, 0.5),
                    .start = draw.between(-1, 1),
                    .weight = {30, 70, -60, -40},
                    .model = ogc::compare::BendingModel::isometric_quadratic};
    Corners<4> x{{{0, 0, 0}, {side, 0, 0}, {0.3 * side, side, 0}, {0.6 * side, -side, 0.3 * side}}};
    for (auto& p : x)
      for (double& c : p) c += draw.between(-1e-3, 1e-3);
    check_all<4>(x, side, true, [&](const auto& at) { return hinge.energy(at); });
    const double s = i % 2 == 0 ? 0 : draw.between(0.1, 0.9);
    const SpringTerm spring{{},
                            {1, s - 1, -s, 0},
                            10,
                            i % 3 == 0 ? 0 : draw.between(0, 0.02),
                            draw.between(0, 0.5),
                            draw.between(0.005, 0.02)};
    check_all<4>(x, side, true, [&](const auto& at) { return spring.energy(at); });
  }
}

TEST_CASE(
    "IPC's mollifier of parallel edges: gradient and Hessian are those of the energy, at nearly parallel and at "
    "parallel edges",
    "[property]") {
  Draw draw(8);
  const double r = 5e-3, side = 0.01;
  int acted = 0;
  for (int i = 0; i < 40; ++i) {
    const double sine = i % 4 == 0 ? 0 : draw.between(0.003, 0.03);
    const Corners<4> x{
        {{0, 0, 0.4 * r}, {side, 0, 0.4 * r}, {0.2 * side, -0.5 * sine * side, 0}, {1.2 * side, 0.5 * sine * side, 0}}};
    const ContactTerm term{ContactSides::edge_edge, {}, r, 10, 1, 0, compare::ContactActivation::ipc_log};
    // For parallel edges the weights belong to the middle of the overlap.
    const ClosestForm form = closest_form(term.sides, x);
    const auto energy = [&](const auto& at) {
      using T = std::decay_t<decltype(at[0][0])>;
      const Mollifier<T> mollifier(at[1] - at[0], at[3] - at[2], T(side * side), T(side * side));
      return mollifier.acts() ? mollifier.value() * term.energy(form, at) : term.energy(form, at);
    };
    const Mollifier<double> mollifier(x[1] - x[0], x[3] - x[2], side * side, side * side);
    acted += mollifier.acts();
    // The mollifier changes by its own size if the sine of the edges' angle does. For parallel edges, it does so if the
    // sine reaches the mollifier's limit 0.03.
    check_all<4>(x, 1e-3 * side, form.kind != FormKind::fixed_weights, energy);
  }
  CHECK(acted > 20);
}

TEST_CASE("hinge: gradient and Hessian over all vertices are those of the energy, bent up to a right angle and more",
          "[property]") {
  Draw draw(2);
  for (int i = 0; i < 30; ++i) {
    const HingeTerm term{{}, 5e-7, draw.between(-1, 1), draw.between(0, 0.5), draw.between(-1, 1)};
    const double angle = draw.between(-2.5, 2.5), side = 0.01;
    Corners<4> x{{{0, 0, 0},
                  {side, 0, 0},
                  {0.3 * side, side, 0},
                  {0.6 * side, -side * std::cos(angle), side * std::sin(angle)}}};
    for (auto& p : x)
      for (double& c : p) c += draw.between(-1e-3, 1e-3);
    check_all<4>(x, side, true, [&](const auto& at) { return term.energy(at); });
  }
}

TEST_CASE("a hinge with a collapsed triangle exerts nothing", "[unit]") {
  const HingeTerm term{{}, 5e-7, 0.3, 0.1, 0};
  const Corners<4> x{{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {0.5, -1, 0}}};
  const StencilDerivatives at = stencil_derivatives<4>(x, HessianProjection::clamp,
                                                       [&](const auto& v) { return term.energy(v); });
  CHECK(at.energy == 0);
  for (const double g : at.gradient) CHECK(g == 0);
  for (const double h : at.hessian) CHECK(h == 0);
}

TEST_CASE(
    "contact: gradient and Hessian are those of the energy, for every activation and wherever the closest points lie",
    "[property]") {
  Draw draw(3);
  const double r = 5e-3;
  std::array<int, 5> forms{};
  for (int i = 0; i < 300; ++i) {
    Corners<4> x = random_corners<4>(draw, 1.5 * r);
    const auto sides = static_cast<ContactSides>(i % 4);
    ContactTerm term{sides, {}, r, 10, draw.between(0.1, 1), 0, static_cast<compare::ContactActivation>(i % 5)};
    for (std::size_t k = static_cast<std::size_t>(vertex_count(sides)); k < 4; ++k) x[k] = {};
    const ClosestForm form = closest_form(sides, x);
    const double d = form_distance(form, x);
    // Skips cases whose differences would cross r or r/2, where the activation's formula changes, or come near the
    // activation's pole d = 0.
    if (d > 0.95 * r || d < 0.1 * r || std::abs(d - r / 2) < 1e-3 * r || form.kind == FormKind::fixed_weights) continue;
    ++forms[static_cast<std::size_t>(form.kind)];
    check_all<4>(x, 0.1 * r, true, [&](const auto& at) { return term.energy(form, at); });
  }
  for (std::size_t kind = 0; kind < 4; ++kind) CHECK(forms[kind] >= 5);
}

TEST_CASE("closest points: no other points of the two faces are nearer, and the weights give the distance",
          "[property]") {
  Draw draw(4);
  for (int i = 0; i < 2000; ++i) {
    Corners<4> x = random_corners<4>(draw, 1);
    const auto sides = static_cast<ContactSides>(i % 4);
    if (i % 3 == 0) x[2] = x[1] + 0.7 * (x[3] - x[1]);  // collapsed triangles, edges that point at a vertex
    const ClosestForm form = closest_form(sides, x);
    const Point apart = separation(form.weight, x);
    if (form.kind == FormKind::fixed_weights) continue;
    CHECK(form_distance(form, x) == Approx(tests::norm(apart)).epsilon(1e-9));
    for (int k = 0; k < 20; ++k) {
      double s = draw.between(0, 1), t = draw.between(0, 1);
      if (sides == ContactSides::point_triangle && s + t > 1) s = 1 - s, t = 1 - t;
      const std::array<double, 4> w = sides == ContactSides::point_point  ? std::array{1.0, -1.0, 0.0, 0.0}
                                      : sides == ContactSides::point_edge ? std::array{1.0, s - 1, -s, 0.0}
                                      : sides == ContactSides::edge_edge  ? std::array{1 - s, s, t - 1, -t}
                                                                          : std::array{1.0, s + t - 1, -s, -t};
      CHECK(tests::norm(separation(w, x)) >= tests::norm(apart) * (1 - 1e-9) - 1e-12);
    }
  }
}

TEST_CASE("friction: gradient and Hessian are those of the energy, below and above the slip limit, and at rest",
          "[property]") {
  Draw draw(5);
  for (int i = 0; i < 30; ++i) {
    Corners<4> x = random_corners<4>(draw, 0.01);
    FrictionTerm term{ContactSides::point_triangle, {}, {1, -0.2, -0.3, -0.5}, {0, 0.6, 0.8}, {}, 0.01, 1e-4};
    const Triple<double> apart = separation(term.weight, x);
    const double slip = i % 3 == 0 ? 0 : i % 3 == 1 ? 5e-5 : 1e-2;
    term.start = apart - Triple<double>{slip, 0, 0};
    const auto energy = [&](const auto& at) { return term.energy(at); };
    if (slip > 0) check_against_differences<4>(x, i % 3 == 1 ? 1e-5 : 1e-3, energy);
    check_structure<4>(x, false, energy);
    const StencilDerivatives at = stencil_derivatives<4>(x, HessianProjection::none, energy);
    const double full = slip == 0 ? 0 : slip < 1e-4 ? 0.01 * (2 * 0.5 - 0.25) : 0.01;
    CHECK(at.gradient[0] == Approx(full).margin(1e-9));  // f₁ of the slip
  }
}

TEST_CASE(
    "activations: each vanishes with its slope at r and pushes apart below; the default is C1 at r/2, Eq. 19 as "
    "printed is not",
    "[unit]") {
  using Slope = Derivative<double, 1>;
  const double r = 5e-3, k = 10;
  for (int kind = 0; kind < 5; ++kind) {
    const auto activation = static_cast<compare::ContactActivation>(kind);
    const auto slope = [&](double d) { return contact_activation(activation, Slope(d, 0), r, k).slope[0]; };
    CHECK(contact_activation(activation, r, r, k) == 0);
    CHECK(std::abs(slope(r * (1 - 1e-9))) < 1e-7 * k * r);
    for (const double share : {0.01, 0.3, 0.49, 0.51, 0.9}) CHECK(slope(share * r) < 0);
    const double jump = std::abs(slope(0.5 * r) - slope(0.5 * r * (1 - 1e-12)));
    if (activation == compare::ContactActivation::ogc_as_printed)
      CHECK(jump > 0.1 * k * r);
    else
      CHECK(jump < 1e-9 * k * r);
  }
}

/// The printed formula is a difference of terms of size μ. For strains below 10⁻⁸ their rounding would hide the energy.
TEST_CASE("a stable Neo-Hookean triangle next to rest has the energy of small strains, not the rounding of its terms",
          "[property]") {
  MembraneTerm term;
  term.model = compare::MembraneModel::stable_neo_hookean;
  term.gradient = {{{-1, -1}, {1, 0}, {0, 1}}};
  term.area = 0.5;
  term.lambda = 7;
  term.mu = 10;
  for (const double size : {0x1p-20, 0x1p-30, 0x1p-40}) {
    const Corners<3> x{Triple<double>{0, 0, 0}, Triple<double>{1 + size, 0, 0}, Triple<double>{size, 1 + 2 * size, 0}};
    // To first order the entries xx, xy and yy of G are ε, ε/2 and 2 ε, with ε = `size`.
    const double expected = 0.5 * size * size * (0.5 * 7 * 9 + 10 * (1 + 2 * 0.25 + 4));
    CHECK(term.energy(x) == Approx(expected).epsilon(4 * size));
    const StencilDerivatives at = stencil_derivatives<3>(x, HessianProjection::none,
                                                         [&](const auto& v) { return term.energy(v); });
    CHECK(at.gradient[3] == Approx(0.5 * size * (7 * 3 + 2 * 10)).epsilon(8 * size + 0x1p-50 / size));
  }
}
