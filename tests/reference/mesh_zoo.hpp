// Holds more than two hundred meshes on which the theorems of the paper's section 3 are tested: all kinds of vertices
// and edges, all sizes, exact coincidences.
#pragma once

#include <string>
#include <vector>

#include "tests/reference/meshes.hpp"

namespace ogc::tests {

/// A mesh, a contact radius of about the length of its edges, and test points: near its faces, on its planes and
/// vertices.
struct Specimen {
  std::string name;
  Surface surface;
  float radius = 1;
  bool collapsed = false;  ///< whether it has triangles without area or edges without length
  std::vector<Vec3f> points;
};

/// Returns at least 200 specimens, the same ones in every run.
const std::vector<Specimen>& mesh_zoo();

Surface tetrahedron();
Surface octahedron();
Surface cube();
/// Returns `pages` triangles on the edge from vertex 0 to vertex 1, evenly spread over an angle of 2π `turn` around it.
Surface book(int pages, double turn);
/// Returns a closed strip of 2n triangles with a half twist.
Surface moebius(int n);
/// Returns four triangles around vertex 0, whose neighbours lie alternately above and below.
Surface saddle();

}  // namespace ogc::tests
