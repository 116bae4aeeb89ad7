// Builds the grid of an ablation: the settings that vary, and the points to run.
#pragma once

#include <string>
#include <vector>

namespace ogc::experiments {

/// Holds one axis of the grid.
struct Axis {
  std::string key;                  ///< a setting, or solver, or backend
  std::vector<std::string> values;  ///< the values of --vary; empty if points are listed
};

/// One point of the grid: a value for each axis. An empty value keeps the value of the scene.
using Point = std::vector<std::string>;

struct AblationGrid {
  std::vector<Axis> axes;     ///< axes of the listed points, followed by the varied axes
  std::vector<Point> points;  ///< points; the last axis varies fastest
};

/// Returns each point of `listed` (texts of --point, `key=a,other=b` or `default`) combined with all values of `varied`
/// (texts of --vary, `key=a,b,c`). Throws compare::InputError if a text is malformed, or if a key, value or point
/// occurs twice; the message shows the text and the expected form.
AblationGrid ablation_grid(const std::vector<std::string>& listed, const std::vector<std::string>& varied);

/// Returns the name of a point, also used for its folder: "key=a,other=b", or "default" if it keeps all values of the
/// scene.
std::string name_of(const std::vector<Axis>& axes, const Point& point);

}  // namespace ogc::experiments
