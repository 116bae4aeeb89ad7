// Builds the grid of an ablation: the settings that differ, and the points that are run.
#pragma once

#include <string>
#include <vector>

namespace ogc::experiments {

/// Holds one axis of the grid.
struct Axis {
  std::string key;                  ///< a setting, or solver, or backend
  std::vector<std::string> values;  ///< the values of --vary; empty if points are listed
};

/// A point of the grid: a value for each axis; an empty one keeps the value of the scene.
using Point = std::vector<std::string>;

/// Holds the whole grid.
struct AblationGrid {
  std::vector<Axis> axes;     ///< the axes of listed points, then the varied ones
  std::vector<Point> points;  ///< with the last axis varying fastest
};

/// Returns each point of `listed` (texts of --point, `key=a,other=b` or `default`) combined with all values of `varied`
/// (texts of --vary, `key=a,b,c`). Throws compare::InputError that shows the text and its form if it is malformed, or
/// if a key, value or point occurs twice.
AblationGrid ablation_grid(const std::vector<std::string>& listed, const std::vector<std::string>& varied);

/// Returns the name of a point, which folders have, too: "key=a,other=b", or "default" if all values are the scene's.
std::string name_of(const std::vector<Axis>& axes, const Point& point);

}  // namespace ogc::experiments
