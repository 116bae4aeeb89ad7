#include "experiments/program/runs/thin_solids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "compare/stages/detect_vertex_facet.hpp"
#include "experiments/program/output.hpp"
#include "fast/contestant.hpp"

namespace ogc::experiments {

namespace {

using compare::Index;
using compare::Vec3;

/// Holds the contacts of a resting solid with itself.
struct Thinness {
  std::size_t pairs = 0;
  double thickness = std::numeric_limits<double>::infinity();  ///< thickness at the thinnest place [m]
};

Vec3 from(const Vec3& a, const Vec3& b) { return {b.x - a.x, b.y - a.y, b.z - a.z}; }
double inner(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 outer(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(const Vec3& a) { return std::sqrt(inner(a, a)); }

/// Returns the distance of a vertex from the plane, line or vertex of a face. The vertex must lie in the face's block.
double distance(const compare::Topology& topology, const std::vector<Vec3>& x, Index vertex,
                const compare::Face& face) {
  const auto at = [&](Index v) { return x[static_cast<std::size_t>(v)]; };
  const auto i = static_cast<std::size_t>(face.index);
  const Vec3 own = at(vertex);
  if (face.kind == compare::FaceKind::vertex) return length(from(at(face.index), own));
  if (face.kind == compare::FaceKind::edge) {
    const auto& [a, b] = topology.edges[i];
    return length(outer(from(at(a), at(b)), from(at(a), own))) / length(from(at(a), at(b)));
  }
  const auto& [a, b, c] = topology.triangles[i];
  const Vec3 normal = outer(from(at(a), at(b)), from(at(a), at(c)));
  return std::abs(inner(normal, from(at(a), own))) / length(normal);
}

Thinness thinness_of(const compare::Scene& scene, const compare::Body& body, const compare::Contestant& cpu) {
  const auto first = scene.rest_positions.begin() + body.first_vertex;
  const std::vector<Vec3> rest(first, first + body.vertex_count);
  std::vector<compare::Triangle> triangles;
  for (Index t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t) {
    const auto& [a, b, c] = scene.mesh.triangles[static_cast<std::size_t>(t)];
    triangles.push_back({a - body.first_vertex, b - body.first_vertex, c - body.first_vertex});
  }
  const compare::Topology topology = compare::build_topology(body.vertex_count, triangles);
  const std::vector<compare::Vec3f> positions = compare::to_single(rest);
  const auto radius = static_cast<float>(scene.settings.contact_radius);
  Thinness result;
  for (const compare::VertexFacetContact& c :
       cpu.detect_vertex_facet({&topology, {}, positions, radius, radius}).contacts) {
    ++result.pairs;
    result.thickness = std::min(result.thickness, distance(topology, rest, c.vertex, c.face));
  }
  return result;
}

}  // namespace

std::string thin_solid_warning(const compare::Scene& scene) {
  if (scene.mesh.tetrahedra.empty()) return "";
  const compare::Contestant cpu = fast::contestant(fast::Backend::cpu);
  Thinness thinnest;
  std::string name;
  for (const compare::Body& body : scene.bodies) {
    if (!body.is_solid() || body.fixed) continue;
    const Thinness found = thinness_of(scene, body, cpu);
    if (found.thickness < thinnest.thickness) thinnest = found, name = body.name;
  }
  if (thinnest.pairs == 0) return "";
  return "body '" + name + "' is thinner than contact_radius (" + number(scene.settings.contact_radius) +
         " m) at rest: " + std::to_string(thinnest.pairs) +
         " pairs of a vertex and a face of its own are in contact, " + "the thinnest place is " +
         number(thinnest.thickness) +
         " m: opposite sides press each other apart through it; take a smaller contact_radius";
}

}  // namespace ogc::experiments
