// Welds vertices, cuts faces, leaves out unused vertices: each where it is needed, with a sentence for the user.
#include "compare/files/meshes/polygon_mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <unordered_map>

#include "compare/files/meshes/triangulate.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/tetrahedra.hpp"

namespace ogc::compare {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::string counted(std::size_t count, const std::string& noun) {
  return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

struct PositionHash {
  std::size_t operator()(const Vec3& p) const {
    std::size_t hash = 0;
    for (const double x : {p.x, p.y, p.z})
      hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15 + (hash >> 29);  // + 0: −0 is 0
    return hash;
  }
};

class MeshMaker {
 public:
  MeshMaker(PolygonMesh polygons, const MeshOptions& options) : in_(std::move(polygons)), options_(options) {}

  LoadedMesh make() {
    out_.notes = std::move(in_.notes);
    if (options_.weld || !in_.source.shares_vertices) weld();
    cut();
    out_.mesh.positions = std::move(in_.positions);
    out_.mesh.loose_edges = std::move(in_.loose_edges);
    out_.mesh.tetrahedra = std::move(in_.tetrahedra);
    if (out_.mesh.triangles.empty() && out_.mesh.loose_edges.empty() && out_.mesh.tetrahedra.empty())
      throw InputError(in_.source.file + ": has " + counted(out_.mesh.positions.size(), "vertex position") +
                       " and no face; give a mesh, not a cloud of points");
    if (!options_.keep_unused) leave_out_unused();
    if (!out_.mesh.tetrahedra.empty()) out_.mesh.triangles = boundary_triangles(out_.mesh.tetrahedra);
    out_.source = std::move(in_.source);
    return std::move(out_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError(in_.source.file + ": " + what); }

  void note(const std::string& text) { out_.notes.push_back(in_.source.file + ": " + text); }

  std::string face_name(std::size_t f) const {
    const std::vector<std::size_t>& lines = in_.source.face_lines;
    return "face " + std::to_string(static_cast<Index>(f) + in_.source.first) +
           (f < lines.size() ? " (line " + std::to_string(lines[f]) + ")" : "");
  }

  /// Each vertex becomes the first one at its position.
  void weld() {
    std::unordered_map<Vec3, Index, PositionHash> first_at;
    std::vector<Index> kept, renamed;
    first_at.reserve(in_.positions.size());
    for (std::size_t v = 0; v < in_.positions.size(); ++v) {
      const auto [first, is_new] = first_at.try_emplace(in_.positions[v], static_cast<Index>(kept.size()));
      if (is_new) kept.push_back(static_cast<Index>(v));
      renamed.push_back(first->second);
    }
    if (!in_.source.shares_vertices) name_by_faces(kept);
    const std::size_t merged = in_.positions.size() - kept.size();
    if (merged == 0) return;
    in_.source.vertices = kept;
    for (std::size_t k = 0; k < kept.size(); ++k) in_.positions[k] = in_.positions[at(kept[k])];
    in_.positions.resize(kept.size());
    for (Index& c : in_.corners) c = renamed[at(c)];
    for (Tetrahedron& t : in_.tetrahedra)
      for (Index& c : t) c = renamed[at(c)];
    for (Edge& e : in_.loose_edges)
      e = {std::min(renamed[at(e[0])], renamed[at(e[1])]), std::max(renamed[at(e[0])], renamed[at(e[1])])};
    note(counted(merged, "corner") + " with exactly the coordinates of another " + (merged == 1 ? "was" : "were") +
         " merged with it: " + std::to_string(kept.size()) + " vertices are left");
  }

  void name_by_faces(const std::vector<Index>& kept) {
    std::vector<Index> first_face(in_.positions.size());
    for (std::size_t f = in_.face_count(); f-- > 0;) {
      for (const Index c : in_.face(f)) first_face[at(c)] = static_cast<Index>(f);
    }
    for (const Index v : kept) in_.source.first_faces.push_back(first_face[at(v)]);
  }

  void cut() {
    std::size_t cut_faces = 0, made = 0, first = 0;
    std::vector<Index> numbers, corners;
    for (std::size_t f = 0; f < in_.face_count(); ++f) {
      corners.assign(in_.face(f).begin(), in_.face(f).end());
      if (corners.size() > 3) {
        if (cut_faces++ == 0) first = f;
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
      }
      const std::size_t before = out_.mesh.triangles.size();
      add_triangles(f, corners);
      numbers.insert(numbers.end(), out_.mesh.triangles.size() - before, static_cast<Index>(f));
      if (in_.face(f).size() > 3) made += out_.mesh.triangles.size() - before;
    }
    if (cut_faces == 0) return;
    in_.source.faces = std::move(numbers);
    const std::string more = counted(cut_faces, "face") + " of more than three corners";
    if (!options_.triangulate)
      fail("has " + more + ", the first: " + face_name(first) + " of " + std::to_string(in_.face(first).size()) +
           "; take --triangulate, or triangulate the mesh");
    note(more + (cut_faces == 1 ? " was" : " were") + " cut into " + counted(made, "triangle"));
  }

  void add_triangles(std::size_t f, const std::vector<Index>& corners) {
    if (corners.size() < 3) fail(face_name(f) + ": names less than three different vertices; remove it");
    if (corners.size() == 3) return out_.mesh.triangles.push_back({corners[0], corners[1], corners[2]});
    if (!options_.triangulate) return;
    const std::vector<Triangle> triangles = triangulate(corners, in_.positions);
    if (triangles.empty())
      fail(face_name(f) + ": its " + std::to_string(corners.size()) +
           " corners make no simple polygon: it has no area or crosses itself; mend it or cut it by hand");
    out_.mesh.triangles.insert(out_.mesh.triangles.end(), triangles.begin(), triangles.end());
  }

  void leave_out_unused() {
    std::vector<Index> renamed(out_.mesh.positions.size(), -1);
    const auto use = [&](const auto& face) {
      for (const Index v : face) renamed[at(v)] = 0;
    };
    std::ranges::for_each(out_.mesh.triangles, use);
    std::ranges::for_each(out_.mesh.loose_edges, use);
    std::ranges::for_each(out_.mesh.tetrahedra, use);
    const auto first = static_cast<Index>(std::ranges::find(renamed, -1) - renamed.begin());
    const auto unused = static_cast<std::size_t>(std::ranges::count(renamed, -1));
    if (unused == 0) return;
    const std::string what = counted(unused, "vertex position") + " that no face and no edge uses";
    const std::string name = ElementNames(in_.source).vertex(first);
    if (!options_.drop_unused) fail("has " + what + ", the first: " + name + "; take --drop-unused, or remove them");
    renumber(renamed);
    note(what + (unused == 1 ? " was" : " were") + " left out, the first: " + name);
  }

  /// `used`: 0 for vertices that stay, −1 for others.
  void renumber(std::vector<Index>& used) {
    std::vector<Index> numbers, faces;
    std::vector<Vec3> positions;
    for (std::size_t v = 0; v < used.size(); ++v) {
      if (used[v] < 0) continue;
      used[v] = static_cast<Index>(positions.size());
      positions.push_back(out_.mesh.positions[v]);
      numbers.push_back(in_.source.vertices.empty() ? static_cast<Index>(v) : in_.source.vertices[v]);
      if (!in_.source.first_faces.empty()) faces.push_back(in_.source.first_faces[v]);
    }
    const auto rename = [&](auto& face) {
      for (Index& v : face) v = used[at(v)];
    };
    std::ranges::for_each(out_.mesh.triangles, rename);
    std::ranges::for_each(out_.mesh.loose_edges, rename);
    std::ranges::for_each(out_.mesh.tetrahedra, rename);
    out_.mesh.positions = std::move(positions);
    in_.source.vertices = std::move(numbers);
    in_.source.first_faces = std::move(faces);
  }

  PolygonMesh in_;
  MeshOptions options_;
  LoadedMesh out_;
};

}  // namespace

void PolygonMesh::add_face(std::span<const Index> face) {
  corners.insert(corners.end(), face.begin(), face.end());
  face_ends.push_back(static_cast<Index>(corners.size()));
}

LoadedMesh make_mesh(PolygonMesh polygons, const MeshOptions& options) {
  return MeshMaker(std::move(polygons), options).make();
}

}  // namespace ogc::compare
