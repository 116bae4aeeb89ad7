// Every scene of the paper that exists so far, each in three scales.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

enum class Scale { smoke, small, paper };

struct SceneInfo {
  std::string_view name, figure, summary;
  compare::Scene (*generate)(Scale);
};

/// In order of name.
std::span<const SceneInfo> scenes();

/// Generates a scene, rounded to single precision. Throws compare::InputError that lists the known names.
compare::Scene make_scene(std::string_view name, Scale scale);

/// "smoke", "small", "paper"; throws compare::InputError.
Scale parse_scale(std::string_view text);

}  // namespace ogc::experiments
