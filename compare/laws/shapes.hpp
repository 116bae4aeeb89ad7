// Makes the bodies of the laws' scenes and sets the settings that the scenes share.
#pragma once

#include <array>
#include <numbers>

#include "compare/problem/scene.hpp"

namespace ogc::compare::law_shapes {

/// Standard gravity [m/s²].
inline constexpr double standard_gravity = 9.81;
/// Gravity that points straight down [m/s²].
inline constexpr Vec3 down{0, -standard_gravity, 0};

/// Returns degrees as radians.
constexpr double degrees(double angle) { return angle * std::numbers::pi / 180; }

/// Returns a sheet in the plane y = `height` about the y axis: `rows` × `columns` vertices, each ≥ 2, `spacing` apart
/// [m], rows along x. Vertex (i, j) has index i · columns + j; diagonals alternate.
Mesh sheet(Index rows, Index columns, double spacing, double height);

/// Returns one triangle in the plane y = `height` that contains a circle of radius `reach` [m] about the y axis. A
/// vertex that rests on this floor has one contact, because the floor has no inner edges.
Mesh floor_triangle(double reach, double height);

/// Returns a box of `cells` cubes of side `spacing` [m] along x, y and z from corner `low`, with six tetrahedra about
/// the diagonal of each cube. Vertex (i, j, k) has index (i (cells[1] + 1) + j) (cells[2] + 1) + k.
Mesh box(const std::array<Index, 3>& cells, double spacing, const Vec3& low);

/// Returns a chain of loose edges through the points, in their order.
Mesh chain(std::vector<Vec3> points);

/// Returns a scene with this name and without bodies. `time_step` is h [s]; `iterations` is the number of sweeps of a
/// step.
Scene empty_scene(const char* name, double time_step, std::int64_t steps, std::int64_t iterations);

/// Returns the material of cloth that most laws use: 1 kg/m², μ = λ = 1000 N/m, no bending, k_c = 1000 N/m.
Material cloth(double friction);

/// Returns sheets of 5 × 5 vertices, 0.2 m wide with hinges and μ = 0.2, on a floor of one triangle under gravity. Each
/// sheet is at the depth at which 25 springs support it and the sheets above it. The floor is the last body.
Scene stacked_sheets(const char* name, int sheets, std::int64_t steps);

/// Sets the velocity of every vertex of the body [m/s].
void set_velocity(Scene& scene, std::size_t body, const Vec3& velocity);

/// Prescribes that the vertices stay where they are.
void pin(Scene& scene, std::vector<Index> vertices);

}  // namespace ogc::compare::law_shapes
