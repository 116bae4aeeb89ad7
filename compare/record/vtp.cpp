#include "compare/record/vtp.hpp"

#include "compare/problem/text.hpp"
#include "compare/record/vtk_appended.hpp"

namespace ogc::compare {
namespace {

template <std::size_t Corners>
std::string cells(AppendedArrays& appended, const char* kind, const std::vector<std::array<Index, Corners>>& cells) {
  std::vector<Index> connectivity, ends;
  for (const auto& cell : cells) {
    connectivity.insert(connectivity.end(), cell.begin(), cell.end());
    ends.push_back(static_cast<Index>(connectivity.size()));
  }
  return std::string("<") + kind + ">" + appended.array("Int32", "connectivity", std::span<const Index>(connectivity)) +
         appended.array("Int32", "offsets", std::span<const Index>(ends)) + "</" + kind + ">\n";
}

/// Returns the text of a .vtp file. `data` has the elements of point and cell data, `points` the element of the
/// positions.
std::string file_text(const Mesh& mesh, const std::string& data, const std::string& points, AppendedArrays& appended) {
  std::string text =
      std::string(
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" header_type=\"UInt64\" byte_order=\"") +
      vtk_byte_order + "\">\n<PolyData>\n<Piece NumberOfPoints=\"" + std::to_string(mesh.positions.size()) +
      "\" NumberOfVerts=\"0\" NumberOfLines=\"" + std::to_string(mesh.loose_edges.size()) +
      "\" NumberOfStrips=\"0\" NumberOfPolys=\"" + std::to_string(mesh.triangles.size()) + "\">\n";
  text += data + "<Points>" + points + "</Points>\n";
  text += cells(appended, "Lines", mesh.loose_edges);
  text += cells(appended, "Polys", mesh.triangles);
  text += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  return text + appended.bytes() + "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace

std::string vtp_bytes(const Mesh& mesh, std::span<const Index> bodies, const Frame& frame, const Vec3& origin) {
  AppendedArrays appended;
  const std::string data = "<PointData Vectors=\"velocity\">" +
                           appended.array("Float32", "velocity", as_floats(frame.velocities), 3) +
                           appended.array("Float32", "bound", std::span<const float>(frame.bounds)) +
                           appended.array("Int32", "body", bodies) + "</PointData>\n";
  const std::string points = appended_points(appended, origin, frame.positions);
  return file_text(mesh, data, points, appended);
}

std::string vtp_bytes(const LabelledMesh& part) {
  AppendedArrays appended;
  const auto labels = [&](const char* name, const std::vector<Index>& numbers) {
    return appended.array("Int32", name, std::span<const Index>(numbers));
  };
  const std::string data = "<PointData>" + labels("vertex", part.vertex_numbers) + "</PointData>\n<CellData>" +
                           labels("number", part.cell_numbers) + labels("intersections", part.cell_counts) +
                           "</CellData>\n";
  const std::string points = appended.array("Float64", "Points", as_doubles(part.mesh.positions), 3);
  return file_text(part.mesh, data, points, appended);
}

std::string pvd_text(const std::vector<std::pair<double, std::string>>& files) {
  std::string text = std::string(
                         "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"") +
                     vtk_byte_order + "\">\n<Collection>\n";
  for (const auto& [time, file] : files)
    text += "<DataSet timestep=\"" + shortest(time) + "\" part=\"0\" file=\"" + file + "\"/>\n";
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace ogc::compare
