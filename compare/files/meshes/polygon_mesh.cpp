// Welds vertices, cuts faces, leaves out unused vertices and degenerate or repeated faces, and reorders the vertices of
// inverted tetrahedra. Each change gives a sentence for the user.
#include "compare/files/meshes/polygon_mesh.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <unordered_map>

#include "compare/files/meshes/triangulate.hpp"
#include "compare/problem/dust.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/local_origin.hpp"
#include "compare/problem/scene.hpp"
#include "compare/problem/tetrahedra.hpp"
#include "compare/problem/text.hpp"
#include "compare/problem/zero_area.hpp"

namespace ogc::compare {
namespace {

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

/// Returns the positions as stages see them: dust (compare/problem/dust.hpp) is set to 0, and coordinates are rounded
/// to single precision.
std::vector<Vec3> as_stages_see(const std::vector<Vec3>& positions) {
  Mesh copy{positions, {}, {}};
  clear_dust(copy);
  return to_double(to_single(copy.positions));
}

/// Decides exactly whether a triangle has no area. If a coordinate is too large or too small for that, decides only
/// whether corners coincide.
bool has_no_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  if (a == b || b == c || c == a) return true;
  for (const Vec3& p : {a, b, c})
    for (const double x : {p.x, p.y, p.z})
      if (x != 0 && !(std::abs(x) >= 0x1p-450 && std::abs(x) <= 0x1p450)) return false;
  return has_zero_area(a, b, c);
}

bool is_empty(const Mesh& mesh) {
  bool empty = true;
  for_each_of<MeshLists>([&]<class List, std::size_t>() { empty = empty && (mesh.*List::list).empty(); });
  return empty;
}

template <class AnyMesh, class Visit>
void each_element(AnyMesh& mesh, const Visit& visit) {
  for_each_of<MeshLists>([&]<class List, std::size_t>() { std::ranges::for_each(mesh.*List::list, visit); });
}

class MeshMaker {
 public:
  MeshMaker(PolygonMesh polygons, const MeshOptions& options) : in_(std::move(polygons)), options_(options) {}

  LoadedMesh make() {
    out_.notes = std::move(in_.notes);
    if (options_.weld || !in_.source.shares_vertices) weld();
    if (options_.local) take_local();
    seen_ = in_.positions;
    if (options_.rounded) seen_ = as_stages_see(in_.positions);
    cut();
    leave_out_degenerate();
    leave_out_doubled();
    if (!options_.keep_unused) turn_inverted();
    in_.triangles = std::move(out_.mesh.triangles);
    out_.mesh = std::move(static_cast<Mesh&>(in_));
    if (is_empty(out_.mesh))
      fail("has " + counted(out_.mesh.positions.size(), "vertex position") + " and no face" +
           (in_.face_count() == 0 ? "; give a mesh, not a cloud of points"
                                  : " that has an area; the first that has none: " + face_name(first_left_out_)));
    if (!options_.keep_unused) leave_out_unused();
    if (has_volume(out_.mesh)) out_.mesh.triangles = surface_triangles(out_.mesh);
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

  void take_local() {
    out_.origin = local_origin(in_.positions);
    if (out_.origin == Vec3{}) return;
    const auto& [x, y, z] = out_.origin;
    note(describe_origin(in_.positions, out_.origin,
                         "positions are taken relative to (" + shortest(x) + ", " + shortest(y) + ", " + shortest(z) +
                             "), so that single precision keeps them; ogc export adds it again"));
    in_.positions = relative_to(out_.origin, std::move(in_.positions));
  }

  /// Replaces each vertex by the first one at its position.
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
    each_element(in_, [&]<std::size_t corners>(std::array<Index, corners>& element) {
      for (Index& c : element) c = renamed[at(c)];
      if (corners == 2) std::ranges::sort(element);
    });
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

  /// Cuts all faces into triangles, and stores the index of each triangle's face. Some triangles may name a vertex
  /// twice.
  void cut() {
    std::size_t cut_faces = 0, made = 0, first = 0;
    std::vector<Index> corners;
    for (std::size_t f = 0; f < in_.face_count(); ++f) {
      corners.assign(in_.face(f).begin(), in_.face(f).end());
      const bool is_large = corners.size() > 3;
      if (is_large) {
        corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
        while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
      }
      const std::size_t before = out_.mesh.triangles.size();
      const bool is_face = add_triangles(f, corners);
      numbers_.insert(numbers_.end(), out_.mesh.triangles.size() - before, static_cast<Index>(f));
      if (!is_large || !is_face) continue;
      if (cut_faces++ == 0) first = f;
      made += out_.mesh.triangles.size() - before;
    }
    if (cut_faces == 0) return;
    const std::string more = counted(cut_faces, "face") + " of more than three corners";
    if (!options_.triangulate)
      fail("has " + more + ", the first: " + face_name(first) + " of " + std::to_string(in_.face(first).size()) +
           "; take --triangulate, or triangulate the mesh");
    note(more + (cut_faces == 1 ? " was" : " were") + " cut into " + counted(made, "triangle"));
  }

  /// Adds the triangles of face f. Returns false if the corners make no face; the face is then left out.
  bool add_triangles(std::size_t f, const std::vector<Index>& corners) {
    if (corners.size() < 3) return leave_out(f, collapsed_);
    std::vector<Triangle>& triangles = out_.mesh.triangles;
    if (corners.size() == 3) {
      triangles.push_back({corners[0], corners[1], corners[2]});
    } else if (options_.triangulate) {
      const std::vector<Triangle> made = triangulate(corners, in_.positions);
      if (made.empty() && lie_on_a_line(corners)) return leave_out(f, flat_);
      if (made.empty())
        fail(face_name(f) + ": its " + std::to_string(corners.size()) +
             " corners make no simple polygon: it crosses itself; mend it or cut it by hand");
      triangles.insert(triangles.end(), made.begin(), made.end());
    }
    return true;
  }

  bool lie_on_a_line(const std::vector<Index>& corners) const {
    const auto place = [&](std::size_t k) -> const Vec3& { return in_.positions[at(corners[k])]; };
    std::size_t other = 1;
    while (other < corners.size() && place(other) == place(0)) ++other;
    for (std::size_t k = other + 1; k < corners.size(); ++k)
      if (!has_no_area(place(0), place(other), place(k))) return false;
    return true;
  }

  /// A reason for leaving faces out, and the number of faces that are left out for it.
  struct LeftOut {
    const char* one;   ///< message for one face
    const char* more;  ///< message for several
    std::size_t count = 0;
    std::size_t last = static_cast<std::size_t>(-1);  ///< the face that was counted last
  };

  /// Counts face f as left out for `reason`; several triangles of one face count once. Always returns false, so that
  /// the caller can return the result.
  bool leave_out(std::size_t f, LeftOut& reason) {
    if (reason.last != f) ++reason.count;
    reason.last = f;
    first_left_out_ = std::min(first_left_out_, f);
    return false;
  }

  void leave_out_degenerate() {
    const std::vector<Triangle>& triangles = out_.mesh.triangles;
    const std::vector<bool> repeats = find_repeated();
    std::vector<Triangle> kept;
    std::vector<Index> numbers;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      const std::size_t f = at(numbers_[t]);
      if (a == b || b == c || c == a) {
        leave_out(f, collapsed_);
      } else if (!options_.keep_unused && has_no_area(seen_[at(a)], seen_[at(b)], seen_[at(c)])) {
        leave_out(f, flat_);
      } else if (repeats[t]) {
        leave_out(f, repeated_);
      } else {
        kept.push_back(triangles[t]);
        numbers.push_back(numbers_[t]);
      }
    }
    out_.mesh.triangles = std::move(kept);
    if (numbers.size() != in_.face_count() || !std::ranges::is_sorted(numbers, std::less_equal{}))
      in_.source.faces = std::move(numbers);
    say_left_out();
  }

  /// Returns a flag for each triangle: whether an earlier triangle has the same vertices.
  std::vector<bool> find_repeated() const {
    std::vector<std::pair<Triangle, std::size_t>> sorted;
    sorted.reserve(out_.mesh.triangles.size());
    for (Triangle t : out_.mesh.triangles) {
      std::ranges::sort(t);
      sorted.emplace_back(t, sorted.size());
    }
    std::ranges::sort(sorted);
    std::vector<bool> repeats(sorted.size());
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i].first == sorted[i - 1].first) repeats[sorted[i].second] = true;
    return repeats;
  }

  void say_left_out() {
    std::string reasons;
    std::size_t all = 0;
    for (const LeftOut* reason : {&collapsed_, &flat_, &repeated_}) {
      if (reason->count == 0) continue;
      all += reason->count;
      reasons += (reasons.empty() ? "" : ", ") + std::to_string(reason->count) + " " +
                 (reason->count == 1 ? reason->one : reason->more);
    }
    if (all == 0) return;
    const std::string first = "the first: " + face_name(first_left_out_);
    if (options_.strict)
      fail("has " + counted(all, "face") + " that " + (all == 1 ? "is" : "are") + " none: " + reasons + "; " + first +
           "; leave --strict out, or remove them");
    note(counted(all, "face") + (all == 1 ? " was" : " were") + " left out: " + reasons + "; " + first);
  }

  /// Leaves out each tetrahedron that has the same vertices as an earlier one. If both stayed, none of their faces
  /// would be on the surface.
  void leave_out_doubled() {
    std::vector<std::pair<Tetrahedron, std::size_t>> sorted;
    sorted.reserve(in_.tetrahedra.size());
    for (Tetrahedron t : in_.tetrahedra) {
      std::ranges::sort(t);
      sorted.emplace_back(t, sorted.size());
    }
    std::ranges::sort(sorted);
    // original[t] is the first tetrahedron with the vertices of t, possibly t itself.
    std::vector<std::size_t> original(sorted.size());
    for (std::size_t i = 0, first = 0; i < sorted.size(); ++i) {
      if (sorted[i].first != sorted[first].first) first = i;
      original[sorted[i].second] = sorted[first].second;
    }
    std::vector<std::size_t> doubled;
    for (std::size_t t = 0; t < original.size(); ++t)
      if (original[t] != t) doubled.push_back(t);
    if (doubled.empty()) return;
    const ElementNames names(in_.source);
    const auto name = [&](std::size_t t) { return names.tetrahedron(static_cast<Index>(t), in_.tetrahedra[t]); };
    const std::string all = std::to_string(doubled.size()) + (doubled.size() == 1 ? " tetrahedron" : " tetrahedra"),
                      first = "the first, " + name(doubled[0]) + ", has those of " + name(original[doubled[0]]);
    if (options_.strict)
      fail("has " + all + " with the vertices of another: " + first + "; leave --strict out, or remove them");
    const auto drop = [&](auto& list) {
      std::size_t t = 0;
      if (!list.empty())
        std::erase_if(list, [&](const auto&) {
          const bool is_doubled = original[t] != t;
          ++t;
          return is_doubled;
        });
    };
    drop(in_.tetrahedra), drop(in_.source.tetrahedra), drop(in_.source.tetrahedron_lines);
    note(all + " with the vertices of another " + (doubled.size() == 1 ? "was" : "were") + " left out: " + first);
  }

  /// If all tetrahedra are inverted, exchanges two vertices of each: the file orders vertices by another convention. If
  /// only some are inverted, they stay; validation of a scene refuses them.
  void turn_inverted() {
    if (in_.tetrahedra.empty()) return;
    const std::vector<Vec3> seen = as_stages_see(in_.positions);
    const auto is_turned = [&](const Tetrahedron& t) {
      return orientation(seen[at(t[0])], seen[at(t[1])], seen[at(t[2])], seen[at(t[3])]);
    };
    bool has_inverted = false;
    for (const Tetrahedron& t : in_.tetrahedra) {
      const int side = is_turned(t);
      if (side > 0) return;
      has_inverted |= side < 0;
    }
    if (!has_inverted) return;
    const std::string all = in_.tetrahedra.size() == 1
                                ? "the tetrahedron is"
                                : "all " + std::to_string(in_.tetrahedra.size()) + " tetrahedra are";
    if (options_.strict) fail(all + " inverted; leave --strict out, or exchange two vertices of each");
    for (Tetrahedron& t : in_.tetrahedra) std::swap(t[2], t[3]);
    note(all + " inverted and " + (in_.tetrahedra.size() == 1 ? "was" : "were") +
         " turned: the last two vertices of each were exchanged");
  }

  void leave_out_unused() {
    std::vector<Index> renamed(out_.mesh.positions.size(), -1);
    each_element(out_.mesh, [&](const auto& element) {
      for (const Index v : element) renamed[at(v)] = 0;
    });
    const auto first = static_cast<Index>(std::ranges::find(renamed, -1) - renamed.begin());
    const auto unused = static_cast<std::size_t>(std::ranges::count(renamed, -1));
    if (unused == 0) return;
    const std::string what = counted(unused, "vertex position") + " that no face and no edge uses";
    const std::string name = ElementNames(in_.source).vertex(first);
    if (!options_.drop_unused) fail("has " + what + ", the first: " + name + "; take --drop-unused, or remove them");
    renumber(renamed);
    note(what + (unused == 1 ? " was" : " were") + " left out, the first: " + name);
  }

  /// Renumbers vertices. `used`: 0 for vertices that stay, −1 for others.
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
    each_element(out_.mesh, [&](auto& element) {
      for (Index& v : element) v = used[at(v)];
    });
    out_.mesh.positions = std::move(positions);
    in_.source.vertices = std::move(numbers);
    in_.source.first_faces = std::move(faces);
  }

  PolygonMesh in_;
  MeshOptions options_;
  LoadedMesh out_;
  std::vector<Vec3> seen_;      ///< positions that decide about areas
  std::vector<Index> numbers_;  ///< face of each triangle
  LeftOut collapsed_{"names less than three different vertices", "name less than three different vertices"},
      flat_{"has no area", "have no area"},
      repeated_{"has the same vertices as another", "have the same vertices as others"};
  std::size_t first_left_out_ = static_cast<std::size_t>(-1);
};

}  // namespace

void PolygonMesh::add_face(std::span<const Index> face) {
  corners.insert(corners.end(), face.begin(), face.end());
  face_ends.push_back(static_cast<Index>(corners.size()));
}

void keep_solid(PolygonMesh& mesh) {
  const std::size_t faces = mesh.face_count(), edges = mesh.loose_edges.size();
  if (!has_volume(mesh) || faces + edges == 0) return;
  mesh.notes.push_back(mesh.source.file + ": " + counted(faces, "face") + " and " + counted(edges, "line") +
                       " were left out: the surface is the boundary of the tetrahedra");
  mesh.corners.clear();
  mesh.face_ends.clear();
  mesh.loose_edges.clear();
  mesh.source.face_lines.clear();
  mesh.source.edge_lines.clear();
}

LoadedMesh make_mesh(PolygonMesh polygons, const MeshOptions& options) {
  return MeshMaker(std::move(polygons), options).make();
}

}  // namespace ogc::compare
