// What `ogc bench` measures, and of what.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

/// What `ogc bench` measures.
struct BenchOptions {
  std::vector<fast::Backend> backends;  ///< whose parts are measured
  std::string scale = "small";          ///< of the scenes
  std::int64_t steps = 16;              ///< of a window
  int repetitions = 4;                  ///< of each benchmark in a process
  std::vector<std::string> states;      ///< frames of runs
};

/// A scene and where its window begins.
struct BenchScene {
  compare::Scene scene;                    ///< rounded
  std::optional<compare::Snapshot> start;  ///< none: the scene's own
};

/// "cpu", "cuda".
std::string name_of(fast::Backend backend);

/// The scene of a run folder at one of its frames. Throws compare::InputError.
BenchScene scene_at_frame(const std::string& frame);
/// As benchmarks are called: "twist@1200".
std::string frame_label(const std::string& frame);

}  // namespace ogc::experiments
