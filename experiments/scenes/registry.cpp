// The one place that knows which sizes a scale means.
#include "experiments/scenes/registry.hpp"

#include <array>
#include <vector>

#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "experiments/scenes/cloth_on_sphere.hpp"
#include "experiments/scenes/twist.hpp"

namespace ogc::experiments {
namespace {

compare::Scene cloth_on_sphere_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return cloth_on_sphere({.vertices_a_side = 16, .sphere_subdivisions = 2, .steps = 30});
    case Scale::small: return cloth_on_sphere({.vertices_a_side = 40, .sphere_subdivisions = 3, .steps = 80});
    case Scale::paper: break;
  }
  return cloth_on_sphere();
}

compare::Scene twist_at(Scale scale) {
  switch (scale) {
    case Scale::smoke: return twist({.vertices_a_side = 20, .steps = 150});
    case Scale::small: return twist({.vertices_a_side = 40, .steps = 2400});
    case Scale::paper: break;
  }
  return twist();
}

constexpr std::array<SceneInfo, 2> table{{
    {"cloth_on_sphere", "Fig. 18", "a square cloth falls off-centre onto a fixed sphere", cloth_on_sphere_at},
    {"twist", "Fig. 12", "a square cloth twisted by its two ends until it coils", twist_at},
}};

constexpr std::array<std::string_view, 3> scale_names{"smoke", "small", "paper"};

}  // namespace

std::span<const SceneInfo> scenes() { return table; }

compare::Scene make_scene(std::string_view name, Scale scale) {
  std::vector<std::string_view> names;
  for (const SceneInfo& info : table) {
    names.push_back(info.name);
    if (info.name != name) continue;
    compare::Scene scene = info.generate(scale);
    compare::round_to_single(scene);
    return scene;
  }
  std::string message = compare::unknown_name("scene", name, names) + " Known scenes:";
  for (const std::string_view known : names) message += " " + std::string(known);
  throw compare::InputError(message + "; or name a scene file (.json)");
}

Scale parse_scale(std::string_view text) {
  for (std::size_t i = 0; i < scale_names.size(); ++i) {
    if (scale_names[i] == text) return static_cast<Scale>(i);
  }
  throw compare::InputError(compare::unknown_name("scale", text, scale_names) + " Give smoke, small or paper");
}

}  // namespace ogc::experiments
