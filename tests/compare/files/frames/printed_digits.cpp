// Tests how the digits of coordinates are counted in text files: in each file format, with each way to print numbers,
// and for numbers whose digits show no precision.
#include "compare/files/frames/printed_digits.hpp"

#include <cmath>
#include <functional>

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/frames/written_arrays.hpp"

using namespace ogc;
using namespace ogc::compare;
using namespace ogc::tests;

namespace {

constexpr int points = 12;

/// Returns coordinate k of point i, at most 3.6 in modulus.
double coordinate(int i, int k) { return 3.6 * std::sin(1 + 3.0 * i + k); }

std::string text(const char* format, double x) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, x);
  return buffer;
}

/// Returns a line for each point: `before`, its coordinates, and `behind`.
std::string lines(const char* format, const std::string& before = "", const std::string& behind = "") {
  std::string all;
  for (int i = 0; i < points; ++i) {
    all += before;
    for (int k = 0; k < 3; ++k) all += (k == 0 ? "" : " ") + text(format, coordinate(i, k));
    all += behind + "\n";
  }
  return all;
}

struct Kind {
  std::string name;
  std::function<std::string(const char*)> written;
};

const std::string ply_begins = "ply\nformat ascii 1.0\nelement info 1\nproperty float key\nelement vertex 12\n";

/// Each file also contains numbers that are no coordinates and have other digits.
const std::vector<Kind> kinds{
    {"a.obj", [](const char* f) { return "vn 0.1234 0.5678 0.9999\n" + lines(f, "v ") + "f 1 2 3\n"; }},
    {"a.stl",
     [](const char* f) { return "solid a\nfacet normal 0.12345678901 0 1\n" + lines(f, "vertex ") + "endsolid\n"; }},
    {"a.ply",
     [](const char* f) {
       return ply_begins + "property float quality\nproperty float x\nproperty float y\nproperty float z\n" +
              "element face 0\nproperty list uchar int vertex_indices\nend_header\n0.1234567890123\n" +
              lines(f, "0.123456789012 ");
     }},
    {"a.off", [](const char* f) { return "OFF # 0.123456789012\n12 1 0\n" + lines(f) + "3 0 1 2\n"; }},
    {"a.vtp",
     [](const char* f) {
       return "<VTKFile><DataArray Name=\"other\" format=\"ascii\">0.12345678901234</DataArray><Points>"
              "<DataArray format=\"ascii\">" +
              lines(f) + "</DataArray></Points></VTKFile>";
     }},
    {"a.msh",
     [](const char* f) {
       return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n12\n" + lines(f, "123456789012 ") + "$EndNodes\n";
     }},
    {"a.vtk",
     [](const char* f) {
       return "# vtk DataFile Version 3.0\n0.123456789012\nASCII\nDATASET POLYDATA\nPOINTS 12 float\n" + lines(f) +
              "POLYGONS 1 4\n3 0 1 2\n";
     }},
    {"a.mesh",
     [](const char* f) {
       return "MeshVersionFormatted 2\nDimension 3\nVertices\n12\n" + lines(f, "", " 123456789012") + "Triangles\n0\n";
     }},
    {"b.msh", [](const char* f) {
       return "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 12 1 123456789\n2 1 0 12\n1\n2\n" + lines(f) +
              "$EndNodes\n";
     }}};

}  // namespace

TEST_CASE("digits of coordinates are counted in every text format", "[unit]") {
  const Scratch scratch;
  for (const Kind& kind : kinds) {
    INFO(kind.name);
    const auto digits = [&](const char* format) {
      return printed_digits(written(scratch / kind.name, kind.written(format)));
    };
    const auto nine = digits("%.9g");
    REQUIRE(nine);
    CHECK((nine->digits == 9 && !nine->are_decimals && nine->unit == Approx(1e-8)));
    const auto exponents = digits("%.7e");
    REQUIRE(exponents);
    CHECK((exponents->digits == 8 && !exponents->are_decimals && exponents->unit == Approx(1e-7)));
    const auto fixed = digits("%.6f");
    REQUIRE(fixed);
    CHECK((fixed->digits == 6 && fixed->are_decimals && fixed->unit == Approx(1e-6)));
    CHECK_FALSE(digits("%.17g"));
    CHECK_FALSE(digits("%.16e"));
    CHECK_FALSE(digits("%.1f"));  // numbers with so few digits may be typed by hand
    CHECK_FALSE(digits("%.2g"));
  }
}

TEST_CASE("line ends of other systems change no digit", "[unit]") {
  const Scratch scratch;
  for (const Kind& kind : kinds)
    for (const std::string end : {"\r\n", "\r"}) {
      INFO(kind.name);
      std::string bytes = kind.written("%.9g");
      for (std::size_t at = bytes.find('\n'); at != std::string::npos; at = bytes.find('\n', at + end.size()))
        bytes.replace(at, 1, end);
      const auto digits = printed_digits(written(scratch / kind.name, bytes));
      REQUIRE(digits);
      CHECK((digits->digits == 9 && digits->unit == Approx(1e-8)));
    }
}

TEST_CASE("exact and binary coordinates have no digits to speak of", "[unit]") {
  const Scratch scratch;
  const auto of = [&](const std::string& name, const std::string& bytes) {
    return printed_digits(written(scratch / name, bytes));
  };
  CHECK_FALSE(of("typed.obj", "v 0 0 0\nv 1 0 0\nv 0.5 0.25 0\nv 0.125 0.0625 1\nf 1 2 3\n"));
  CHECK_FALSE(of("none.obj", ""));
  CHECK_FALSE(of("zero.obj", "v 0.000000 0.000000 0.000000\n"));
  CHECK_FALSE(of("long.obj", "v 0.30000000000000004 0.5 1\nv 0.25 0.5 1\n"));
  CHECK_FALSE(of("a.glb", lines("%.9g", "v ")));
  CHECK_FALSE(of("binary.ply",
                 "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
                 "property float y\nproperty float z\nend_header\n0.123456789"));
  CHECK_FALSE(of("cut.ply", "ply\nformat ascii 1.0\nelement vertex 12"));
  CHECK_FALSE(of("cut.vtp", "<Points><DataArray format=\"ascii\""));
  // Only the heights z are rounded; x and y lie on a grid and are exact.
  std::string field;
  for (int i = 0; i < points; ++i)
    field += "v " + text("%.2g", 0.1 * i) + " 0.5 " + text("%.9g", coordinate(i, 0)) + "\n";
  const auto heights = of("field.obj", field);
  REQUIRE(heights);
  CHECK((heights->digits == 9 && heights->unit == Approx(1e-8)));
  CHECK_THROWS_AS(printed_digits(scratch / "missing.obj"), InputError);
}
