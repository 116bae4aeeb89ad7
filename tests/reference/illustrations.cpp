// What the drawings are meant to show holds for the numbers that they are made of.
#include "reference/geometry/illustrations.hpp"

#include <algorithm>
#include <cmath>

#include "compare/problem/error.hpp"
#include "reference/geometry/slice.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using reference::DrawingLayer;
using reference::DrawingPanel;
using reference::Slice;

namespace {

const DrawingLayer& layer(const DrawingPanel& panel, const std::string& name) {
  const auto it = std::find_if(panel.layers.begin(), panel.layers.end(), [&](const DrawingLayer& l) { return l.name == name; });
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

TEST_CASE("illustrations: Fig. 3, IPC pushes two facets over a ridge, OGC its crest; SDF one facet in a valley where OGC pushes both", "[unit]") {
  const auto panels = reference::illustration("fig03");
  CHECK(layer(panels[0], "IPC").lines.size() == 2);
  CHECK(layer(panels[0], "OGC").values == std::vector<double>{1, 0});  // vertex 1
  CHECK(layer(panels[1], "IPC").lines.size() == 2);  // both segments of the second ring within r
  CHECK(layer(panels[1], "OGC").lines.empty());
  CHECK(layer(panels[2], "SDF").lines.size() == 1);
  CHECK(layer(panels[2], "OGC").lines.size() == 2);
}

TEST_CASE("illustrations: Fig. 4, layers are at least one where the conventional offset is, two between the strands, none elsewhere", "[property]") {
  const auto panels = reference::illustration("fig04");
  const auto &inside = layer(panels[1], "inside"), &layers = layer(panels[2], "layers");
  REQUIRE(inside.values.size() == layers.values.size());
  for (std::size_t k = 0; k < inside.values.size(); ++k) CHECK((inside.values[k] > 0) == (layers.values[k] > 0));
  CHECK(std::count_if(layers.values.begin(), layers.values.end(), [](double n) { return n >= 2; }) > 200);
}

TEST_CASE("illustrations: Fig. 22a, the force of a facet jumps where its open boundary is entered and begins at zero nowhere else", "[unit]") {
  const auto panels = reference::illustration("fig22a");
  const auto& force = layer(panels[1], "force of the right facet");
  double largest = 0;
  for (std::size_t k = 1; k < force.points.size(); ++k) largest = std::max(largest, std::abs(force.points[k][1] - force.points[k - 1][1]));
  CHECK(largest > 0.1);
}

TEST_CASE("slice: a point beside a straight polyline has one layer, near a bend inside it two, outside it one", "[unit]") {
  const Slice bend({{-2, 1}, {0, 0}, {2, 1}});
  CHECK(bend.layers({0, 0.5f, 0}, 1).size() == 2);
  CHECK(bend.layers({0, -0.5f, 0}, 1) == std::vector<reference::SliceFace>{{false, 1}});
  CHECK(bend.layers({-1, 0.25f, 0}, 0.5f) == std::vector<reference::SliceFace>{{true, 0}});
  CHECK(bend.layers({0, 3, 0}, 1).empty());
}
