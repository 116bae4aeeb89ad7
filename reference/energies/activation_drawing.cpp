#include "reference/energies/activation_drawing.hpp"

#include "reference/energies/contact_activation.hpp"
#include "reference/energies/second.hpp"

namespace ogc::reference {

std::vector<DrawingPanel> activation_drawing() {
  constexpr std::array names{"ogc", "ogc_as_printed", "quadratic", "ipc_log", "cubic"};
  constexpr int count = 440;  // a point every r/400
  DrawingPanel panel{"force", "force over distance, r = 1 m, k_c = 1 N/m", {}};
  for (std::size_t kind = 0; kind < names.size(); ++kind) {
    DrawingLayer& layer = panel.layers.emplace_back();
    layer.name = names[kind];
    std::vector<int> line;
    for (int i = 1; i <= count; ++i) {
      Second<1> distance(i / 400.0);
      distance.slope[0] = 1;
      const Second<1> energy = contact_activation(static_cast<compare::ContactActivation>(kind), distance, 1.0, 1.0);
      line.push_back(i - 1);
      layer.points.push_back({distance.value, 0 - energy.slope[0], 0});
      layer.values.push_back(energy.bend(0));
    }
    layer.lines = {line};
  }
  return {panel};
}

}  // namespace ogc::reference
