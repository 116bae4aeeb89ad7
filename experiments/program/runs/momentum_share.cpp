#include "experiments/program/runs/momentum_share.hpp"

#include <cmath>

#include "compare/stages/rest_state.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

namespace {

double length(const compare::Vec3& a) { return std::hypot(a.x, a.y, a.z); }

}  // namespace

MomentumShare::MomentumShare(const compare::Scene& scene)
    : step_(scene.settings.time_step), guess_rounds_(scene.settings.guess_rounds) {
  const compare::Topology topology = build_topology(scene);
  const std::vector<float> mass = fast::contestant(fast::Backend::cpu).rest_state({&scene, &topology}).mass;
  const std::vector<compare::Index> groups = rigid_groups(scene);
  for (std::size_t v = 0; v < mass.size(); ++v) mass_.push_back(groups[v] < 0 ? double{mass[v]} : 0);
  fall_ = {step_ * step_ * scene.gravity.x, step_ * step_ * scene.gravity.y, step_ * step_ * scene.gravity.z};
}

void MomentumShare::begin_after(std::int64_t step, const std::vector<compare::Vec3f>& velocities) {
  compare::Vec3 sum{0, 0, 0};
  double moduli = 0;
  for (std::size_t v = 0; v < mass_.size(); ++v) {
    const compare::Vec3f& u = velocities[v];
    const compare::Vec3 moved{mass_[v] * (step_ * u.x + fall_.x), mass_[v] * (step_ * u.y + fall_.y),
                              mass_[v] * (step_ * u.z + fall_.z)};
    sum = {sum.x + moved.x, sum.y + moved.y, sum.z + moved.z};
    moduli += length(moved);
  }
  net_[step + 1] = moduli > 0 ? length(sum) / moduli : 0;
}

std::optional<double> MomentumShare::lost(const compare::StepMetrics& row) const {
  const auto net = net_.find(row.step);
  if (net == net_.end() || row.guess_rounds < guess_rounds_) return std::nullopt;
  return row.momentum_lost_guess * net->second;
}

}  // namespace ogc::experiments
