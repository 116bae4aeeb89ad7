#include "experiments/program/runs/ablation_grid.hpp"

#include <algorithm>
#include <span>
#include <sstream>

#include "compare/problem/error.hpp"

namespace ogc::experiments {

namespace {

Axis parse_axis(const std::string& text) {
  const std::size_t equals = text.find('=');
  Axis axis{text.substr(0, equals), {}};
  for (std::size_t begin = equals + 1; equals != std::string::npos && begin <= text.size();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    axis.values.push_back(text.substr(begin, comma - begin));
    begin = comma + 1;
  }
  if (axis.key.empty() || axis.values.empty() || std::ranges::find(axis.values, "") != axis.values.end())
    throw compare::InputError("--vary " + text + ": give key=a,b,c, for example --vary contact_activation=ogc,ipc_log");
  return axis;
}

/// Name of the point that keeps all values of the scene.
constexpr const char* unchanged = "default";

/// Returns the points of --point, with one axis for each key that occurs in them. Without --point returns one point
/// without axes.
std::vector<Point> listed_points(const std::vector<std::string>& texts, std::vector<Axis>& axes) {
  std::vector<Point> points;
  for (const std::string& text : texts) {
    Point point(axes.size());
    std::string part;
    for (std::istringstream parts(text == unchanged ? "" : text); std::getline(parts, part, ',');) {
      const std::size_t equals = part.find('=');
      if (equals == 0 || equals == std::string::npos || equals + 1 == part.size())
        throw compare::InputError("--point " + text + ": give key=a,other=b, or " + unchanged +
                                  ", for example --point iterations=20,time_step=0.005");
      const std::string key = part.substr(0, equals);
      const auto axis = std::ranges::find(axes, key, &Axis::key);
      const auto place = static_cast<std::size_t>(axis - axes.begin());
      if (axis == axes.end()) axes.push_back({key, {}});
      point.resize(axes.size());
      if (!point[place].empty()) throw compare::InputError("--point " + text + ": " + key + " stands there twice");
      point[place] = part.substr(equals + 1);
    }
    points.push_back(std::move(point));
  }
  if (points.empty()) points.emplace_back();
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].resize(axes.size());
    if (std::ranges::find(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(i), points[i]) !=
        points.begin() + static_cast<std::ptrdiff_t>(i))
      throw compare::InputError("--point " + texts[i] + " is given twice; give each point once");
  }
  return points;
}

/// Returns each of `points` combined with all values of `axes`.
std::vector<Point> combined(std::vector<Point> points, std::span<const Axis> axes) {
  for (const Axis& axis : axes) {
    std::vector<Point> longer;
    for (const Point& point : points)
      for (const std::string& value : axis.values) {
        longer.push_back(point);
        longer.back().push_back(value);
      }
    points = std::move(longer);
  }
  return points;
}

void expect_distinct(const std::vector<Axis>& axes) {
  for (std::size_t i = 0; i < axes.size(); ++i) {
    std::vector<std::string> values = axes[i].values;
    std::ranges::sort(values);
    if (const auto twice = std::ranges::adjacent_find(values); twice != values.end())
      throw compare::InputError("--vary " + axes[i].key + ": " + *twice + " stands there twice; give each value once");
    for (std::size_t j = 0; j < i; ++j)
      if (axes[j].key == axes[i].key)
        throw compare::InputError("--vary " + axes[i].key + " is given twice; give all its values at once, " +
                                  axes[i].key + "=a,b,c");
  }
}

}  // namespace

AblationGrid ablation_grid(const std::vector<std::string>& listed, const std::vector<std::string>& varied) {
  AblationGrid grid;
  std::vector<Point> points = listed_points(listed, grid.axes);
  const std::size_t listed_axes = grid.axes.size();
  for (const std::string& text : varied) grid.axes.push_back(parse_axis(text));
  expect_distinct(grid.axes);
  grid.points = combined(std::move(points), std::span(grid.axes).subspan(listed_axes));
  return grid;
}

std::string name_of(const std::vector<Axis>& axes, const Point& point) {
  std::string name;
  for (std::size_t i = 0; i < axes.size(); ++i)
    if (!point[i].empty()) name.append(name.empty() ? "" : ",").append(axes[i].key).append("=").append(point[i]);
  return name.empty() ? unchanged : name;
}

}  // namespace ogc::experiments
