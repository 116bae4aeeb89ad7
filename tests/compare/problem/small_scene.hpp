// A valid scene with everything in it, small enough to write its answers down.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::tests {

/// Body "sheet": a square of two triangles with vertex 0 in motion "left" and vertex 2 in motion "right"; body "floor":
/// one fixed triangle below.
inline compare::Scene small_scene() {
  compare::Scene scene;
  scene.name = "small";
  const compare::Mesh sheet{{{0, 0, 0}, {0, 0, 0.1}, {0.1, 0, 0.1}, {0.1, 0, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}};
  const compare::Mesh floor{{{-1, -0.5, -1}, {0, -0.5, 1}, {1, -0.5, -1}}, {{0, 1, 2}}, {}};
  append_body(scene, {.name = "sheet", .material = {}}, sheet);
  append_body(scene, {.name = "floor", .fixed = true, .material = {}}, floor);
  compare::PrescribedMotion left, right;
  left.name = "left";
  left.vertices = {0};
  left.velocity = {-0.1, 0, 0};
  right.name = "right";
  right.vertices = {2};
  right.angular_velocity = 1;
  scene.motions = {left, right};
  return scene;
}

}  // namespace ogc::tests
