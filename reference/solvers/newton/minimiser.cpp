#include "reference/solvers/newton/minimiser.hpp"

#include <cmath>
#include <utility>

#include "reference/solvers/newton/condition.hpp"
#include "reference/solvers/newton/line_search.hpp"

namespace ogc::reference {
namespace {

constexpr int most_iterations = 200;
/// Share of Lanczos' eigenvalue that a factorisation is asked to confirm; its own error is a part in 2²⁰.
constexpr double confirmed_share = 1 - 0x1p-10;

State single(std::span<const compare::Vec3f> x) { return widened({x.begin(), x.end()}); }

}  // namespace

class Minimiser::Problem {
 public:
  explicit Problem(const compare::SweepIn& in)
      : potential_(*in.scene, *in.topology), matrix_(potential_.mobility()), target_(single(in.target)) {
    potential_.begin_step(single(in.start), target_);
    const auto facets = in.vertex_facet;
    const auto edges = in.edge_edge;
    const auto volumes = in.volumes;
    potential_.set_contacts(
        {{facets.begin(), facets.end()}, {edges.begin(), edges.end()}, {volumes.begin(), volumes.end()}},
        single(in.previous));
  }

  void lag_friction(const State& x) {
    potential_.lag_friction(x);
    has_pattern_ = false;
  }

  Minimum minimum(State x) {
    for (std::size_t v = 0; v < x.size(); ++v)
      if (potential_.mobility()[v] == Mobility::prescribed) x[v] = target_[v];
    Minimum result;
    for (int iteration = 0; iteration <= most_iterations; ++iteration) {
      derive(x, HessianProjection::none);
      result.forces.push_back(gradient().mean);
      result.converged = result.forces.back() <= derivatives_.force_noise;
      if (result.converged || iteration == most_iterations || !advance(x)) break;
    }
    result.position = std::move(x);
    return result;
  }

  Gradient gradient_at(const State& x) {
    derive(x, HessianProjection::none);
    return gradient();
  }

  double energy_above(const State& x, const State& y) const {
    return Potential::change(potential_.terms(y), potential_.terms(x));
  }

  std::optional<double> smallest_eigenvalue(const State& x) {
    derive(x, HessianProjection::none);
    if (!factorized(0)) return {};
    double least = confirmed_share * reference::smallest_eigenvalue(matrix_, factor_);
    // Lanczos may have found another eigenvalue than the smallest.
    while (least > 0 && !factorized(least)) least /= 2;
    return least > 0 ? std::optional(least) : std::nullopt;
  }

 private:
  void derive(const State& x, HessianProjection projection) {
    derivatives_ = potential_.derivatives(x, projection, std::move(derivatives_));
  }

  Gradient gradient() const {
    Gradient sum;
    for (const Triple<double>& g : derivatives_.gradient) {
      const double length = std::hypot(g[0], g[1], g[2]);
      sum.mean += length;
      sum.norm += length * length;
    }
    const std::size_t free = potential_.free_count();
    return {std::sqrt(sum.norm), free > 0 ? sum.mean / static_cast<double>(free) : 0};
  }

  /// Factorises H − shift I at the state of the derivatives. False where it is not positive definite.
  bool factorized(double shift) {
    if (!std::exchange(has_pattern_, true) && matrix_.set_stencils(potential_.vertices(), potential_.elastic_count()))
      factor_.analyze(matrix_);
    std::vector<double> diagonal = potential_.inertias();
    for (double& entry : diagonal) entry -= shift;
    matrix_.assemble(diagonal, derivatives_.stencil);
    return factor_.factorize(matrix_);
  }

  State direction(std::size_t vertices) {
    std::vector<double> right;
    for (const std::size_t v : matrix_.free_vertices())
      for (const double g : derivatives_.gradient[v]) right.push_back(-g);
    const std::vector<double> solution = factor_.solve(right);
    State delta(vertices);
    for (std::size_t i = 0; i < matrix_.free_vertices().size(); ++i)
      delta[matrix_.free_vertices()[i]] = {solution[3 * i], solution[3 * i + 1], solution[3 * i + 2]};
    return delta;
  }

  /// One iteration, with stencils projected where the matrix is not positive definite without it; false where no step
  /// lowers the energy.
  bool advance(State& x) {
    if (!factorized(0)) {
      derive(x, HessianProjection::clamp);
      if (!factorized(0)) return false;
    }
    const PotentialTerms before = potential_.terms(x);
    const double noise = derivatives_.energy_noise + value_noise(before);
    Accepted step = backtracked(potential_, x, direction(x.size()), 1, before, noise);
    if (step.share == 0) return false;
    x = std::move(step.x);
    return true;
  }

  Potential potential_;
  BlockMatrix matrix_;
  State target_;
  Factor factor_;
  PotentialDerivatives derivatives_;  ///< of the last state that was asked about
  bool has_pattern_ = false;          ///< the matrix's is that of the present stencils
};

Minimiser::Minimiser(const compare::SweepIn& in) : problem_(std::make_unique<Problem>(in)) {}
Minimiser::~Minimiser() = default;

void Minimiser::lag_friction(const Positions& x) { problem_->lag_friction(x); }
Minimum Minimiser::minimum(const Positions& from) { return problem_->minimum(from); }
Gradient Minimiser::gradient(const Positions& x) { return problem_->gradient_at(x); }
double Minimiser::energy_above(const Positions& x, const Positions& y) const { return problem_->energy_above(x, y); }
std::optional<double> Minimiser::smallest_eigenvalue(const Positions& x) { return problem_->smallest_eigenvalue(x); }

}  // namespace ogc::reference
