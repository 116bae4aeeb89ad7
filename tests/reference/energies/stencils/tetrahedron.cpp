// Compares the stage's truth with differences of the energy in Newton's method, which has another formula.
#include "reference/energies/tetrahedron.hpp"

#include <cmath>

#include "reference/energies/stencil_terms.hpp"
#include "reference/energies/stencils/stencil_derivatives.hpp"
#include "tests/catch.hpp"
#include "tests/reference/energies/stencils.hpp"
#include "tests/reference/energies/stencils/side_by_side.hpp"

using namespace ogc;
using namespace ogc::reference;
using namespace ogc::tests;

namespace {

/// Returns the unit tetrahedron; single precision holds all its rest data exactly except 1/6.
TetrahedronTerm unit_term(double damping) {
  TetrahedronTerm term;
  term.gradient = {{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  term.volume = 1.0 / 6;
  term.lambda = 3e4, term.mu = 1e4, term.damping = damping;
  return term;
}

compare::TetrahedronCase question_of(const TetrahedronTerm& term, const Corners<4>& x, const Corners<4>& start) {
  compare::TetrahedronCase question;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto single = [](const Triple<double>& p) {
      return compare::Vec3f{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])};
    };
    question.corner[k] = single(x[k]);
    question.start[k] = single(start[k]);
  }
  question.weight = {-1.0f / 6, -1.0f / 6, -1.0f / 6};
  question.inverse = 1;
  question.gradient = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  question.volume = 1.0f / 6;
  question.lame_lambda = static_cast<float>(term.lambda);
  question.lame_mu = static_cast<float>(term.mu);
  question.damping = static_cast<float>(term.damping);
  return question;
}

/// Returns shapes in single-precision numbers: near rest, sheared, flat, inverted, a needle.
Corners<4> shape(Draw& draw, int kind) {
  Corners<4> x{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (auto& p : x)
    for (double& c : p) c += draw.between(-1, 1) * (kind == 0 ? 0.01 : 0.6);
  if (kind == 2) x[3][2] = x[0][2] = x[1][2] = x[2][2];
  if (kind == 3) std::swap(x[1], x[2]);
  if (kind == 4) x[2] = {x[1][0] + 1e-3, x[1][1], x[1][2]};
  for (auto& p : x)
    for (double& c : p) c = static_cast<double>(static_cast<float>(c));
  return x;
}

}  // namespace

TEST_CASE("tetrahedron: the stage's force and block are the derivatives of Newton's energy", "[property]") {
  Draw draw(1);
  for (int i = 0; i < 300; ++i)
    for (const double damping : {0.0, 0.5}) {
      TetrahedronTerm term = unit_term(damping);
      const Corners<4> x = shape(draw, i % 5), start = shape(draw, 0);
      term.start = solid_strain(solid_deformation<double>(start, term.gradient));
      const StencilDerivatives all = stencil_derivatives<4>(x, HessianProjection::none,
                                                            [&](const auto& at) { return term.energy(at); });
      const compare::ForceAnswer answer = tetrahedron(question_of(term, x, start));
      // 1/6 is rounded to single precision, which changes a product by 2⁻²⁵ of its size.
      const double margin = 1e-7 * answer.force_scale;
      CHECK(answer.force.x == Approx(-all.gradient[0]).margin(margin));
      CHECK(answer.force.y == Approx(-all.gradient[1]).margin(margin));
      CHECK(answer.force.z == Approx(-all.gradient[2]).margin(margin));
      if (damping > 0) continue;
      constexpr std::array<std::array<std::size_t, 2>, 6> entries{{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}};
      for (std::size_t k = 0; k < 6; ++k)
        CHECK(answer.block[k] ==
              Approx(all.hessian[12 * entries[k][0] + entries[k][1]]).margin(1e-7 * answer.block_scale));
    }
}

TEST_CASE("tetrahedron: near rest the energy loses nothing to what cancels in it", "[property]") {
  Draw draw(2);
  const TetrahedronTerm term = unit_term(0);
  for (const double size : {1e-3, 1e-6, 1e-9}) {
    Corners<4> x{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (std::size_t k = 1; k < 4; ++k) x[k][k - 1] += size;  // stretched by 1 + size along all three axes
    // ψ = μ/2 (3a² − 3) − μ (a³ − 1) + (λ + μ)/2 (a³ − 1)² with a = 1 + s
    const double s = size, grown = 3 * s + 3 * s * s + s * s * s;
    const double expected = term.volume *
                            (term.mu * (-1.5 * s * s - s * s * s) + 0.5 * (term.lambda + term.mu) * grown * grown);
    CHECK(term.energy(x) == Approx(expected).epsilon(1e-6));
  }
}

TEST_CASE("tetrahedron: blocks are positive definite at every F, and the forces of a shape add up to nothing",
          "[property]") {
  Draw draw(3);
  for (int i = 0; i < 200; ++i) {
    const TetrahedronTerm term = unit_term(0);
    const Corners<4> x = shape(draw, i % 5);
    const compare::ForceAnswer answer = tetrahedron(question_of(term, x, x));
    const auto& b = answer.block;
    CHECK(b[0] > 0);
    CHECK(b[0] * b[3] - b[1] * b[1] > 0);
    CHECK(b[0] * (b[3] * b[5] - b[4] * b[4]) - b[1] * (b[1] * b[5] - b[4] * b[2]) + b[2] * (b[1] * b[4] - b[3] * b[2]) >
          0);
    const StencilDerivatives all = stencil_derivatives<4>(x, HessianProjection::none,
                                                          [&](const auto& at) { return term.energy(at); });
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += all.gradient[3 * k + axis];
      CHECK(std::abs(sum) < 1e-8);
    }
  }
}

TEST_CASE("tetrahedra side by side give the bits of tetrahedra alone", "[property]") {
  Draw draw(4);
  for (const double damping : {0.0, 0.5}) {
    std::vector<TetrahedronTerm> terms;
    std::vector<Corners<4>> corners;
    for (std::size_t i = 0; i < batch_width; ++i) {
      terms.push_back(unit_term(damping));
      terms.back().volume *= draw.between(0.5, 2);
      corners.push_back(shape(draw, static_cast<int>(i) % 5));
    }
    for (const MachineKernels& kernels : kernels_of_this_machine())
      check_against_alone<4>(kernels.of<TetrahedronKind>(), terms, corners,
                             [](const auto& term, const Corners<4>& x, HessianProjection projection) {
                               return stencil_derivatives<4>(x, projection,
                                                             [&](const auto& at) { return term.energy(at); });
                             });
  }
}
