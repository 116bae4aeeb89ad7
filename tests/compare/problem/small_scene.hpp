// Makes a valid scene with a free body, a fixed body and two motions, small enough to write down its answers.
#pragma once

#include "compare/problem/scene.hpp"

namespace ogc::tests {

/// Returns two bodies. "sheet" is a square of two triangles with vertex 0 in motion "left" and vertex 2 in motion
/// "right"; "floor" is one fixed triangle below it.
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
