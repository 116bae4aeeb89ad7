// Declares the functions that compute the figures; illustrations.cpp lists them.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "reference/illustrations/illustrations.hpp"

namespace ogc::reference {

/// Returns corner i of a regular k-gon on the unit circle.
inline std::array<double, 2> on_circle(int i, int k) {
  const double angle = 2 * std::numbers::pi * i / k;
  return {std::cos(angle), std::sin(angle)};
}

std::vector<DrawingPanel> contact_models();      ///< Fig. 2c to e
std::vector<DrawingPanel> contact_face_sets();   ///< Fig. 3
std::vector<DrawingPanel> offset_geometries();   ///< Fig. 4
std::vector<DrawingPanel> vertex_kinds();        ///< Fig. 5
std::vector<DrawingPanel> face_normals();        ///< Fig. 6
std::vector<DrawingPanel> surface_blocks();      ///< Fig. 7
std::vector<DrawingPanel> edge_only_blocks();    ///< Fig. 8
std::vector<DrawingPanel> one_iteration();       ///< Fig. 9
std::vector<DrawingPanel> force_along_a_path();  ///< Fig. 22a
std::vector<DrawingPanel> falling_triangles();   ///< Fig. 22b

}  // namespace ogc::reference
