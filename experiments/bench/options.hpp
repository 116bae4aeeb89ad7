// Holds the options of `ogc bench`, and the scenes that it measures.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/contestant.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

/// Selects what `ogc bench` measures.
struct BenchOptions {
  std::vector<fast::Backend> backends;
  std::string scale = "small";
  std::int64_t steps = 16;          ///< steps of one repetition
  int repetitions = 4;              ///< repetitions of each benchmark in each process
  std::vector<std::string> states;  ///< frames of runs from which repetitions begin
  int worlds = 0;                   ///< worlds side by side; 0: none are measured
};

/// Holds a scene and the state from which its repetitions begin.
struct BenchScene {
  compare::Scene scene;                    ///< rounded to single precision
  std::optional<compare::Snapshot> start;  ///< empty: the scene's own start
};

/// Returns "cpu" or "cuda".
std::string name_of(fast::Backend backend);

/// Returns the scene of a run folder at one of its frames. Throws compare::InputError if it can't be read or does not
/// fit the scene.
BenchScene scene_at_frame(const std::string& frame);
/// Returns the frame's name in benchmarks: "twist@1200".
std::string frame_label(const std::string& frame);

}  // namespace ogc::experiments
