#include "compare/record/vtu.hpp"

#include <limits>
#include <vector>

#include "compare/record/vtk_appended.hpp"

namespace ogc::compare {
namespace {

enum CellType : std::uint8_t { vtk_line = 3, vtk_triangle = 5, vtk_tetra = 10 };

struct Cells {
  std::vector<Index> connectivity, ends;
  std::vector<std::uint8_t> types;
  std::vector<float> growth;  ///< J

  template <std::size_t Corners>
  void add(const std::array<Index, Corners>& corners, CellType type, double j) {
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
    ends.push_back(static_cast<Index>(connectivity.size()));
    types.push_back(type);
    growth.push_back(static_cast<float>(j));
  }
};

template <class Point>
double six_volumes(const std::vector<Point>& x, const Tetrahedron& t) {
  const auto edge = [&](std::size_t k) {
    const Point &from = x[static_cast<std::size_t>(t[0])], &to = x[static_cast<std::size_t>(t[k])];
    return Vec3{double{to.x} - from.x, double{to.y} - from.y, double{to.z} - from.z};
  };
  const Vec3 a = edge(1), b = edge(2), c = edge(3);
  return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}

Cells cells_of(const Scene& scene, const Frame& frame) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  Cells cells;
  for (const Tetrahedron& t : scene.mesh.tetrahedra)
    cells.add(t, vtk_tetra, six_volumes(frame.positions, t) / six_volumes(scene.rest_positions, t));
  for (const Body& body : scene.bodies) {
    if (body.is_solid()) continue;
    for (Index t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t)
      cells.add(scene.mesh.triangles[static_cast<std::size_t>(t)], vtk_triangle, none);
  }
  for (const Edge& e : scene.mesh.loose_edges) cells.add(e, vtk_line, none);
  return cells;
}

}  // namespace

std::string vtu_bytes(const Scene& scene, std::span<const Index> bodies, const Frame& frame, const Vec3& origin) {
  const Cells cells = cells_of(scene, frame);
  AppendedArrays appended;
  std::string text = std::string(
                         "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
                         "header_type=\"UInt64\" byte_order=\"") +
                     vtk_byte_order + "\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
                     std::to_string(frame.positions.size()) + "\" NumberOfCells=\"" +
                     std::to_string(cells.types.size()) + "\">\n";
  text += "<PointData Vectors=\"velocity\">" + appended.array("Float32", "velocity", as_floats(frame.velocities), 3) +
          appended.array("Float32", "bound", std::span<const float>(frame.bounds)) +
          appended.array("Int32", "body", bodies) + "</PointData>\n";
  text += "<CellData Scalars=\"J\">" + appended.array("Float32", "J", std::span<const float>(cells.growth)) +
          "</CellData>\n";
  text += "<Points>" + appended_points(appended, origin, frame.positions) + "</Points>\n";
  text += "<Cells>" + appended.array("Int32", "connectivity", std::span<const Index>(cells.connectivity)) +
          appended.array("Int32", "offsets", std::span<const Index>(cells.ends)) +
          appended.array("UInt8", "types", std::span<const std::uint8_t>(cells.types)) + "</Cells>\n";
  text += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  return text + appended.bytes() + "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace ogc::compare
