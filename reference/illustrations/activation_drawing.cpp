#include "reference/illustrations/activation_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "reference/energies/contact_activation.hpp"
#include "reference/energies/second.hpp"

namespace ogc::reference {

namespace {

using compare::ContactActivation;

Second<1> energy_at(ContactActivation kind, double distance, double stiffness) {
  Second<1> d(distance);
  d.slope[0] = 1;
  return contact_activation(kind, d, 1.0, stiffness);
}

double force_at(ContactActivation kind, double distance, double stiffness) {
  return 0 - energy_at(kind, distance, stiffness).slope[0];
}

/// Returns the distance at which the energy has this force. The force falls with the distance, so bisection finds the
/// distance; 64 halvings of the interval of ln d give a double to the last bit.
double distance_of(ContactActivation kind, double force, double stiffness) {
  double near = std::log(0x1p-100), far = 0;
  for (int halving = 0; halving < 64; ++halving) {
    const double middle = 0.5 * (near + far);
    (force_at(kind, std::exp(middle), stiffness) > force ? near : far) = middle;
  }
  return std::exp(0.5 * (near + far));
}

DrawingPanel ratio_panel() {
  constexpr int from = -4, to = 2, each = 60;  // forces from 10^from to 10^to, with `each` points per power of ten
  DrawingPanel panel{"ratio", "curvature of IPC's energy over that of OGC's at equal force", {}};
  for (const double ratio : stiffness_ratios) {
    DrawingLayer& layer = panel.layers.emplace_back();
    char name[24];
    std::snprintf(name, sizeof name, "%g", ratio);
    layer.name = name;
    std::vector<double> forces{0.02, 0.5};
    for (int i = from * each; i <= to * each; ++i) forces.push_back(std::pow(10.0, static_cast<double>(i) / each));
    std::ranges::sort(forces);
    for (const double force : forces) layer.points.push_back({force, curvature_ratio(force, ratio), 0});
  }
  return panel;
}

DrawingPanel force_panel() {
  constexpr std::array names{"ogc", "ogc_as_printed", "quadratic", "ipc_log", "cubic"};
  constexpr int count = 440;  // one point every r/400
  DrawingPanel panel{"force", "force over distance, r = 1 m, k_c = 1 N/m", {}};
  for (std::size_t kind = 0; kind < names.size(); ++kind) {
    DrawingLayer& layer = panel.layers.emplace_back();
    layer.name = names[kind];
    std::vector<int> line;
    for (int i = 1; i <= count; ++i) {
      const double distance = i / 400.0;
      const Second<1> energy = energy_at(static_cast<ContactActivation>(kind), distance, 1);
      line.push_back(i - 1);
      layer.points.push_back({distance, 0 - energy.slope[0], 0});
      layer.values.push_back(energy.bend(0));
    }
    layer.lines = {line};
  }
  return panel;
}

}  // namespace

double curvature_ratio(double force, double stiffness_ratio) {
  const auto curvature = [&](ContactActivation kind, double stiffness) {
    return energy_at(kind, distance_of(kind, force, stiffness), stiffness).bend(0);
  };
  return curvature(ContactActivation::ipc_log, stiffness_ratio) / curvature(ContactActivation::ogc, 1);
}

std::vector<DrawingPanel> activation_drawing() { return {force_panel(), ratio_panel()}; }

}  // namespace ogc::reference
