// The grid of an ablation: which settings differ, and the points that are run.
#pragma once

#include <string>
#include <vector>

namespace ogc::experiments {

/// One axis of the grid.
struct Axis {
  std::string key;                  ///< a setting, or solver, or backend
  std::vector<std::string> values;  ///< of --vary; none where points are listed
};

/// A point of the grid: a value for each axis, empty where the scene's stays.
using Point = std::vector<std::string>;

/// All that is run.
struct AblationGrid {
  std::vector<Axis> axes;     ///< those of listed points, then those that are varied
  std::vector<Point> points;  ///< the last axis runs fastest
};

/// Each point of `listed` (texts of --point, `key=a,other=b` or `default`) with all combinations of the values of
/// `varied` (texts of --vary, `key=a,b,c`). Throws compare::InputError that shows the text and its form where it is
/// malformed, or a key, value or point is there twice.
AblationGrid ablation_grid(const std::vector<std::string>& listed, const std::vector<std::string>& varied);

/// "key=a,other=b", "default" where everything is the scene's: how a point is called, in folders, too.
std::string name_of(const std::vector<Axis>& axes, const Point& point);

}  // namespace ogc::experiments
