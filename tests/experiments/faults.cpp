#include "tests/compare/judge/faults.hpp"

#include <cmath>

#include "compare/judge/exact_sum.hpp"
#include "compare/judge/verdict.hpp"
#include "reference/solvers/step.hpp"
#include "reference/solvers/sweep.hpp"

namespace ogc::tests {

using namespace compare;

namespace {

bool obeys(const Vec3f& x, const Vec3f& p, float b) {
  ExactSum margin;
  for (const auto [a, c] : {std::array{x.x, p.x}, std::array{x.y, p.y}, std::array{x.z, p.z}}) {
    margin.add_product(a, a);
    margin.add_product(-2.0 * a, c);
    margin.add_product(c, c);
  }
  margin.add_product(-double{b}, b);
  return margin.sign() <= 0;
}

/// The exact position rounded, then stepped towards the previous one until the bound holds.
Vec3f stored(const Vec3& exact, const Vec3f& previous, float bound) {
  Vec3f x{static_cast<float>(exact.x), static_cast<float>(exact.y), static_cast<float>(exact.z)};
  while (!obeys(x, previous, bound))
    x = {std::nextafter(x.x, previous.x), std::nextafter(x.y, previous.y), std::nextafter(x.z, previous.z)};
  return x;
}

std::vector<float> rounded(const std::vector<double>& values) { return {values.begin(), values.end()}; }

ForceOut rounded(const ForceTruth& truth) {
  ForceOut out;
  for (const auto& accepted : truth.accepted) {
    const ForceAnswer& exact = accepted[0];
    out.force.push_back(
        {static_cast<float>(exact.force.x), static_cast<float>(exact.force.y), static_cast<float>(exact.force.z)});
    std::array<float, 6> block{};
    for (std::size_t k = 0; k < block.size(); ++k) block[k] = static_cast<float>(exact.block[k]);
    out.block.push_back(block);
  }
  return out;
}

/// The exact targets rounded; position and cut are those of the rounded ones.
InitialGuessOut exact_guess(const InitialGuessIn& in, const InitialGuessTruth& truth,
                            const std::function<TruncateOut(const TruncateIn&)>& truncate) {
  InitialGuessOut out;
  for (const Vec3& y : truth.target)
    out.target.push_back({static_cast<float>(y.x), static_cast<float>(y.y), static_cast<float>(y.z)});
  TruncateOut cut = truncate(cut_question(in, out));
  for (std::size_t i = 0; i < in.cases.size(); ++i) {
    if (!in.cases[i].held) continue;
    cut.position[i] = in.cases[i].previous;
    cut.exceeded[i] = 0;
  }
  out.position = std::move(cut.position);
  out.cut = std::move(cut.exceeded);
  return out;
}

}  // namespace

Contestant exact_contestant(const Authority& authority) {
  Contestant exact;
  exact.name = "exact";
  exact.closest_face = [authority](const ClosestFaceIn& in) { return authority.closest_face(in).exact; };
  exact.closest_points = [authority](const ClosestPointsIn& in) { return authority.closest_points(in).exact; };
  exact.detect_vertex_facet = [authority](const DetectIn& in) { return authority.detect_vertex_facet(in).exact; };
  exact.detect_edge_edge = [authority](const DetectIn& in) { return authority.detect_edge_edge(in).exact; };
  exact.bound = [authority](const BoundIn& in) { return authority.bound(in).exact; };
  exact.activation = [authority](const ActivationIn& in) {
    const ActivationTruth truth = authority.activation(in);
    return ActivationOut{rounded(truth.energy), rounded(truth.slope), rounded(truth.curvature)};
  };
  exact.truncate = [authority](const TruncateIn& in) {
    const TruncateTruth truth = authority.truncate(in);
    TruncateOut out{in.position, truth.exceeded};
    for (std::size_t i = 0; i < in.position.size(); ++i)
      if (truth.exceeded[i]) out.position[i] = stored(truth.position[i], in.previous[i], in.bound[i]);
    return out;
  };
  exact.contact_force = [authority](const ContactForceIn& in) { return rounded(authority.contact_force(in)); };
  exact.friction_force = [authority](const FrictionForceIn& in) { return rounded(authority.friction_force(in)); };
  exact.rest_state = [authority](const RestStateIn& in) { return authority.rest_state(in).exact; };
  exact.block = [authority](const BlockIn& in) { return BlockOut{authority.block(in).inside}; };
  exact.initial_guess = [authority, truncate = exact.truncate](const InitialGuessIn& in) {
    return exact_guess(in, authority.initial_guess(in), truncate);
  };
  exact.membrane = [authority](const MembraneIn& in) { return rounded(authority.membrane(in)); };
  exact.bending = [authority](const BendingIn& in) { return rounded(authority.bending(in)); };
  exact.spring = [authority](const SpringIn& in) { return rounded(authority.spring(in)); };
  exact.sweep = [](const SweepIn& in) { return reference::reference_sweep(in, reference::SweepStencils(in)); };
  exact.step = reference::reference_step;
  return exact;
}

std::vector<Fault> faults() {
  std::vector<Fault> all = pair_faults();
  for (const auto& more :
       {set_faults(), scalar_faults(), contact_faults(), force_faults(), rest_faults(), step_faults(), sweep_faults()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace ogc::tests
