// Avoids divisions: multiplies the vector from the foot of the perpendicular to the point by the foot's denominator. So
// exact numbers with sums and products suffice.
#include "reference/definitions/defined_blocks.hpp"

#include "reference/definitions/defined_blocks_exact.hpp"

namespace ogc::reference {
namespace {

bool within(const Connection& found, float contact_radius, Sphere sphere) {
  const Exact reach = Exact(static_cast<double>(contact_radius)) * found.weight;
  const int beyond = sign_of(dot(found.along, found.along) - reach * reach);
  return beyond < 0 || (beyond == 0 && sphere == Sphere::closed);
}

}  // namespace

std::optional<Connection> connection(const Complex& mesh, Face face, const ExactPoint& x) {
  const auto v = mesh.vertices(face).items;
  const ExactVector a = exact(mesh.at(v[0]));
  const ExactVector p = x.numerator - times(x.weight, a);
  if (face.kind == FaceKind::vertex) return Connection{p, x.weight};
  const ExactVector d = exact(mesh.at(v[1])) - a;
  const Exact dd = dot(d, d), pd = dot(p, d);
  if (face.kind == FaceKind::edge) {
    if (sign_of(pd) <= 0 || sign_of(dd * x.weight - pd) <= 0) return std::nullopt;
    return Connection{times(dd, p) - times(pd, d), dd * x.weight};
  }
  const ExactVector e = exact(mesh.at(v[2])) - a;
  const Exact ee = dot(e, e), de = dot(d, e), pe = dot(p, e);
  const Exact det = dd * ee - de * de, beta = pd * ee - pe * de, gamma = pe * dd - pd * de;
  if (sign_of(beta) <= 0 || sign_of(gamma) <= 0 || sign_of(det * x.weight - beta - gamma) <= 0) return std::nullopt;
  return Connection{times(det, p) - plus(times(beta, d), times(gamma, e)), det * x.weight};
}

const NormalCone& DefinedBlocks::Cones::of(Face face) const {
  const auto i = static_cast<std::size_t>(face.index);
  return face.kind == FaceKind::vertex ? vertices[i] : face.kind == FaceKind::edge ? edges[i] : triangles[i];
}

bool DefinedBlocks::Cones::contains(Face face, const ExactPoint& x, float contact_radius, Sphere sphere) const {
  const auto found = connection(mesh, face, x);
  return found && within(*found, contact_radius, sphere) && (is_zero(found->along) || of(face).contains(found->along));
}

bool DefinedBlocks::Cones::contains_edge_only(Face face, const ExactPoint& x, float contact_radius) const {
  if (face.kind == FaceKind::vertex) return contains(face, x, contact_radius, Sphere::closed);
  const auto found = connection(mesh, face, x);
  return found && within(*found, contact_radius, Sphere::closed);
}

DefinedBlocks::DefinedBlocks(const Complex& mesh) : cones_(new Cones{mesh, {}, {}, {}}) {
  const auto cones_of = [&](FaceKind kind, std::size_t count) {
    std::vector<NormalCone> cones;
    for (std::size_t i = 0; i < count; ++i) cones.emplace_back(star_directions(mesh, {kind, static_cast<Index>(i)}));
    return cones;
  };
  cones_->vertices = cones_of(FaceKind::vertex, mesh.positions.size());
  cones_->edges = cones_of(FaceKind::edge, mesh.topology.edges.size());
  cones_->triangles = cones_of(FaceKind::triangle, mesh.topology.triangles.size());
}

DefinedBlocks::~DefinedBlocks() = default;

bool DefinedBlocks::contains(Face face, const Vec3f& x, float contact_radius) const {
  return cones_->contains(face, {exact(x)}, contact_radius, Sphere::closed);
}

bool DefinedBlocks::contains_edge_only(Face face, const Vec3f& x, float contact_radius) const {
  return cones_->contains_edge_only(face, {exact(x)}, contact_radius);
}

bool DefinedBlocks::in_contact(Face face, const Vec3f& x, float contact_radius) const {
  return cones_->contains(face, {exact(x)}, contact_radius, Sphere::open);
}

bool DefinedBlocks::has_normals(Face face) const { return !cones_->of(face).generators().empty(); }

}  // namespace ogc::reference
