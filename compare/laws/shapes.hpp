// The bodies of the laws' scenes, and the settings that they share.
#pragma once

#include <array>
#include <numbers>

#include "compare/problem/scene.hpp"

namespace ogc::compare::law_shapes {

/// Standard gravity [m/s²].
inline constexpr double standard_gravity = 9.81;
/// Degrees as radians.
constexpr double degrees(double angle) { return angle * std::numbers::pi / 180; }

/// A sheet in the plane y = `height`, `rows` × `columns` vertices `spacing` apart [m] about the y axis, rows along x,
/// vertex (i, j) number i · columns + j; diagonals alternate. Both ≥ 2.
Mesh sheet(Index rows, Index columns, double spacing, double height);

/// One triangle in the plane y = `height` that holds a circle of `reach` [m] about the y axis: a floor without an inner
/// edge, so that what rests on it has one contact a vertex.
Mesh floor_triangle(double reach, double height);

/// A box of `cells` cubes of `spacing` [m] a side along x, y and z from corner `low`; six tetrahedra a cube about its
/// diagonal. Vertex (i, j, k) has number (i (cells[1] + 1) + j) (cells[2] + 1) + k.
Mesh box(const std::array<Index, 3>& cells, double spacing, const Vec3& low);

/// A chain of loose edges through the points, in their order.
Mesh chain(std::vector<Vec3> points);

/// A scene of the name with nothing in it: h [s], steps and sweeps a step.
Scene empty_scene(const char* name, double time_step, std::int64_t steps, std::int64_t iterations);

/// Cloth that all laws share unless they say otherwise: 1 kg/m², 1000 N/m, no bending, k_c = 1000 N/m.
Material cloth(double friction);

/// Sheets of 5 × 5 vertices, 0.2 m wide with hinges and μ = 0.2, on a floor of one triangle under gravity; each at the
/// depth at which 25 springs bear what is above. The floor is the last body.
Scene stacked_sheets(const char* name, int sheets, std::int64_t steps);

/// Every vertex of the body gets this velocity [m/s].
void set_velocity(Scene& scene, std::size_t body, const Vec3& velocity);

/// Vertices that stay where they are, as a motion of none.
void pin(Scene& scene, std::vector<Index> vertices);

}  // namespace ogc::compare::law_shapes
