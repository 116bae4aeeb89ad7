#include "compare/files/meshes/gltf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "compare/files/meshes/gltf_buffers.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {
namespace {

/// The transformation of a node, x ↦ A x + t: the columns of A and t one after the other.
using Transform = std::array<double, 12>;
constexpr Transform identity{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

Vec3 apply(const Transform& m, const Vec3& p) {
  return {m[0] * p.x + m[3] * p.y + m[6] * p.z + m[9], m[1] * p.x + m[4] * p.y + m[7] * p.z + m[10],
          m[2] * p.x + m[5] * p.y + m[8] * p.z + m[11]};
}

/// Returns the transformation x ↦ outer(inner(x)).
Transform chained(const Transform& outer, const Transform& inner) {
  Transform both{};
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) {
      double sum = column == 3 ? outer[9 + row] : 0;
      for (std::size_t k = 0; k < 3; ++k) sum += outer[3 * k + row] * inner[3 * column + k];
      both[3 * column + row] = sum;
    }
  }
  return both;
}

/// glTF's numbers for the kinds of primitives.
enum class Mode : std::size_t { points, lines, line_loop, line_strip, triangles, strip, fan, count };

class GltfReader {
 public:
  GltfReader(std::string_view bytes, const std::string& name) : most_corners_(bytes.size()), buffers_(bytes, name) {
    mesh_.source.file = name;
    mesh_.source.shares_vertices = false;
  }

  PolygonMesh read() {
    std::vector<std::pair<std::size_t, Transform>> open;  // nodes to visit, the next one last
    const std::vector<std::size_t> roots = roots_of_scene();
    for (const std::size_t root : roots) open.emplace_back(root, identity);
    std::ranges::reverse(open);
    std::vector<bool> visited(size_of("nodes"));
    while (!open.empty()) {
      const auto [number, outer] = open.back();
      open.pop_back();
      const std::string owner = "node " + std::to_string(number);
      const Json& node = buffers_.entry("nodes", number, "the scene");
      if (visited[number]) buffers_.fail(owner + " has two parents or is its own ancestor; nodes make a tree");
      visited[number] = true;
      const Transform transform = chained(outer, transform_of(node, owner));
      if (node.contains("mesh")) add_mesh(buffers_.whole(node, "mesh", owner), transform, owner);
      std::vector<std::size_t> children = numbers(node, "children", owner);
      for (const std::size_t child : children) buffers_.entry("nodes", child, owner);
      std::ranges::reverse(children);
      for (const std::size_t child : children) open.emplace_back(child, transform);
    }
    if (points_ > 0)
      mesh_.notes.push_back(mesh_.source.file + ": " + std::to_string(points_) + " single points were left out");
    return std::move(mesh_);
  }

 private:
  std::size_t size_of(const char* list) const {
    const auto found = buffers_.root().find(list);
    return found == buffers_.root().end() || !found->is_array() ? 0 : found->size();
  }

  std::vector<std::size_t> numbers(const Json& object, const char* key, const std::string& owner) const {
    std::vector<std::size_t> list;
    const auto found = object.find(key);
    if (found == object.end()) return list;
    if (!found->is_array()) buffers_.fail(owner + ": '" + key + "' is no list");
    for (const Json& number : *found) {
      if (!number.is_number_unsigned()) buffers_.fail(owner + ": '" + key + "' has an entry that is no whole number");
      list.push_back(number.get<std::size_t>());
    }
    return list;
  }

  std::vector<std::size_t> roots_of_scene() {
    const std::size_t scenes = size_of("scenes");
    if (scenes == 0) buffers_.fail("has no scene; write its meshes as nodes of one");
    if (scenes > 1)
      mesh_.notes.push_back(mesh_.source.file + ": " + std::to_string(scenes) +
                            " scenes; one was read, the others were left out");
    const std::size_t scene = buffers_.whole(buffers_.root(), "scene", "the file", 0);
    return numbers(buffers_.entry("scenes", scene, "the file"), "nodes", "scene " + std::to_string(scene));
  }

  /// Returns the `count` numbers under `key`, or `list` if the node lacks the key.
  template <std::size_t count>
  std::array<double, count> values(const Json& node, const char* key, std::array<double, count> list,
                                   const std::string& owner) const {
    const auto found = node.find(key);
    if (found == node.end()) return list;
    const auto is_number = [](const Json& value) { return value.is_number(); };
    if (!found->is_array() || found->size() != count || !std::ranges::all_of(*found, is_number))
      buffers_.fail(owner + ": '" + key + "' are not " + std::to_string(count) + " numbers");
    for (std::size_t k = 0; k < count; ++k) list[k] = (*found)[k].template get<double>();
    return list;
  }

  Transform transform_of(const Json& node, const std::string& owner) const {
    if (node.contains("matrix")) {
      const auto m = values<16>(node, "matrix", {}, owner);
      return {m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10], m[12], m[13], m[14]};
    }
    const auto t = values<3>(node, "translation", {0, 0, 0}, owner), s = values<3>(node, "scale", {1, 1, 1}, owner);
    const auto [x, y, z, w] = values<4>(node, "rotation", {0, 0, 0, 1}, owner);
    return {s[0] * (1 - 2 * (y * y + z * z)),
            s[0] * 2 * (x * y + z * w),
            s[0] * 2 * (x * z - y * w),
            s[1] * 2 * (x * y - z * w),
            s[1] * (1 - 2 * (x * x + z * z)),
            s[1] * 2 * (y * z + x * w),
            s[2] * 2 * (x * z + y * w),
            s[2] * 2 * (y * z - x * w),
            s[2] * (1 - 2 * (x * x + y * y)),
            t[0],
            t[1],
            t[2]};
  }

  void add_mesh(std::size_t number, const Transform& transform, const std::string& user) {
    const Json& mesh = buffers_.entry("meshes", number, user);
    const std::string owner = "mesh " + std::to_string(number);
    const auto primitives = mesh.find("primitives");
    if (primitives == mesh.end() || !primitives->is_array()) buffers_.fail(owner + " has no 'primitives'");
    for (std::size_t p = 0; p < primitives->size(); ++p)
      add_primitive((*primitives)[p], transform, owner + ", primitive " + std::to_string(p));
  }

  void add_primitive(const Json& primitive, const Transform& transform, const std::string& owner) {
    const auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object() || !attributes->contains("POSITION"))
      buffers_.fail(owner + " has no positions");
    const std::size_t mode = buffers_.whole(primitive, "mode", owner, static_cast<std::size_t>(Mode::triangles));
    if (mode >= static_cast<std::size_t>(Mode::count)) buffers_.fail(owner + " has an unknown 'mode'");
    const std::vector<double> x = buffers_.read(buffers_.whole(*attributes, "POSITION", owner), "VEC3", owner);
    std::vector<double> corners;
    if (primitive.contains("indices")) {
      corners = buffers_.read(buffers_.whole(primitive, "indices", owner), "SCALAR", owner);
    } else {
      for (std::size_t k = 0; k < x.size() / 3; ++k) corners.push_back(static_cast<double>(k));
    }
    const std::size_t each = mode == static_cast<std::size_t>(Mode::triangles) ? 3
                             : mode == static_cast<std::size_t>(Mode::lines)   ? 2
                                                                               : 1;
    if (corners.size() % each != 0)
      buffers_.fail(owner + " has " + std::to_string(corners.size()) + " corners, no multiple of " +
                    std::to_string(each) + ": the file is truncated or damaged");
    expect_few(corners.size());
    add_faces(static_cast<Mode>(mode), place(x, corners, transform, owner));
  }

  /// Fails if nodes repeat meshes too often. Without repetition a corner takes at least one byte of the file or of a
  /// buffer in another file, but nodes may name one mesh any number of times.
  void expect_few(std::size_t corners) {
    constexpr std::size_t repeated = std::size_t{1} << 19;  // corners; the finished mesh has about 100 bytes for each
    corners_ += corners;
    if (corners_ > most_corners_ + buffers_.bytes_beside() + repeated)
      buffers_.fail("has nodes that repeat meshes until they have " + std::to_string(corners_) +
                    " corners and more, of a file of " + std::to_string(most_corners_) +
                    " bytes; write it with a mesh for each node");
  }

  /// Adds all vertices that occur in `corners` to the mesh, transformed. Returns the corners as indices of the mesh's
  /// vertices.
  std::vector<Index> place(const std::vector<double>& x, const std::vector<double>& corners, const Transform& transform,
                           const std::string& owner) {
    std::vector<Index> number(x.size() / 3, -1), placed;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      if (!(corners[k] >= 0 && corners[k] < static_cast<double>(number.size()) && corners[k] == std::floor(corners[k])))
        buffers_.fail(owner + ", corner " + std::to_string(k) + " (of triangle " + std::to_string(k / 3) +
                      " if it is a list of triangles): vertex " + shortest(corners[k]) +
                      " does not exist; the primitive has " + std::to_string(number.size()) + ", numbered from 0");
      const auto v = static_cast<std::size_t>(corners[k]);
      if (number[v] < 0) {
        const Vec3 point{x[3 * v], x[3 * v + 1], x[3 * v + 2]};
        const Vec3 p = transform == identity ? point : apply(transform, point);
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
          buffers_.fail(owner + ", vertex " + std::to_string(v) +
                        ": a coordinate is not finite; give three finite numbers [m]");
        if (mesh_.positions.size() >= static_cast<std::size_t>(std::numeric_limits<Index>::max()))
          buffers_.fail("has 2³¹ vertices and more; give a smaller mesh");
        number[v] = static_cast<Index>(mesh_.positions.size());
        mesh_.positions.push_back(p);
      }
      placed.push_back(number[v]);
    }
    return placed;
  }

  void add_faces(Mode mode, const std::vector<Index>& c) {
    const auto line = [&](Index a, Index b) { mesh_.loose_edges.push_back({std::min(a, b), std::max(a, b)}); };
    switch (mode) {
      case Mode::points: points_ += c.size(); break;
      case Mode::lines:
        for (std::size_t k = 1; k < c.size(); k += 2) line(c[k - 1], c[k]);
        break;
      case Mode::line_loop:
      case Mode::line_strip:
        for (std::size_t k = 1; k < c.size(); ++k) line(c[k - 1], c[k]);
        if (mode == Mode::line_loop && c.size() > 2) line(c.back(), c.front());
        break;
      case Mode::triangles:
        for (std::size_t k = 2; k < c.size(); k += 3) mesh_.add_face(std::array{c[k - 2], c[k - 1], c[k]});
        break;
      case Mode::strip:  // every second triangle is reversed
        for (std::size_t k = 2; k < c.size(); ++k) mesh_.add_face(std::array{c[k - 2], c[k - 1 + k % 2], c[k - k % 2]});
        break;
      case Mode::fan:
        for (std::size_t k = 2; k < c.size(); ++k) mesh_.add_face(std::array{c[0], c[k - 1], c[k]});
        break;
      case Mode::count: break;
    }
  }

  std::size_t most_corners_;  ///< most corners without repeated meshes: one for each byte of the file
  GltfBuffers buffers_;
  std::size_t points_ = 0, corners_ = 0;
  PolygonMesh mesh_;
};

}  // namespace

PolygonMesh parse_gltf(std::string_view bytes, const std::string& name) { return GltfReader(bytes, name).read(); }

}  // namespace ogc::compare
