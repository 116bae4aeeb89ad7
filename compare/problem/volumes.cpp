#include "compare/problem/volumes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

#include "compare/problem/cavities.hpp"
#include "compare/problem/element_names.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/problem_kind.hpp"
#include "compare/problem/validate_mesh.hpp"

namespace ogc::compare {
namespace {

/// An edge with the direction in which one of its triangles runs through it. Sorting puts all triangles of an edge next
/// to each other.
struct Side {
  Edge edge{};  ///< the smaller vertex first
  Index triangle = -1;
  bool ascending = true;  ///< whether the direction is from the smaller vertex to the larger one
  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sorted_sides(const Scene& scene, std::span<const Index> triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (const Index t : triangles) {
    const Triangle& corners = scene.mesh.triangles[at(t)];
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = corners[k], b = corners[(k + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, t, a < b});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

template <class Visit>
void visit_edges(std::span<const Side> sides, const Visit& visit) {
  for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
    while (end < sides.size() && sides[end].edge == sides[first].edge) ++end;
    visit(sides.subspan(first, end - first));
  }
}

/// Holds sets of numbers that can be united; the smallest number of a set represents it.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t root(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t a, std::size_t b) {
    a = root(a), b = root(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Returns the connected components of a body's surface, each as a part.
std::vector<VolumePart> shells_of(const Scene& scene, std::size_t number) {
  const Body& body = scene.bodies[number];
  Sets sets(scene.mesh.positions.size());
  const auto triangles = std::span(scene.mesh.triangles).subspan(at(body.first_triangle), at(body.triangle_count));
  for (const auto& [a, b, c] : triangles) sets.unite(at(a), at(b)), sets.unite(at(a), at(c));
  std::map<std::size_t, std::size_t> place;  // index in `shells`, by the smallest number of a connected set
  std::vector<VolumePart> shells;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto [entry, is_new] = place.try_emplace(sets.root(at(triangles[i][0])), shells.size());
    if (is_new) shells.push_back({number, {}, {}});
    shells[entry->second].triangles.push_back(body.first_triangle + static_cast<Index>(i));
  }
  for (VolumePart& shell : shells) {
    std::vector<Side> rims;
    visit_edges(sorted_sides(scene, shell.triangles), [&](std::span<const Side> sides) {
      if (sides.size() == 1) rims.push_back(sides[0]);
    });
    std::ranges::sort(rims, {}, [](const Side& side) { return side.triangle; });
    for (const Side& side : rims) shell.rims.push_back(side.ascending ? side.edge : Edge{side.edge[1], side.edge[0]});
  }
  return shells;
}

/// Holds a sum of determinants with the sum of the moduli of their terms.
struct SignedVolume {
  double value = 0, modulus = 0;
  std::size_t count = 0;

  /// Adds det(a − o, b − o, c − o).
  void add(const Vec3& o, const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::array<double, 3> u{a.x - o.x, a.y - o.y, a.z - o.z}, v{b.x - o.x, b.y - o.y, b.z - o.z},
        w{c.x - o.x, c.y - o.y, c.z - o.z};
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      const double positive = u[k] * v[l] * w[m], negative = u[k] * v[m] * w[l];
      sum += positive - negative;
      modulus += std::abs(positive) + std::abs(negative);
    }
    value += sum;
    ++count;
  }
  /// Returns an upper limit of the error of `value`, twice (n + 12) 2⁻⁵³ times `modulus` for n determinants. Each term
  /// is rounded at most n + 12 times: by three differences, two products, four sums inside a determinant, and the sums
  /// of determinants. The factor 2 covers the rounding of the moduli and higher orders.
  double error() const { return static_cast<double>(count + 12) * 0x1p-52 * modulus; }
};

/// Returns six times the volume that a part encloses. Each rim (connected edges that have one triangle each) is closed
/// by triangles from its edges to the mean of its vertices.
SignedVolume six_volumes(const Scene& scene, const VolumePart& part) {
  const auto position = [&](Index v) -> const Vec3& { return scene.mesh.positions[at(v)]; };
  const Vec3& origin = position(scene.mesh.triangles[at(part.triangles[0])][0]);
  SignedVolume volume;
  for (const Index t : part.triangles) {
    const auto [a, b, c] = scene.mesh.triangles[at(t)];
    volume.add(origin, position(a), position(b), position(c));
  }
  if (part.rims.empty()) return volume;
  Sets sets(scene.mesh.positions.size());
  for (const auto& [a, b] : part.rims) sets.unite(at(a), at(b));
  struct Mean {
    Vec3 sum;
    double count = 0;
  };
  std::map<std::size_t, Mean> means;
  // at each vertex of a rim as many edges begin as end, so the edges' first vertices are all vertices of the rim
  for (const auto& [a, b] : part.rims) {
    Mean& mean = means[sets.root(at(a))];
    const Vec3& x = position(a);
    mean.sum = {mean.sum.x + x.x, mean.sum.y + x.y, mean.sum.z + x.z};
    ++mean.count;
  }
  for (const auto& [a, b] : part.rims) {
    const auto& [sum, count] = means.at(sets.root(at(a)));
    volume.add(origin, position(b), position(a), {sum.x / count, sum.y / count, sum.z / count});
  }
  return volume;
}

bool is_usable(const Scene& scene, const Body& body) {
  const auto first = scene.mesh.positions.begin() + body.first_vertex;
  return std::all_of(first, first + body.vertex_count, [](const Vec3& x) {
    return is_finite(x) && std::max({std::abs(x.x), std::abs(x.y), std::abs(x.z)}) <= most_length;
  });
}

/// Returns for each shell of a volume of triangles the number of the shell in which it is a cavity, or −1.
std::vector<int> cavities_among(const Scene& scene, const std::vector<VolumePart>& shells) {
  std::vector<Shell> asked;
  if (shells.size() < 2 || !is_usable(scene, scene.bodies[shells[0].body])) return std::vector<int>(shells.size(), -1);
  for (const VolumePart& shell : shells) {
    const SignedVolume volume = shell.rims.empty() ? six_volumes(scene, shell) : SignedVolume{};
    asked.push_back({shell.triangles, std::abs(volume.value) > volume.error() ? volume.value : 0});
  }
  return enclosing_shells(scene.mesh, asked);
}

void unite_by_tetrahedra(const Scene& scene, const std::vector<VolumePart>& shells, Sets& parts) {
  const Body& body = scene.bodies[shells[0].body];
  Sets sets(scene.mesh.positions.size());
  for (Index t = body.first_tetrahedron; t < body.first_tetrahedron + body.tetrahedron_count; ++t)
    for (const Index v : scene.mesh.tetrahedra[at(t)]) sets.unite(at(scene.mesh.tetrahedra[at(t)][0]), at(v));
  std::map<std::size_t, std::size_t> shell_of;  // first shell of a set, by the set's smallest number
  for (std::size_t i = 0; i < shells.size(); ++i) {
    const std::size_t set = sets.root(at(scene.mesh.triangles[at(shells[i].triangles[0])][0]));
    parts.unite(shell_of.try_emplace(set, i).first->second, i);
  }
}

std::vector<VolumePart> parts_of(const Scene& scene, std::size_t number) {
  std::vector<VolumePart> shells = shells_of(scene, number);
  if (shells.size() < 2) return shells;
  Sets sets(shells.size());
  if (scene.bodies[number].is_solid()) {
    unite_by_tetrahedra(scene, shells, sets);
  } else {
    const std::vector<int> enclosing = cavities_among(scene, shells);
    for (std::size_t i = 0; i < shells.size(); ++i)
      if (enclosing[i] >= 0) sets.unite(i, at(enclosing[i]));
  }
  std::vector<VolumePart> parts;
  std::map<std::size_t, std::size_t> place;  // index in `parts`, by the smallest number of a connected set
  for (std::size_t i = 0; i < shells.size(); ++i) {
    const auto [entry, is_new] = place.try_emplace(sets.root(i), parts.size());
    if (is_new) parts.push_back({number, {}, {}});
    VolumePart& part = parts[entry->second];
    part.triangles.insert(part.triangles.end(), shells[i].triangles.begin(), shells[i].triangles.end());
    part.rims.insert(part.rims.end(), shells[i].rims.begin(), shells[i].rims.end());
  }
  for (VolumePart& part : parts) std::ranges::sort(part.triangles);
  return parts;
}

/// Returns whether each edge of the body has two triangles that run through it in opposite directions, or one triangle.
/// Lists the other edges as problems.
bool check_edges(std::vector<Problem>& problems, const Scene& scene, const Body& body, const ElementNames& names,
                 std::size_t limit) {
  ProblemKind threefold(problems, limit, "of a volume has more than two triangles",
                        "a volume's edge has two triangles, or one at a rim: remove the others, or leave the body a "
                        "surface");
  ProblemKind misoriented(problems, limit, "of a volume is run through in one sense by both of its triangles",
                          "turn one of them round, so that all face outward");
  std::vector<Index> triangles(at(body.triangle_count));
  std::iota(triangles.begin(), triangles.end(), body.first_triangle);
  const auto triangle = [&](Index t) { return names.triangle(t, scene.mesh.triangles[at(t)]); };
  visit_edges(sorted_sides(scene, triangles), [&](std::span<const Side> sides) {
    const auto where = [&] {
      return "edge from " + names.vertex(sides[0].edge[0]) + " to " + names.vertex(sides[0].edge[1]);
    };
    if (sides.size() > 2) {
      std::string all = triangle(sides[0].triangle);
      for (std::size_t k = 1; k < 3; ++k) all += ", " + triangle(sides[k].triangle);
      threefold.add(where(), std::to_string(sides.size()) + ", among them " + all);
    }
    if (sides.size() == 2 && sides[0].ascending == sides[1].ascending)
      misoriented.add(where(), triangle(sides[0].triangle) + ", " + triangle(sides[1].triangle));
  });
  return threefold.count() + misoriented.count() == 0;
}

/// Lists parts that are turned inside out or enclose no volume. Skips bodies for which `is_sound` is false, because
/// their edges or coordinates are bad.
void check_parts(std::vector<Problem>& problems, const Scene& scene, const std::vector<bool>& is_sound,
                 const ElementNames& names, std::size_t limit) {
  ProblemKind inside_out(problems, limit, "begins a part of a volume that is turned inside out",
                         "reverse the vertices of its triangles, so that their normals point outward; a cavity, "
                         "whose normals point into it, lies within a closed part of the same body");
  ProblemKind empty(problems, limit, "begins a part of a volume that encloses nothing",
                    "give the part an inner side, or leave the body a surface");
  for (const VolumePart& part : volume_parts(scene)) {
    if (!is_sound[part.body]) continue;
    const SignedVolume volume = six_volumes(scene, part);
    const Index t = part.triangles[0];
    const auto where = [&] { return names.triangle(t, scene.mesh.triangles[at(t)]); };
    const std::string size = std::to_string(part.triangles.size()) + " triangles, " + std::to_string(part.rims.size()) +
                             " edges at rims";
    if (volume.value < -volume.error()) {
      inside_out.add(where(), size);
    } else if (!(volume.value > volume.error())) {
      empty.add(where(), size);
    }
  }
}

/// Returns how many vertices of the body are neither fixed nor prescribed.
Index free_vertices(const Scene& scene, const Body& body) {
  if (body.fixed) return 0;
  std::vector<bool> driven(at(body.vertex_count));
  for (const PrescribedMotion& motion : scene.motions) {
    for (const Index v : motion.vertices)
      if (v >= body.first_vertex && v < body.first_vertex + body.vertex_count) driven[at(v - body.first_vertex)] = true;
  }
  return static_cast<Index>(std::count(driven.begin(), driven.end(), false));
}

}  // namespace

std::vector<VolumePart> volume_parts(const Scene& scene) {
  std::vector<VolumePart> parts;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (!scene.bodies[b].is_volume()) continue;
    for (VolumePart& part : parts_of(scene, b)) parts.push_back(std::move(part));
  }
  return parts;
}

void check_volume_bodies(std::vector<Problem>& problems, const Scene& scene, const ElementNames& names,
                         std::size_t limit) {
  ProblemKind loose(problems, limit, "of a volume belongs to no triangle, and has no inner side",
                    "give loose edges a body of their own");
  std::vector<bool> is_sound(scene.bodies.size());
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    if (!body.is_volume()) continue;
    const std::string where = "body '" + body.name + "'";
    for (std::size_t e = 0; e < scene.mesh.loose_edges.size(); ++e) {
      const Edge& ends = scene.mesh.loose_edges[e];
      if (ends[0] >= body.first_vertex && ends[0] < body.first_vertex + body.vertex_count)
        loose.add(names.loose_edge(static_cast<Index>(e), ends));
    }
    if (body.triangle_count == 0) {
      problems.push_back({where, "is a volume without triangles", "leave it a surface"});
      continue;
    }
    const Index free = body.is_solid() ? 0 : free_vertices(scene, body);
    if (free > 0) {
      problems.push_back({where,
                          "is a volume of triangles, and " + std::to_string(free) + " of its " +
                              std::to_string(body.vertex_count) + " vertices move freely",
                          "fix it, prescribe all of its vertices, or give it tetrahedra"});
    }
    is_sound[b] = check_edges(problems, scene, body, names, limit) && is_usable(scene, body);
  }
  check_parts(problems, scene, is_sound, names, limit);
}

std::vector<Edge> volume_cavities(const Scene& scene) {
  std::vector<Edge> all;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    if (!scene.bodies[b].is_volume() || scene.bodies[b].is_solid()) continue;
    const std::vector<VolumePart> shells = shells_of(scene, b);
    const auto vertex = [&](std::size_t i) { return scene.mesh.triangles[at(shells[i].triangles[0])][0]; };
    const std::vector<int> enclosing = cavities_among(scene, shells);
    for (std::size_t i = 0; i < shells.size(); ++i)
      if (enclosing[i] >= 0) all.push_back({vertex(i), vertex(at(enclosing[i]))});
  }
  return all;
}

VolumeSurface volume_surface(const Scene& scene) {
  VolumeSurface volumes;
  std::vector<Triangle> triangles;
  for (const Body& body : scene.bodies) {
    for (Index t = body.first_triangle; body.is_volume() && t < body.first_triangle + body.triangle_count; ++t) {
      volumes.triangles.push_back(t);
      triangles.push_back(scene.mesh.triangles[at(t)]);
    }
    const auto first = scene.mesh.tetrahedra.begin() + body.first_tetrahedron;
    if (body.is_volume()) volumes.tetrahedra.insert(volumes.tetrahedra.end(), first, first + body.tetrahedron_count);
  }
  volumes.topology = build_topology(static_cast<Index>(scene.mesh.positions.size()), triangles);
  volumes.cavities = volume_cavities(scene);
  return volumes;
}

Face scene_face(const VolumeSurface& volumes, const Topology& scene, const Face& face) {
  switch (face.kind) {
    case FaceKind::vertex: return face;
    case FaceKind::edge: {
      const Edge& ends = volumes.topology.edges[at(face.index)];
      return {face.kind, find_edge(scene, ends[0], ends[1])};
    }
    case FaceKind::triangle: return {face.kind, volumes.triangles[at(face.index)]};
  }
  __builtin_unreachable();
}

bool has_volumes(const Scene& scene) {
  return std::ranges::any_of(scene.bodies, [](const Body& body) { return body.is_volume(); });
}

std::vector<bool> volume_flags(const Scene& scene) {
  std::vector<bool> flags(scene.mesh.positions.size());
  for (const Body& body : scene.bodies)
    if (body.is_volume()) std::fill_n(flags.begin() + body.first_vertex, body.vertex_count, true);
  return flags;
}

std::vector<bool> free_volumes(const Scene& scene) {
  const std::vector<Index> groups = rigid_groups(scene);
  std::vector<bool> is_free;
  for (const Body& body : scene.bodies) {
    const auto first = groups.begin() + body.first_vertex;
    is_free.push_back(body.is_volume() && std::find(first, first + body.vertex_count, -1) != first + body.vertex_count);
  }
  return is_free;
}

std::vector<Index> volume_askers(const Scene& scene, const Topology& topology) {
  std::vector<Index> asking;
  if (!has_volumes(scene)) return asking;
  const std::vector<Index> groups = rigid_groups(scene);
  const std::vector<bool> is_free = free_volumes(scene);
  const bool has_free = std::ranges::find(is_free, true) != is_free.end();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Body& body = scene.bodies[b];
    for (Index v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) {
      const bool moves = groups[at(v)] == -1 || (has_free && groups[at(v)] > 0);
      const bool has_say = body.is_volume() ? is_free[b] && !topology.vertex_triangles[at(v)].empty() : true;
      if (moves && has_say) asking.push_back(v);
    }
  }
  return asking;
}

void refuse_volumes(const Scene& scene, std::string_view solver, std::string_view remedy) {
  const auto found = std::ranges::find_if(scene.bodies, [](const Body& body) { return body.is_volume(); });
  if (found == scene.bodies.end()) return;
  throw InputError("body '" + found->name + "' is a volume, which " + std::string(solver) + " does not simulate; " +
                   std::string(remedy));
}

}  // namespace ogc::compare
