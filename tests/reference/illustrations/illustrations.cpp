// Tests that the drawings' data have the properties that the drawings show.
#include "reference/illustrations/illustrations.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "compare/oracle/audit.hpp"
#include "compare/problem/error.hpp"
#include "reference/illustrations/slice.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using reference::DrawingLayer;
using reference::DrawingPanel;
using reference::Slice;

namespace {

const DrawingLayer& layer(const DrawingPanel& panel, std::string_view name) {
  const auto it = std::find_if(panel.layers.begin(), panel.layers.end(),
                               [&](const DrawingLayer& l) { return l.name == name; });
  REQUIRE(it != panel.layers.end());
  return *it;
}

}  // namespace

TEST_CASE("illustrations: every figure has panels whose layers refer to their own points only", "[unit]") {
  for (const std::string_view name : reference::illustration_names()) {
    CAPTURE(std::string(name));
    const auto panels = reference::illustration(name);
    CHECK(panels.size() >= 2);
    for (const DrawingPanel& panel : panels) {
      CHECK_FALSE(panel.layers.empty());
      std::size_t outside = 0;
      for (const DrawingLayer& l : panel.layers) {
        const auto known = [&](int i) { return i >= 0 && static_cast<std::size_t>(i) < l.points.size(); };
        for (const auto& t : l.triangles) outside += !std::all_of(t.begin(), t.end(), known);
        for (const auto& line : l.lines) outside += !std::all_of(line.begin(), line.end(), known);
        for (const auto& x : l.points) outside += !std::isfinite(x[0] + x[1] + x[2]);
      }
      CHECK(outside == 0);
    }
  }
  CHECK_THROWS_AS(reference::illustration("fig99"), compare::InputError);
}

TEST_CASE(
    "illustrations: Fig. 2c to e, IPC pushes along a facet beyond its ends and neighbours in a sheet; OGC pushes a "
    "stranger alone",
    "[unit]") {
  const auto panels = reference::illustration("fig02_models");
  std::vector<std::size_t> pushes[3];
  for (std::size_t k = 0; k < 3; ++k) {
    for (const DrawingLayer& l : panels[k].layers) {
      if (l.name == "arrows") pushes[k].push_back(l.lines.size());
    }
  }
  CHECK(pushes[0] == std::vector<std::size_t>{1, 1, 1});
  const auto& beyond_the_end = *std::find_if(panels[0].layers.begin(), panels[0].layers.end(),
                                             [](const DrawingLayer& l) { return l.name == "arrows"; });
  CHECK(beyond_the_end.points[1][0] > beyond_the_end.points[0][0]);
  CHECK(pushes[1][0] > 0);
  CHECK(pushes[1][1] > 0);
  CHECK(pushes[2][0] == 0);
  CHECK(pushes[2][1] == 0);
  CHECK(pushes[2][2] > 0);
}

TEST_CASE(
    "illustrations: Fig. 3, IPC pushes two facets over a ridge, OGC its crest; SDF one facet in a valley where OGC "
    "pushes both",
    "[unit]") {
  const auto panels = reference::illustration("fig03");
  CHECK(layer(panels[0], "IPC").lines.size() == 2);
  CHECK(layer(panels[0], "OGC").values == std::vector<double>{1, 0});  // vertex 1
  CHECK(layer(panels[1], "IPC").lines.size() == 2);                    // both segments of the second ring are within r
  CHECK(layer(panels[1], "OGC").lines.empty());
  CHECK(layer(panels[2], "SDF").lines.size() == 1);
  CHECK(layer(panels[2], "OGC").lines.size() == 2);
}

TEST_CASE(
    "illustrations: Fig. 4, layers are at least one where the conventional offset is, two between the strands, none "
    "elsewhere",
    "[property]") {
  const auto panels = reference::illustration("fig04");
  const auto &inside = layer(panels[1], "inside"), &layers = layer(panels[2], "layers");
  REQUIRE(inside.values.size() == layers.values.size());
  for (std::size_t k = 0; k < inside.values.size(); ++k) CHECK((inside.values[k] > 0) == (layers.values[k] > 0));
  CHECK(std::count_if(layers.values.begin(), layers.values.end(), [](double n) { return n >= 2; }) > 200);
}

TEST_CASE(
    "illustrations: Fig. 22a, the force of a facet jumps where its open boundary is entered and begins at zero nowhere "
    "else",
    "[unit]") {
  const auto panels = reference::illustration("fig22");
  const auto& force = layer(panels[1], "force of the right facet");
  double largest = 0;
  for (std::size_t k = 1; k < force.points.size(); ++k)
    largest = std::max(largest, std::abs(force.points[k][1] - force.points[k - 1][1]));
  CHECK(largest > 0.1);
}

TEST_CASE("slice: a point beside a straight polyline has one layer, near a bend inside it two, outside it one",
          "[unit]") {
  const Slice bend({{-2, 1}, {0, 0}, {2, 1}});
  CHECK(bend.layers({0, 0.5f, 0}, 1).size() == 2);
  CHECK(bend.layers({0, -0.5f, 0}, 1) == std::vector<reference::SliceFace>{{false, 1}});
  CHECK(bend.layers({-1, 0.25f, 0}, 0.5f) == std::vector<reference::SliceFace>{{true, 0}});
  CHECK(bend.layers({0, 3, 0}, 1).empty());
}

TEST_CASE("illustrations: Fig. 9, the full step penetrates, neither cut does, and cutting by vertex leaves more of it",
          "[property]") {
  const auto panels = reference::illustration("fig09");
  const auto swept = [](const DrawingLayer& moving, const DrawingLayer& obstacle) {
    std::vector<compare::Vec3> positions;
    std::vector<compare::Triangle> triangles;
    for (const DrawingLayer* line : {&moving, &obstacle}) {
      const auto first = static_cast<compare::Index>(positions.size());
      for (const auto& p : line->points) {
        positions.push_back({p[0], p[1], -1});
        positions.push_back({p[0], p[1], 1});
      }
      for (compare::Index k = first; k + 3 < static_cast<compare::Index>(positions.size()); k += 2)
        triangles.insert(triangles.end(), {{k, k + 1, k + 2}, {k + 1, k + 3, k + 2}});
    }
    return compare::audit(compare::build_topology(static_cast<compare::Index>(positions.size()), triangles), positions)
        .count;
  };
  const DrawingLayer &obstacle = layer(panels[0], "obstacle"), &global = layer(panels[1], "after"),
                     &local = layer(panels[3], "after");
  const DrawingLayer &before = layer(panels[0], "before"), &target = layer(panels[0], "target"),
                     &bounds = layer(panels[2], "bounds");
  CHECK(swept(before, obstacle) == 0);
  CHECK(swept(target, obstacle) > 0);
  CHECK(swept(local, obstacle) == 0);
  const double share = global.values[0];
  for (const double change : {-1e-6, 1e-6}) {  // just before the touch, and just after it
    DrawingLayer near = before;
    for (std::size_t i = 0; i < near.points.size(); ++i)
      for (std::size_t k = 0; k < 2; ++k)
        near.points[i][k] += (share + change) * (target.points[i][k] - before.points[i][k]);
    CHECK((swept(near, obstacle) > 0) == (change > 0));
  }
  double sum = 0;
  for (std::size_t i = 0; i < local.points.size(); ++i) {
    const double moved = std::hypot(local.points[i][0] - static_cast<float>(before.points[i][0]),
                                    local.points[i][1] - static_cast<float>(before.points[i][1]));
    CHECK(moved <= bounds.values[i]);
    sum += local.values[i];
  }
  CHECK(sum / static_cast<double>(local.values.size()) > 2 * share);
}

TEST_CASE("illustrations: Fig. 22b, rounds grow with speed, each within its bound, and end at the target",
          "[property]") {
  const auto panels = reference::illustration("fig22");
  const DrawingPanel& fall = panels[2];
  const DrawingLayer &end = layer(fall, "end"), &target = layer(fall, "target"), *from = &layer(fall, "start");
  CHECK(end.points == target.points);
  for (const DrawingLayer& l : fall.layers) {
    if (l.name != "round" && l.name != "end") continue;
    for (std::size_t v = 0; v < l.points.size(); ++v)
      CHECK(std::abs(l.points[v][1] - from->points[v][1]) <= from->values[v]);
    from = &l;
  }
  const DrawingLayer& rounds = layer(panels[3], "rounds");
  for (std::size_t k = 1; k < rounds.points.size(); ++k) {
    CHECK(rounds.points[k][0] > rounds.points[k - 1][0]);
    CHECK(rounds.points[k][1] >= rounds.points[k - 1][1]);
  }
  const DrawingLayer& with_planes = layer(panels[3], "rounds with planes");
  REQUIRE(with_planes.points.size() == rounds.points.size());
  for (std::size_t k = 0; k < rounds.points.size(); ++k) CHECK(with_planes.points[k][1] <= rounds.points[k][1]);
  CHECK(rounds.points.front()[1] == 1);
  CHECK(rounds.points.back()[1] > layer(panels[3], "guess_rounds").points[0][1]);
}
