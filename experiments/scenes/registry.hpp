// Every scene of the paper that exists so far, each in three scales.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Seconds, minutes on two cores, the paper's sizes.
enum class Scale { smoke, small, paper };

/// One row of the registry.
struct SceneInfo {
  std::string_view name, figure, summary;  ///< "twist"; where the paper shows it; one line
  compare::Scene (*generate)(Scale);       ///< makes the scene
  /// the same of a published data set in this folder, where there is one
  compare::Scene (*generate_of)(Scale, const std::filesystem::path&) = nullptr;
};

/// In order of name.
std::span<const SceneInfo> scenes();

/// Generates a scene, of a data set where `data` names its folder, rounded to single precision. Throws
/// compare::InputError that lists the known names, or says what is wrong with the data, or that the scene has none.
compare::Scene make_scene(std::string_view name, Scale scale, const std::filesystem::path& data = {});

/// "smoke", "small", "paper"; throws compare::InputError.
Scale parse_scale(std::string_view text);

}  // namespace ogc::experiments
