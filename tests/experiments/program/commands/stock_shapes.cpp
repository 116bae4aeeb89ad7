#include "tests/experiments/program/commands/stock_shapes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>

#include "compare/problem/text.hpp"

namespace ogc::tests {

namespace {

using compare::Index;
using compare::shortest;
using compare::Vec3;
using std::numbers::pi;

/// Returns a grid of quads; `place` maps (u, v) in [0, 1]² to a position. `closes_u` and `closes_v` join opposite
/// sides.
StockShape net(const std::string& name, Index rows, Index columns, bool closes_u, bool closes_v,
               const std::function<Vec3(double, double)>& place) {
  StockShape shape{name, {}, {}};
  for (Index i = 0; i < rows; ++i) {
    for (Index j = 0; j < columns; ++j)
      shape.positions.push_back(
          place(double(i) / (closes_u ? rows : rows - 1), double(j) / (closes_v ? columns : columns - 1)));
  }
  for (Index i = 0; i + (closes_u ? 0 : 1) < rows; ++i) {
    for (Index j = 0; j + (closes_v ? 0 : 1) < columns; ++j) {
      const Index next_i = (i + 1) % rows, next_j = (j + 1) % columns;
      shape.faces.push_back({i * columns + j, next_i * columns + j, next_i * columns + next_j, i * columns + next_j});
    }
  }
  return shape;
}

std::vector<Index> ring(Index first, Index count, bool turned) {
  std::vector<Index> face;
  for (Index k = 0; k < count; ++k) face.push_back(first + (turned ? count - 1 - k : k));
  return face;
}

/// Returns a closed bar: quads along its sides, and one polygon at each end.
StockShape bar(const std::string& name, Index count, const std::function<double(Index)>& radius) {
  StockShape shape = net(name, 2, count, false, true, [&](double u, double v) {
    const double r = radius(static_cast<Index>(std::lround(v * count))), angle = 2 * pi * v;
    return Vec3{r * std::cos(angle), u, r * std::sin(angle)};
  });
  shape.faces.push_back(ring(0, count, false));
  shape.faces.push_back(ring(count, count, true));
  return shape;
}

StockShape cone(Index count) {
  StockShape shape{"cone", {}, {ring(0, count, false)}};
  for (Index k = 0; k < count; ++k)
    shape.positions.push_back({0, std::cos(2 * pi * k / count), std::sin(2 * pi * k / count)});
  shape.positions.push_back({1, 0, 0});
  for (Index k = 0; k < count; ++k) shape.faces.push_back({(k + 1) % count, k, count});
  return shape;
}

StockShape sphere(Index rings, Index count) {
  StockShape shape = net("sphere", rings, count, false, true, [&](double u, double v) {
    const double polar = pi * (u * (rings - 1) + 1) / (rings + 1);
    return Vec3{0.5 * std::sin(polar) * std::cos(2 * pi * v), 0.5 * std::cos(polar),
                0.5 * std::sin(polar) * std::sin(2 * pi * v)};
  });
  const auto north = static_cast<Index>(shape.positions.size()), south = north + 1;
  shape.positions.insert(shape.positions.end(),
                         {{0, 0.5 * std::cos(0.0), 0}, {0.5 * std::sin(pi), 0.5 * std::cos(pi), 0}});
  for (Index k = 0; k < count; ++k) {
    shape.faces.push_back({north, k, (k + 1) % count});
    shape.faces.push_back({south, (rings - 1) * count + (k + 1) % count, (rings - 1) * count + k});
  }
  return shape;
}

/// Returns a cube after two rotations by 90°, which leave tiny coordinates instead of zeros.
StockShape box() {
  StockShape shape{"box", {}, {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}};
  const double c = std::cos(pi / 2), s = std::sin(pi / 2);
  for (int k = 0; k < 8; ++k) {
    const Vec3 p{k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : 0.0, k & 4 ? 0.5 : -0.5};
    const Vec3 once{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    shape.positions.push_back({once.x, c * once.y - s * once.z, s * once.y + c * once.z});
  }
  return shape;
}

StockShape moebius() {
  StockShape shape = net("moebius", 24, 4, true, false, [](double u, double v) {
    const double turn = 2 * pi * u, across = 0.3 * (v - 0.5);
    return Vec3{(1 + across * std::cos(turn / 2)) * std::cos(turn), (1 + across * std::cos(turn / 2)) * std::sin(turn),
                across * std::sin(turn / 2)};
  });
  // The strip is twisted by 180°, so its end is joined upside down to its beginning.
  for (std::size_t f = shape.faces.size() - 3; f < shape.faces.size(); ++f) {
    for (Index& v : shape.faces[f]) v = v < 4 ? 3 - v : v;
  }
  return shape;
}

std::string line(std::initializer_list<std::string> words, const std::string& end = "\n") {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text + end;
}

template <class Number>
void append(std::string& bytes, Number value, bool big_endian = false) {
  auto raw = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if (big_endian) std::ranges::reverse(raw);
  bytes.append(raw.data(), raw.size());
}

void append_point(std::string& bytes, const Vec3& p) {
  for (const double x : {p.x, p.y, p.z}) append(bytes, static_cast<float>(x));
}

template <class Use>
void each_facet(const StockShape& shape, const Use& use) {
  const auto at = [&](Index v) { return shape.positions[static_cast<std::size_t>(v)]; };
  for (const auto& face : shape.faces) {
    for (std::size_t k = 1; k + 1 < face.size(); ++k) use(at(face[0]), at(face[k]), at(face[k + 1]));
  }
}

std::string padded(std::string text, char with) {
  while (text.size() % 4 != 0) text += with;
  return text;
}

}  // namespace

std::size_t StockShape::triangles() const {
  std::size_t count = 0;
  for (const auto& face : faces) count += face.size() - 2;
  return count;
}

bool StockShape::has_dust() const {
  double largest = 0;
  for (const Vec3& p : positions) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const auto is_dust = [&](double x) { return x != 0 && std::abs(x) < 0x1p-40 * largest; };
  return std::ranges::any_of(positions, [&](const Vec3& p) { return is_dust(p.x) || is_dust(p.y) || is_dust(p.z); });
}

bool StockShape::has_polygons() const {
  return std::ranges::any_of(faces, [](const auto& face) { return face.size() > 3; });
}

std::vector<StockShape> stock_shapes() {
  const auto angle = [](double v) { return 2 * pi * v; };
  StockShape polygon{"polygon", {}, {ring(0, 6, false)}};
  for (int k = 0; k < 6; ++k) polygon.positions.push_back({std::cos(pi * k / 3), std::sin(pi * k / 3), 0});
  return {
      net("plane", 7, 9, false, false,
          [](double u, double v) {
            return Vec3{std::cos(pi / 2) * (u - 0.5), v - 0.5, std::sin(pi / 2) * (u - 0.5)};
          }),
      net("disc", 4, 24, false, true,
          [&](double u, double v) {
            return Vec3{(0.25 + 0.25 * u) * std::cos(angle(v)), (0.25 + 0.25 * u) * std::sin(angle(v)), 0};
          }),
      polygon,
      bar("cylinder", 32, [](Index) { return 0.5; }),
      bar("star", 14, [](Index k) { return k % 2 == 0 ? 0.5 : 0.2; }),
      cone(12),
      sphere(8, 16),
      net("torus", 24, 12, true, true,
          [&](double u, double v) {
            const double r = 0.5 + 0.2 * std::cos(angle(v));
            return Vec3{r * std::cos(angle(u)), r * std::sin(angle(u)), 0.2 * std::sin(angle(v))};
          }),
      box(),
      net("tube", 40, 6, false, true,
          [&](double u, double v) {
            const double turn = 4 * pi * u, r = 0.5 + 0.1 * std::cos(angle(v));
            return Vec3{r * std::cos(turn), u + 0.1 * std::sin(angle(v)), r * std::sin(turn)};
          }),
      moebius(),
  };
}

std::string plain_obj(const StockShape& shape) {
  std::string text;
  for (const Vec3& p : shape.positions) text += line({"v", shortest(p.x), shortest(p.y), shortest(p.z)});
  for (const auto& face : shape.faces) {
    text += "f";
    for (const Index v : face) text += " " + std::to_string(v + 1);
    text += "\n";
  }
  return text;
}

std::string dressed_obj(const StockShape& shape) {
  std::string text = "# as a modeller writes it\r\nmtllib none.mtl\r\no " + shape.name +
                     "\r\nv 7 7 7\r\nvt 0 0\r\nvn 0 0 1\r\ng all\r\n";
  for (const Vec3& p : shape.positions)
    text += line({"v", shortest(p.x), shortest(p.y), shortest(p.z), "0.5 0.5 0.5"}, "\r\n");
  text += "s 1\r\nusemtl none\r\n";
  for (const auto& face : shape.faces) {
    text += "f";
    for (const Index v : face) text += " " + std::to_string(v - static_cast<Index>(shape.positions.size())) + "/1/1";
    text += "\r\n";
  }
  return text;
}

std::string ascii_ply(const StockShape& shape) {
  std::string text = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex " +
                     std::to_string(shape.positions.size() + 1) +
                     "\nproperty float64 x\nproperty float64 y\nproperty float64 z\nproperty uint8 red\nelement face " +
                     std::to_string(shape.faces.size()) +
                     "\nproperty list uint8 int32 vertex_indices\nproperty float32 quality\nend_header\n7 7 7 0\n";
  for (const Vec3& p : shape.positions) text += line({shortest(p.x), shortest(p.y), shortest(p.z), "255"});
  for (const auto& face : shape.faces) {
    text += std::to_string(face.size());
    for (const Index v : face) text += " " + std::to_string(v + 1);
    text += " 0.5\n";
  }
  return text;
}

std::string little_endian_ply(const StockShape& shape) {
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(shape.positions.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement material 1\nproperty double "
                      "shine\nelement face " +
                      std::to_string(shape.faces.size()) +
                      "\nproperty list uchar int vertex_index\nproperty list uchar float texcoord\nend_header\n";
  for (const Vec3& p : shape.positions) append_point(bytes, p);
  append(bytes, 1.0);
  for (const auto& face : shape.faces) {
    append(bytes, static_cast<std::uint8_t>(face.size()));
    for (const Index v : face) append(bytes, v);
    append(bytes, std::uint8_t{2});
    append_point(bytes, {0, 0, 0});
    bytes.resize(bytes.size() - 4);
  }
  return bytes;
}

std::string big_endian_ply(const StockShape& shape) {
  std::string bytes = "ply\nformat binary_big_endian 1.0\nelement vertex " + std::to_string(shape.positions.size()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(shape.faces.size()) + "\nproperty list uint uint vertex_indices\nend_header\n";
  for (const Vec3& p : shape.positions) {
    for (const double x : {p.x, p.y, p.z}) append(bytes, x, true);
  }
  for (const auto& face : shape.faces) {
    append(bytes, static_cast<std::uint32_t>(face.size()), true);
    for (const Index v : face) append(bytes, static_cast<std::uint32_t>(v), true);
  }
  return bytes;
}

std::string ascii_stl(const StockShape& shape) {
  std::string text = "solid " + shape.name + "\n";
  each_facet(shape, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    text += "facet normal 0 0 1\nouter loop\n";
    for (const Vec3& p : {a, b, c}) text += line({"vertex", shortest(p.x), shortest(p.y), shortest(p.z)});
    text += "endloop\nendfacet\n";
  });
  return text + "endsolid " + shape.name + "\n";
}

std::string binary_stl(const StockShape& shape) {
  std::string bytes(80, ' ');
  append(bytes, static_cast<std::uint32_t>(shape.triangles()));
  each_facet(shape, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const Vec3& p : {Vec3{0, 0, 1}, a, b, c}) append_point(bytes, p);
    append(bytes, std::uint16_t{0});
  });
  return bytes;
}

std::string off(const StockShape& shape) {
  std::string text = "OFF\n" + line({std::to_string(shape.positions.size()), std::to_string(shape.faces.size()), "0"});
  for (const Vec3& p : shape.positions) text += line({shortest(p.x), shortest(p.y), shortest(p.z)});
  for (const auto& face : shape.faces) {
    text += std::to_string(face.size());
    for (const Index v : face) text += " " + std::to_string(v);
    text += "\n";
  }
  return text;
}

std::string glb(const StockShape& shape) {
  std::string corners;
  each_facet(shape, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    for (const Vec3& p : {a, b, c}) append_point(corners, p);
  });
  const std::string size = std::to_string(corners.size()), count = std::to_string(corners.size() / 12);
  const std::string json = padded(
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"translation":[0,4,0]}],)"
      R"("meshes":[{"primitives":[{"attributes":)"
      R"({"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":)" +
          count + R"(,"type":"VEC3","min":[-2,-2,-2],"max":[2,2,2]}],"bufferViews":[{"buffer":0,"byteLength":)" + size +
          R"(}],"buffers":[{"byteLength":)" + size + "}]}",
      ' ');
  std::string bytes = "glTF";
  for (const std::size_t number : {std::size_t{2}, 28 + json.size() + corners.size(), json.size()})
    append(bytes, static_cast<std::uint32_t>(number));
  bytes += "JSON" + json;
  append(bytes, static_cast<std::uint32_t>(corners.size()));
  return bytes + std::string("BIN\0", 4) + corners;
}

}  // namespace ogc::tests
