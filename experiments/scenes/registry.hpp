// Registers every built-in scene at three scales.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Scales: a run at `smoke` takes seconds, a run at `small` takes minutes on two cores, and `paper` has the paper's
/// sizes.
enum class Scale { smoke, small, paper };

/// Describes one scene.
struct SceneInfo {
  std::string_view name, figure, summary;  ///< name such as "twist", figure of the paper, summary of one line
  compare::Scene (*generate)(Scale);       ///< generates the scene
  /// generates the scene from a published data set in this folder; null if there is none
  compare::Scene (*generate_of)(Scale, const std::filesystem::path&) = nullptr;
};

/// Returns all scenes, ordered by name.
std::span<const SceneInfo> scenes();

/// Generates a scene, rounded to single precision. If `data` is not empty, uses the data set in that folder. Throws
/// compare::InputError if the name is unknown (and lists the known ones), if the data are wrong, or if the scene has no
/// data set.
compare::Scene make_scene(std::string_view name, Scale scale, const std::filesystem::path& data = {});

/// Parses "smoke", "small" or "paper"; throws compare::InputError for other texts.
Scale parse_scale(std::string_view text);

}  // namespace ogc::experiments
