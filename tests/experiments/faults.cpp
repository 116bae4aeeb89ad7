#include "tests/compare/judge/faults.hpp"

#include <cmath>

#include "compare/judge/exact_sum.hpp"

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
  while (!obeys(x, previous, bound)) x = {std::nextafter(x.x, previous.x), std::nextafter(x.y, previous.y), std::nextafter(x.z, previous.z)};
  return x;
}

std::vector<float> rounded(const std::vector<double>& values) { return {values.begin(), values.end()}; }

ForceOut rounded(const ForceTruth& truth) {
  ForceOut out;
  for (const auto& accepted : truth.accepted) {
    const ForceAnswer& exact = accepted[0];
    out.force.push_back({static_cast<float>(exact.force.x), static_cast<float>(exact.force.y), static_cast<float>(exact.force.z)});
    std::array<float, 6> block{};
    for (std::size_t k = 0; k < block.size(); ++k) block[k] = static_cast<float>(exact.block[k]);
    out.block.push_back(block);
  }
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
  exact.membrane = [authority](const MembraneIn& in) { return rounded(authority.membrane(in)); };
  exact.bending = [authority](const BendingIn& in) { return rounded(authority.bending(in)); };
  return exact;
}

std::vector<Fault> faults() {
  std::vector<Fault> all = pair_faults();
  for (const auto& more : {set_faults(), scalar_faults(), force_faults()}) all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace ogc::tests
