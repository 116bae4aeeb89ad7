// Tests the VTP files that this program writes, every section that it reads, and broken files.
// tests/experiments/program/commands/audit_frames.py tests files of VTK itself.
#include <algorithm>
#include <string>

#include "compare/files/meshes/mesh_files.hpp"
#include "compare/files/meshes/vtk_mesh.hpp"
#include "compare/problem/error.hpp"
#include "compare/record/vtp.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/meshes/samples.hpp"
#include "tests/compare/files/scratch.hpp"

using namespace ogc::compare;
using ogc::tests::replaced;

namespace {

const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1.0 / 3}}, {{0, 1, 2}, {0, 2, 3}}, {{1, 3}}};

std::string array(const std::string& type, const std::string& name, const std::string& text) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">" + text + "</DataArray>";
}

std::string cells(const std::string& kind, const std::string& connectivity, const std::string& offsets) {
  return "<" + kind + ">" + array("Int32", "connectivity", connectivity) + array("Int32", "offsets", offsets) + "</" +
         kind + ">";
}

std::string piece(const std::string& points, const std::string& cells) {
  return "<Piece><Points>" + array("Float64", "Points", points) + "</Points>" + cells + "</Piece>";
}

std::string file(const std::string& pieces, const std::string& type = "PolyData") {
  return "<?xml version=\"1.0\"?><VTKFile type=\"" + type + "\" byte_order=\"LittleEndian\"><PolyData>" + pieces +
         "</PolyData></VTKFile>";
}

const std::string square = "0 0 0  1 0 0  1 1 0  0 1 0";

void refuses(const std::string& bytes, const std::string& reason) {
  INFO(reason);
  CHECK_THROWS_WITH(parse_vtk_xml_mesh(bytes, "broken.vtp"),
                    ContainsSubstring("broken.vtp: ") && ContainsSubstring(reason));
}

}  // namespace

TEST_CASE("a mesh that this program wrote as VTP comes back bit for bit", "[unit]") {
  const ogc::tests::Scratch scratch;
  const std::string bytes = vtp_bytes(
      {.mesh = mesh, .vertex_numbers = {4, 5, 6, 7}, .cell_numbers = {1, 2, 3}, .cell_counts = {1, 0, 1}});
  CHECK(make_mesh(parse_vtk_xml_mesh(bytes, "labelled")).mesh == mesh);
  CHECK_THROWS_WITH(write_mesh(scratch / "mesh.vtp", mesh), ContainsSubstring(".obj or .ply"));
}

TEST_CASE("pieces are put together, strips become triangles of one sense, lines edges, points and other data nothing",
          "[unit]") {
  const std::string strip = cells("Strips", "0 1 3 2", "4"), line = cells("Lines", "2 1 0", "3"),
                    vertices = cells("Verts", "0 1", "1 2");
  const std::string colours = "<PointData>" + array("Float32", "colour", "0 0 0 1") + "</PointData>";
  const PolygonMesh polygons = parse_vtk_xml_mesh(
      file(piece(square, colours + cells("Polys", "0 1 2", "3")) + piece(square, vertices + line + strip)), "pieces");
  const Mesh found = make_mesh(polygons, {.keep_unused = true}).mesh;
  CHECK(found.positions.size() == 8);
  CHECK(found.triangles == std::vector<Triangle>{{0, 1, 2}, {4, 5, 7}, {5, 6, 7}});
  CHECK(found.loose_edges == std::vector<Edge>{{5, 6}, {4, 5}});
}

TEST_CASE("broken VTP files are refused with the array or cell and the reason", "[unit]") {
  refuses("solid cube", "line 1");
  refuses(file(piece(square, cells("Polys", "0 1 2", "3"))).substr(0, 200), "no VTK XML file");
  refuses(file("", "ImageData"), "Extract Surface");
  refuses(file(""), "no points");
  refuses(file("<Piece></Piece>"), "no points");
  const auto announcing = [](const std::string& count, const std::string& cells) {
    return replaced(file(piece(square, cells)), "<Piece>", "<Piece " + count + ">");
  };
  refuses(announcing("NumberOfPoints='400000000000'", ""), "announces '400000000000' points and holds 4");
  refuses(announcing("NumberOfPolys='2'", cells("Polys", "0 1 2", "3")), "announces '2' Polys and holds 1");
  refuses(announcing("NumberOfLines='1'", cells("Polys", "0 1 2", "3")), "announces '1' Lines and holds 0");
  refuses(file(piece(square + " 7", "")), "13 numbers are no rows of three");
  refuses(file(piece("0 0 0  1 nan 0", "")), "point 1: a coordinate is not finite");
  refuses(file(piece("0 0 zero", "")), "value 2, 'zero', is no number");
  refuses(file(piece(square, cells("Polys", "0 1", "2"))), "cell 0 is a polygon of 2 corners; it has 3 or more");
  refuses(file(piece(square, cells("Polys", "0 1 4", "3"))), "Polys 0: vertex 4 does not exist");
  refuses(file(piece(square, cells("Polys", "0 1 2", "4"))), "Polys 0: its offset");
  refuses(file("<Piece><Points><DataArray type=\"Text\" format=\"ascii\"/></Points></Piece>"), "unknown type 'Text'");
  refuses(file("<Piece><Points><DataArray type=\"Float32\" format=\"binary\">!!!!</DataArray></Points></Piece>"),
          "no character of base64");
  refuses(file("<Piece><Points><DataArray type=\"Float32\" format=\"appended\" offset=\"0\"/></Points></Piece>"),
          "appended data are missing");
}

// In the appended data a length of 8 bytes precedes each array. For a length beyond the file's end no memory must be
// allocated.
TEST_CASE("a VTP file cut anywhere, or with an absurd length, is refused", "[unit]") {
  const std::string bytes = vtp_bytes(
      {.mesh = mesh, .vertex_numbers = {0, 1, 2, 3}, .cell_numbers = {0, 0, 1}, .cell_counts = {0, 0, 0}});
  const std::size_t data = bytes.find("encoding=\"raw\">\n_") + 17;
  std::string absurd = bytes;
  std::fill_n(absurd.begin() + static_cast<std::ptrdiff_t>(data), bytes.size() - data, '\x7f');
  refuses(absurd, "truncated");
  // The last array, the triangles' offsets, ends before the closing tags.
  const std::size_t end = bytes.find("\n</AppendedData>");
  for (std::size_t size = 0; size < end; size += 1 + size / 16)
    CHECK_THROWS_AS(parse_vtk_xml_mesh(bytes.substr(0, size), "cut.vtp"), InputError);
}
