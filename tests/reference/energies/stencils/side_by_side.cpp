#include "reference/energies/stencils/side_by_side.hpp"

#include <limits>

#include <Eigen/Dense>

#include "tests/catch.hpp"
#include "tests/reference/energies/stencils.hpp"
#include "tests/reference/energies/stencils/side_by_side.hpp"

using namespace ogc;
using namespace ogc::reference;
using namespace ogc::tests;
using reference::HessianProjection;

namespace {

Corners<4> hinge_corners(Draw& draw, bool collapsed) {
  const double side = 0.01, angle = draw.between(-2.5, 2.5);
  Corners<4> x{
      {{0, 0, 0}, {side, 0, 0}, {0.3 * side, side, 0}, {0.6 * side, -side * std::cos(angle), side * std::sin(angle)}}};
  for (auto& p : x)
    for (double& c : p) c += draw.between(-1e-3, 1e-3);
  if (collapsed) x[2] = x[1];
  return x;
}

MembraneTerm membrane(Draw& draw, bool damped, compare::MembraneModel model) {
  MembraneTerm term;
  term.gradient = {{{-90, -110}, {100, 10}, {-10, 100}}};
  term.area = draw.between(4e-5, 6e-5);
  term.lambda = 10, term.mu = 7, term.damping = damped ? draw.between(0, 0.5) : 0;
  term.start = {draw.between(-0.1, 0.1), draw.between(-0.1, 0.1), draw.between(-0.1, 0.1)};
  term.model = model;
  return term;
}

/// Returns a function that differentiates a single stencil. stencil_derivatives.cpp in this folder compares its results
/// with differences of energies.
template <std::size_t Count>
auto alone() {
  return [](const auto& term, const Corners<Count>& x, HessianProjection projection) {
    return stencil_derivatives<Count>(x, projection, [&](const auto& at) { return term.energy(at); });
  };
}

template <std::size_t N>
using Matrix = Eigen::Matrix<double, static_cast<int>(N), static_cast<int>(N)>;

/// Returns a symmetric matrix with these eigenvalues in a random basis.
template <std::size_t N>
Matrix<N> with_eigenvalues(Draw& draw, const std::array<double, N>& values) {
  Matrix<N> random;
  for (double& x : random.reshaped()) x = draw.between(-1, 1);
  const Matrix<N> basis = random.householderQr().householderQ();
  Matrix<N> diagonal = Matrix<N>::Zero();
  for (std::size_t i = 0; i < N; ++i) diagonal(static_cast<int>(i), static_cast<int>(i)) = values[i];
  const Matrix<N> h = basis * diagonal * basis.transpose();
  return 0.5 * (h + h.transpose());
}

/// Returns a matrix by `kind`: arbitrary (0), with eigenvalues ±1 (1), with eigenvalues over many orders of magnitude
/// (2), of rank one (3), diagonal (4), or without coupling between even and odd rows (5).
template <std::size_t N>
Matrix<N> matrix_of_kind(Draw& draw, int kind) {
  std::array<double, N> values;
  for (std::size_t i = 0; i < N; ++i) {
    const double sign = draw.between(-1, 1) < 0 ? -1 : 1;
    values[i] = kind == 1            ? sign
                : kind == 2          ? sign * std::pow(10.0, draw.between(-16, 4))
                : kind == 3 && i > 0 ? 0
                                     : draw.between(-1, 1);
  }
  Matrix<N> h = with_eigenvalues<N>(draw, values);
  if (kind == 4) h = Matrix<N>(h.diagonal().asDiagonal());
  if (kind == 5)
    for (int i = 0; i < static_cast<int>(N); ++i)
      for (int j = 0; j < static_cast<int>(N); ++j)
        if (i % 2 != j % 2) h(i, j) = 0;
  return h;
}

template <std::size_t N>
Matrix<N> projected_by_eigen(const Matrix<N>& h, bool absolute) {
  const Eigen::SelfAdjointEigenSolver<Matrix<N>> solver(h);
  Eigen::Matrix<double, static_cast<int>(N), 1> values = solver.eigenvalues();
  for (double& value : values) value = absolute ? std::abs(value) : std::max(value, 0.0);
  return solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
}

template <std::size_t N, std::size_t Packs>
LowerTriangle<N, Lanes<Packs>> in_lanes(const std::vector<Matrix<N>>& matrices) {
  LowerTriangle<N, Lanes<Packs>> h;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      for (std::size_t lane = 0; lane < matrices.size(); ++lane)
        h[lower(i, j)].part[lane / pack_width][lane % pack_width] = matrices[lane](static_cast<int>(i),
                                                                                   static_cast<int>(j));
  return h;
}

template <std::size_t N, std::size_t Packs>
Matrix<N> lane_of(const LowerTriangle<N, Lanes<Packs>>& h, std::size_t lane) {
  Matrix<N> m;
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = 0; j < N; ++j)
      m(static_cast<int>(i), static_cast<int>(j)) = h[lower(i, j)].part[lane / pack_width][lane % pack_width];
  return m;
}

/// Error bound of the difference of two projections. Each solver has these errors:
/// - It applies N − 2 reflections and about two rotations for each of the N(N − 1)/2 entries off the diagonal, to rows
///   and columns. Each application has an error of at most 8 · 2⁻⁵³ ‖H‖ (Frobenius).
/// - Clamping does not enlarge the error; the modulus enlarges it by at most √2 (Araki and Yamagami 1981).
/// - The sum of N terms of rank one adds a few 2⁻⁵³ ‖H‖ for each term.
template <std::size_t N>
constexpr double projection_bound = 0x1p-53 * 2 * 1.5 * (2 * 8.0 * (N - 2 + N * (N - 1)) + 4 * N);

template <std::size_t N>
void check_projection() {
  constexpr std::size_t packs = batch_width / pack_width;
  Draw draw(static_cast<unsigned>(N));
  for (int round = 0; round < 200; ++round)
    for (const bool absolute : {false, true}) {
      std::vector<Matrix<N>> matrices;
      for (std::size_t lane = 0; lane < batch_width; ++lane)
        matrices.push_back(matrix_of_kind<N>(draw, static_cast<int>(lane) % 6));
      auto h = in_lanes<N, packs>(matrices);
      project<N, packs>(h, absolute);
      for (std::size_t lane = 0; lane < batch_width; ++lane) {
        const Matrix<N> difference = lane_of<N, packs>(h, lane) - projected_by_eigen<N>(matrices[lane], absolute);
        CHECK(difference.norm() <= projection_bound<N> * matrices[lane].norm());
        auto single = in_lanes<N, 1>({pack_width, matrices[lane]});
        project<N, 1>(single, absolute);
        CHECK(lane_of<N, 1>(single, 0) == lane_of<N, packs>(h, lane));
      }
    }
}

}  // namespace

TEST_CASE("stencils side by side have the derivatives of each alone, to the bit, whatever branches the others take",
          "[property]") {
  Draw draw(11);
  for (const MachineKernels& kernels : kernels_of_this_machine()) {
    for (int round = 0; round < 30; ++round) {
      std::vector<MembraneTerm> membranes;
      std::vector<HingeTerm> hinges;
      std::vector<Corners<3>> triangles;
      std::vector<Corners<4>> folds;
      for (std::size_t i = 0; i < batch_width; ++i) {
        // In every third round, some stencils at random get another model, shape or damping, so that they take other
        // branches.
        const auto other = [&] { return round % 3 == 2 && draw.between(0, 1) < 0.3; };
        const bool neo_hookean = (round % 2 == 0) != other();
        membranes.push_back(membrane(
            draw, !other(),
            neo_hookean ? compare::MembraneModel::stable_neo_hookean : compare::MembraneModel::st_venant_kirchhoff));
        Corners<4> fold = hinge_corners(draw, other());
        triangles.push_back({fold[0], fold[1], other() ? fold[1] : fold[3]});
        folds.push_back(fold);
        hinges.push_back(
            {.vertex = {},
             .stiffness = 5e-7,
             .rest_angle = draw.between(-1, 1),
             .damping = other() ? 0 : draw.between(0, 0.5),
             .start = draw.between(-1, 1),
             .weight = {30, 70, -60, -40},
             .model = other() ? compare::BendingModel::isometric_quadratic : compare::BendingModel::discrete_hinge});
      }
      check_against_alone<3>(kernels.of<TriangleKind>(), membranes, triangles, alone<3>());
      check_against_alone<4>(kernels.of<HingeKind>(), hinges, folds, alone<4>());
    }
  }
}

TEST_CASE("contacts side by side have the derivatives of each alone, to the bit, for every form and stage",
          "[property]") {
  Draw draw(12);
  const double r = 5e-3;
  for (const MachineKernels& kernels : kernels_of_this_machine())
    for (int round = 0; round < 60; ++round) {
      std::vector<PlacedContact> points, lines, planes;
      std::vector<Corners<2>> of_2;
      std::vector<Corners<3>> of_3;
      std::vector<Corners<4>> of_4;
      for (std::size_t i = 0; i < batch_width; ++i) {
        const auto kind = [&](FormKind form) {
          ContactTerm term{compare::ContactSides::point_point,
                           {},
                           r,
                           10,
                           draw.between(0.1, 1),
                           0,
                           static_cast<compare::ContactActivation>(round % 5)};
          return PlacedContact{term, {}, form};
        };
        points.push_back(kind(FormKind::points));
        lines.push_back(kind(FormKind::point_line));
        planes.push_back(kind(i % 2 != 0 && round % 2 != 0 ? FormKind::lines : FormKind::point_plane));
        // Distances lie on both sides of r/2, and some beyond r.
        Corners<4> x{{{0.1 * r, 0.2 * r, 0}, {0, 0, 0}, {r, 0.2 * r, 0}, {0.3 * r, r, 0}}};
        for (auto& p : x)
          for (double& c : p) c += draw.between(-0.05 * r, 0.05 * r);
        x[0][2] += draw.between(0.1, 1.05) * r;
        of_2.push_back({x[0], x[1]});
        of_3.push_back({x[0], x[1], x[2]});
        of_4.push_back(x);
      }
      check_against_alone<2>(kernels.contacts_of_2, points, of_2, alone<2>());
      check_against_alone<3>(kernels.contacts_of_3, lines, of_3, alone<3>());
      check_against_alone<4>(kernels.contacts_of_4, planes, of_4, alone<4>());
    }
}

/// If an energy depends only on one weighted sum Σ w x of positions, kernels differentiate it by this sum. Three
/// variables replace nine, and derivatives agree up to roundings. The Hessian by all vertices has the eigenvalues of
/// the Hessian by the sum, times ‖w‖². So projections agree, too. The limit of 10⁻¹³ of the largest entry is about a
/// thousand roundings of 10⁻¹⁶.
TEST_CASE("what depends on one weighted sum has the derivatives of the energy over all vertices, side by side or alone",
          "[property]") {
  Draw draw(13);
  const double r = 5e-3;
  for (const MachineKernels& kernels : kernels_of_this_machine())
    for (int round = 0; round < 30; ++round) {
      std::vector<FrictionTerm> frictions;
      std::vector<PlacedContact> contacts;
      std::vector<SpringTerm> springs;
      std::vector<Corners<4>> corners;
      for (std::size_t i = 0; i < batch_width; ++i) {
        Corners<4> x{{{0.1 * r, 0, 0.4 * r}, {r, 0, 0.5 * r}, {0.2 * r, 0, 0}, {1.2 * r, 0, 0}}};
        for (auto& p : x)
          for (double& c : p) c += draw.between(-0.05 * r, 0.05 * r);
        const double s = draw.between(0, 1), t = draw.between(0, 1);
        const std::array<double, 4> weight{1 - s, s, t - 1, -t};
        const Triple<double> apart = separation(weight, x);
        const double slip = i % 3 == 0 ? 0 : i % 3 == 1 ? 5e-5 : 1e-3;
        frictions.push_back({compare::ContactSides::edge_edge,
                             {},
                             weight,
                             {0, 0.6, 0.8},
                             apart - Triple<double>{slip, 0, 0},
                             0.01,
                             1e-4});
        contacts.push_back({{compare::ContactSides::edge_edge, {}, 2 * r, 10, 1, 0, compare::ContactActivation::ogc},
                            weight,
                            FormKind::fixed_weights});
        springs.push_back({{}, {1, s - 1, -s, 0}, 10, i % 2 == 0 ? 0 : 0.3 * r, i % 3 == 0 ? 0 : 0.2, 0.5 * r});
        corners.push_back(x);
      }
      const auto nearly = [](const StencilDerivatives& a, const StencilDerivatives& b) {
        double largest = 0, difference = 0;
        for (std::size_t i = 0; i < 144; ++i) {
          largest = std::max(largest, std::abs(b.hessian[i]));
          difference = std::max(difference, std::abs(a.hessian[i] - b.hessian[i]));
        }
        CHECK(difference <= 1e-13 * largest);
        CHECK(a.energy == Approx(b.energy).epsilon(1e-13).margin(1e-300));
      };
      for (const auto projection : {HessianProjection::none, HessianProjection::clamp, HessianProjection::absolute}) {
        const auto rubbed = differentiated<4>(kernels.frictions, frictions, corners, projection);
        const auto pushed = differentiated<4>(kernels.weighted_contacts, contacts, corners, projection);
        const auto pulled = differentiated<4>(kernels.of<SpringKind>(), springs, corners, projection);
        for (std::size_t i = 0; i < batch_width; ++i) {
          nearly(rubbed[i], alone<4>()(frictions[i], corners[i], projection));
          const auto over_weights = [&](const auto& x) {
            return contacts[i].energy_between(separation(contacts[i].weight, x));
          };
          nearly(pulled[i], alone<4>()(springs[i], corners[i], projection));
          CHECK(same_bits(pulled[i],
                          differentiated<4>(kernels.of<SpringKind>(), {springs[i]}, {corners[i]}, projection)[0]));
          nearly(pushed[i], stencil_derivatives<4>(corners[i], projection, over_weights));
          CHECK(
              same_bits(rubbed[i], differentiated<4>(kernels.frictions, {frictions[i]}, {corners[i]}, projection)[0]));
          CHECK(same_bits(pushed[i],
                          differentiated<4>(kernels.weighted_contacts, {contacts[i]}, {corners[i]}, projection)[0]));
        }
      }
    }
}

TEST_CASE(
    "projection side by side agrees with Eigen's decomposition within the roundings of both, and with each matrix "
    "alone to the bit",
    "[property]") {
  check_projection<3>();
  check_projection<6>();
  check_projection<9>();
}

TEST_CASE("projection: what has no negative eigenvalue stays as it is, to the bit; 0 and what is no number end as well",
          "[unit]") {
  Draw draw(14);
  constexpr std::size_t packs = batch_width / pack_width;
  std::vector<Matrix<9>> matrices;
  for (std::size_t lane = 0; lane < batch_width; ++lane) {
    std::array<double, 9> values;
    for (double& value : values) value = draw.between(0.1, 2);
    matrices.push_back(with_eigenvalues<9>(draw, values));
  }
  matrices[1].setZero();
  matrices[2](4, 4) = -1;
  matrices[3].setConstant(std::numeric_limits<double>::quiet_NaN());
  matrices[4](0, 0) = std::numeric_limits<double>::infinity();
  auto h = in_lanes<9, packs>(matrices);
  project<9, packs>(h, false);
  for (const std::size_t lane : {0, 1, 5, 6, 7}) CHECK(lane_of<9, packs>(h, lane) == matrices[lane]);
  CHECK(lane_of<9, packs>(h, 2)(4, 4) > -1e-14);
}
