// Defines which questions (compare/stages) are legal. Generated cases, cases from runs and shrunk cases are legal.
#pragma once

#include <cmath>
#include <span>
#include <string>

#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// The largest modulus of coordinates [m], velocities [m/s] and accelerations [m/s²] of a question. It is above the
/// limit of scenes, 2²⁰, so that no stage relies on that limit. There is no smallest modulus (method.md §2.4).
inline constexpr float most_coordinate = 0x1p30f;

/// `least_length` and `most_length` limit radii, distances and steps; `vast` limits stiffnesses and bounds.
inline constexpr float least_length = 0x1p-20f, most_length = 0x1p20f, vast = 0x1p40f;

/// Returns what makes the question illegal, with the wrong number; empty if it is legal.
std::string problem_of(const TestCase& test);

/// Collects problems and keeps the first one.
class FirstProblem {
 public:
  /// Notes a number that is NaN or outside of [least, most].
  void number(const char* what, float value, float least, float most) {
    if (value >= least && value <= most) return;
    say(what, value);
  }
  /// Notes a coordinate beyond most_coordinate.
  void vector(const char* what, const Vec3f& v) {
    for (const float x : {v.x, v.y, v.z})
      if (!(std::abs(x) <= most_coordinate)) say(what, x);
  }
  /// Notes any vector with a coordinate beyond most_coordinate.
  void vectors(const char* what, std::span<const Vec3f> all) {
    for (const Vec3f& v : all) vector(what, v);
  }
  /// Notes `otherwise` unless the condition holds.
  void require(bool holds, const char* otherwise) {
    if (!holds && text_.empty()) text_ = otherwise;
  }
  /// Returns the problem; empty if there is none.
  const std::string& text() const { return text_; }

 private:
  void say(const char* what, float value);

  std::string text_;
};

/// Notes a problem if two points of a stencil have a nonzero distance below `least` or above 2²², or if the largest
/// distance is nonzero and below `least_longest` (compare/stages/force.hpp).
void check_lengths(FirstProblem& problem, std::span<const Vec3f> points, float least, float least_longest = 0x1p-30f);

/// Checks that rest shape, materials and settings are valid for a scene. Positions are not checked, because triangles
/// may collapse during a run.
void check_scene(FirstProblem& problem, const Scene& scene);

}  // namespace ogc::compare
