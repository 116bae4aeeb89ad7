#include "reference/solvers/newton/matrix.hpp"

#include <cmath>
#include <random>

#include <Eigen/Dense>

#include "reference/solvers/feasible_regions.hpp"
#include "reference/solvers/newton/condition.hpp"
#include "tests/catch.hpp"
#include "tests/reference/solvers/sheets.hpp"

using namespace ogc;
using namespace ogc::reference;
using namespace ogc::tests;
using reference::HessianProjection;

namespace {

/// Two sheets in contact, one corner prescribed.
struct Pressed {
  compare::Scene scene;
  compare::Topology topology;
  std::vector<compare::Index> groups;
  State x;
  Pressed() {
    add_sheet(scene, 4, 0.03, 2e-3, false);
    add_sheet(scene, 3, 0.035, 0, true);
    compare::PrescribedMotion motion;
    motion.name = "corner";
    motion.vertices = {0};
    scene.motions = {motion};
    std::mt19937 engine(7);
    std::uniform_real_distribution<double> noise(-2e-4, 2e-4);
    for (compare::Vec3& p : scene.mesh.positions) p.x += noise(engine), p.y += noise(engine), p.z += noise(engine);
    round_to_single(scene);
    topology = build_topology(scene);
    groups = rigid_groups(scene);
    x = widened(compare::to_single(scene.mesh.positions));
  }
};

Eigen::MatrixXd dense_sum(const Potential& potential, const PotentialDerivatives& derivatives,
                          const BlockMatrix& matrix) {
  const auto size = static_cast<Eigen::Index>(matrix.rows());
  std::vector<Eigen::Index> number(potential.mobility().size(), -1);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t i = 0; i < matrix.free_vertices().size(); ++i) {
    number[matrix.free_vertices()[i]] = static_cast<Eigen::Index>(3 * i);
    for (Eigen::Index k = 0; k < 3; ++k)
      sum(static_cast<Eigen::Index>(3 * i) + k,
          static_cast<Eigen::Index>(3 * i) + k) = potential.inertia(matrix.free_vertices()[i]);
  }
  for (std::size_t s = 0; s < potential.stencil_count(); ++s) {
    const auto vertex = potential.vertices(s);
    for (std::size_t i = 0; i < 12; ++i)
      for (std::size_t j = 0; j < 12; ++j) {
        if (vertex[i / 3] < 0 || vertex[j / 3] < 0) continue;
        const Eigen::Index row = number[static_cast<std::size_t>(vertex[i / 3])],
                           column = number[static_cast<std::size_t>(vertex[j / 3])];
        if (row >= 0 && column >= 0)
          sum(row + static_cast<Eigen::Index>(i % 3),
              column + static_cast<Eigen::Index>(j % 3)) += derivatives.stencil[s].hessian[12 * i + j];
      }
  }
  return sum;
}

}  // namespace

TEST_CASE("the sparse matrix is the sum of the stencils; its solve and condition number are those of the dense matrix",
          "[property]") {
  const Pressed pressed;
  Potential potential(pressed.scene, pressed.topology);
  potential.begin_step(pressed.x, pressed.x);
  const Detected detected = detect(pressed.scene, pressed.topology, pressed.groups,
                                   compare::to_single(pressed.scene.mesh.positions), 6e-3f);
  potential.set_contacts(detected.sets, pressed.x);
  potential.lag_friction(pressed.x);
  REQUIRE(potential.stencil_count() > 40);
  BlockMatrix matrix(potential.mobility());
  CHECK(matrix.rows() == 45);
  CHECK(matrix.set_stencils(potential.vertices()));
  CHECK(!matrix.set_stencils(potential.vertices()));
  const PotentialDerivatives derivatives = potential.derivatives(pressed.x, HessianProjection::clamp);
  matrix.assemble(potential.inertias(), derivatives.stencil);
  const Eigen::MatrixXd dense = dense_sum(potential, derivatives, matrix);
  std::vector<double> unit(matrix.rows(), 0);
  for (std::size_t c = 0; c < matrix.rows(); ++c) {
    unit[c] = 1;
    const std::vector<double> column = matrix.times(unit);
    unit[c] = 0;
    for (std::size_t r = 0; r < matrix.rows(); ++r)
      CHECK(column[r] == Approx(dense(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)))
                             .epsilon(1e-12)
                             .margin(1e-12 * dense.norm()));
  }
  Factor factor;
  factor.analyze(matrix);
  REQUIRE(factor.factorize(matrix));
  const std::vector<double> ones(matrix.rows(), 1), solved = matrix.times(factor.solve(ones));
  for (const double b : solved) CHECK(b == Approx(1).epsilon(1e-9));
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
  CHECK(condition_number(matrix, factor) == Approx(values.maxCoeff() / values.minCoeff()).epsilon(1e-5));
}

TEST_CASE("condition numbers without friction and without contact are those of the potentials that lack them",
          "[property]") {
  const Pressed pressed;
  Potential potential(pressed.scene, pressed.topology);
  potential.begin_step(pressed.x, pressed.x);
  const Detected detected = detect(pressed.scene, pressed.topology, pressed.groups,
                                   compare::to_single(pressed.scene.mesh.positions), 6e-3f);
  const BlockMatrix rows(potential.mobility());
  const auto condition = [&](HessianProjection projection) {
    const Eigen::MatrixXd dense = dense_sum(potential, potential.derivatives(pressed.x, projection), rows);
    const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense).eigenvalues();
    return values.minCoeff() > 0 ? values.maxCoeff() / values.minCoeff() : 0;
  };
  const auto wanted = [&] {
    const double plain = condition(HessianProjection::none);
    return plain > 0 ? plain : condition(HessianProjection::clamp);
  };
  const double elastic = wanted();
  potential.set_contacts(detected.sets, pressed.x);
  const double with_contact = wanted();
  potential.lag_friction(pressed.x);
  const double all = wanted();
  CHECK(std::abs(with_contact - all) > 1e-3 * all);
  CHECK(std::abs(with_contact - elastic) > 1e-3 * elastic);
  const PotentialDerivatives derivatives = potential.derivatives(pressed.x, HessianProjection::none);
  const PotentialDerivatives projected = potential.derivatives(pressed.x, HessianProjection::clamp);
  const auto first = [&](std::size_t count) { return condition_of_first(potential, count, derivatives, projected); };
  CHECK(first(potential.stencil_count()) == Approx(all).epsilon(1e-5));
  CHECK(first(potential.elastic_count() + potential.contacts().size()) == Approx(with_contact).epsilon(1e-5));
  CHECK(first(potential.elastic_count()) == Approx(elastic).epsilon(1e-5));
}

TEST_CASE("a matrix that keeps the order of its steady stencils has the bits of one that sorts all of them",
          "[property]") {
  const Pressed pressed;
  Potential potential(pressed.scene, pressed.topology);
  potential.begin_step(pressed.x, pressed.x);
  BlockMatrix kept(potential.mobility());
  const Detected detected = detect(pressed.scene, pressed.topology, pressed.groups,
                                   compare::to_single(pressed.scene.mesh.positions), 6e-3f);
  REQUIRE(detected.sets.vertex_facet.size() > 3);
  PotentialDerivatives derivatives;
  for (const bool touching : {true, false, true}) {
    potential.set_contacts(touching ? detected.sets : ContactSets{}, pressed.x);
    derivatives = potential.derivatives(pressed.x, HessianProjection::clamp, std::move(derivatives));
    BlockMatrix fresh(potential.mobility());
    fresh.set_stencils(potential.vertices());
    kept.set_stencils(potential.vertices(), potential.elastic_count());
    for (BlockMatrix* matrix : {&fresh, &kept}) matrix->assemble(potential.inertias(), derivatives.stencil);
    const std::vector<double> ones(kept.rows(), 1);
    CHECK(kept.times(ones) == fresh.times(ones));  // the kept pattern may hold blocks of zeros
    CHECK(derivatives.stencil.size() == potential.stencil_count());
  }
}

TEST_CASE("the gradient of the potential is the slope of its energy along any direction", "[property]") {
  const Pressed pressed;
  Potential potential(pressed.scene, pressed.topology);
  State target = pressed.x;
  for (auto& p : target) p[1] -= 1e-3;
  potential.begin_step(pressed.x, target);
  const Detected detected = detect(pressed.scene, pressed.topology, pressed.groups,
                                   compare::to_single(pressed.scene.mesh.positions), 6e-3f);
  potential.set_contacts(detected.sets, pressed.x);
  potential.lag_friction(pressed.x);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> draw(-1, 1);
  for (int i = 0; i < 10; ++i) {
    const double step = 1e-8;
    State ahead = pressed.x, behind = pressed.x;
    State direction(pressed.x.size());
    for (std::size_t v = 0; v < direction.size(); ++v)
      if (potential.mobility()[v] == Mobility::free) direction[v] = {draw(engine), draw(engine), draw(engine)};
    for (std::size_t v = 0; v < direction.size(); ++v)
      ahead[v] = ahead[v] + step * direction[v], behind[v] = behind[v] - step * direction[v];
    double slope = 0;
    const PotentialDerivatives derivatives = potential.derivatives(pressed.x, HessianProjection::none);
    for (std::size_t v = 0; v < direction.size(); ++v) slope += dot(derivatives.gradient[v], direction[v]);
    CHECK(Potential::change(potential.terms(behind), potential.terms(ahead)) / (2 * step) ==
          Approx(slope).epsilon(1e-4));
  }
}

TEST_CASE("what lies in a ball is within its bound after rounding, too", "[property]") {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> draw(-1, 1);
  Detected detected;
  for (int i = 0; i < 3000; ++i) {
    detected.previous.push_back(
        {static_cast<float>(draw(engine)), static_cast<float>(draw(engine)), static_cast<float>(100 * draw(engine))});
    detected.bound.push_back(static_cast<float>(std::pow(10, -8 + 6 * std::abs(draw(engine)))));
  }
  const FeasibleRegions regions(detected, compare::Bounds::ball);
  State x, scaled;
  for (std::size_t v = 0; v < detected.bound.size(); ++v) {
    const Triple<double> centre{detected.previous[v].x, detected.previous[v].y, detected.previous[v].z};
    const Triple<double> step = 2 * double{detected.bound[v]} *
                                Triple<double>{draw(engine), draw(engine), draw(engine)};
    const FeasibleRegions::Inside inside = regions.inside(v, centre, centre + step);
    x.push_back(inside.x);
    scaled.push_back(centre + regions.share_inside(v, centre, step) * step);
  }
  for (const std::vector<compare::Vec3f>& stored : {rounded(x), rounded(scaled)})
    for (std::size_t v = 0; v < stored.size(); ++v) {
      const compare::Vec3f &to = stored[v], &from = detected.previous[v];
      const Triple<double> moved{double{to.x} - from.x, double{to.y} - from.y, double{to.z} - from.z};
      CHECK(dot(moved, moved) <= double{detected.bound[v]} * detected.bound[v]);
    }
}
