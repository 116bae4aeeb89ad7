// Registers every built-in scene at three scales.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Scales: a run takes seconds; it takes minutes on two cores; it has the paper's sizes.
enum class Scale { smoke, small, paper };

/// Holds one row of the registry.
struct SceneInfo {
  std::string_view name, figure, summary;  ///< "twist"; the figure of the paper; one line
  compare::Scene (*generate)(Scale);       ///< makes the scene
  /// makes the scene from a published data set in this folder; null if there is none
  compare::Scene (*generate_of)(Scale, const std::filesystem::path&) = nullptr;
};

/// Returns all rows, ordered by name.
std::span<const SceneInfo> scenes();

/// Generates a scene, rounded to single precision; with `data` from the data set in that folder. Throws
/// compare::InputError that lists the known names, or describes what is wrong with the data, or says that the scene has
/// none.
compare::Scene make_scene(std::string_view name, Scale scale, const std::filesystem::path& data = {});

/// Parses "smoke", "small" or "paper"; throws compare::InputError for other texts.
Scale parse_scale(std::string_view text);

}  // namespace ogc::experiments
