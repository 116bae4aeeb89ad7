// Differentiates by the rules of sums and products: a `Moving` number contains its rate of change along the
// displacement d. The membrane's energy needs tr G and ‖G‖² of the Green strain G. Let g be the 2×2 matrix of the
// scalar products of a triangle's two edges, and ḡ the same matrix at rest. Then C = ḡ⁻¹ (g − ḡ)/2 has tr C = tr G and
// tr C² = ‖G‖².
#include "compare/laws/elastic.hpp"

#include <array>
#include <cmath>

#include "compare/laws/measures.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/mesh.hpp"

namespace ogc::compare::law_measures {
namespace {

struct Moving {
  double value = 0, rate = 0;
};
Moving operator+(Moving a, Moving b) { return {a.value + b.value, a.rate + b.rate}; }
Moving operator-(Moving a, Moving b) { return {a.value - b.value, a.rate - b.rate}; }
Moving operator*(Moving a, Moving b) { return {a.value * b.value, a.rate * b.value + a.value * b.rate}; }
Moving operator*(double s, Moving a) { return {s * a.value, s * a.rate}; }
Moving root(Moving a) {
  const double value = std::sqrt(a.value);
  return {value, a.rate / (2 * value)};
}
Moving angle(Moving s, Moving c) {
  return {std::atan2(s.value, c.value),
          (c.value * s.rate - s.value * c.rate) / (c.value * c.value + s.value * s.value)};
}

/// A vector with its rate of change along the displacement d.
struct MovingVec {
  Vec3 value{}, rate{};
};
MovingVec operator-(const MovingVec& a, const MovingVec& b) {
  return {plus(a.value, b.value, -1), plus(a.rate, b.rate, -1)};
}
Moving inner(const MovingVec& a, const MovingVec& b) {
  return {dot(a.value, b.value), dot(a.rate, b.value) + dot(a.value, b.rate)};
}
/// Returns a × b.
MovingVec normal(const MovingVec& a, const MovingVec& b) {
  return {cross(a.value, b.value), plus(cross(a.rate, b.value), cross(a.value, b.rate))};
}

/// By vertex: the position and its rate of change along the displacement d, which is d itself (`along`).
struct Points {
  const std::vector<Vec3>&x, &along;
  MovingVec operator[](Index v) const { return {x[static_cast<std::size_t>(v)], along[static_cast<std::size_t>(v)]}; }
};

/// Returns g₁₁, g₁₂, g₂₂.
std::array<Moving, 3> products(const Points& at, const Triangle& t) {
  const MovingVec a = at[t[1]] - at[t[0]], b = at[t[2]] - at[t[0]];
  return {inner(a, a), inner(a, b), inner(b, b)};
}

Moving membrane(const Points& now, const Points& rest, const Triangle& t, const Material& of) {
  const auto g = products(now, t), r = products(rest, t);
  const double p = r[0].value, q = r[1].value, s = r[2].value, squared_area = p * s - q * q;
  const double half = 0.5 / squared_area;
  const Moving d0 = g[0] - r[0], d1 = g[1] - r[1], d2 = g[2] - r[2];
  const Moving c00 = half * (s * d0 - q * d1), c01 = half * (s * d1 - q * d2), c10 = half * (p * d1 - q * d0),
               c11 = half * (p * d2 - q * d1), trace = c00 + c11;
  const Moving squared = c00 * c00 + 2 * (c01 * c10) + c11 * c11;
  const double area = std::sqrt(squared_area) / 2;
  return area * (of.lame_lambda / 2 * (trace * trace) + of.lame_mu * squared);
}

/// Returns the angle θ of a hinge. Its sign is a convention, which is the same at all positions.
Moving hinge_angle(const Points& at, const Edge& edge, const Hinge& hinge) {
  const MovingVec along = at[edge[1]] - at[edge[0]];
  const MovingVec first = normal(along, at[hinge.opposite[0]] - at[edge[0]]);
  const MovingVec second = normal(at[hinge.opposite[1]] - at[edge[0]], along);
  return angle(inner(normal(first, second), along), root(inner(along, along)) * inner(first, second));
}

double area(const Points& at, const Triangle& t) {
  const auto g = products(at, t);
  return std::sqrt(g[0].value * g[2].value - g[1].value * g[1].value) / 2;
}

Moving bending(const Points& now, const Points& rest, const Topology& topology, const Hinge& hinge, double stiffness) {
  const Edge& edge = topology.edges[static_cast<std::size_t>(hinge.edge)];
  const MovingVec along = rest[edge[1]] - rest[edge[0]];
  double areas = 0;
  for (const Index t : hinge.triangles) areas += area(rest, topology.triangles[static_cast<std::size_t>(t)]);
  const Moving bent = hinge_angle(now, edge, hinge) - hinge_angle(rest, edge, hinge);
  return 1.5 * stiffness * inner(along, along).value / areas * (bent * bent);
}

}  // namespace

Elastic elastic(const Scene& scene, const std::vector<Vec3>& x, const std::vector<Vec3>& along) {
  const std::vector<Vec3> still(x.size());
  const Points now{x, along}, rest{scene.rest_positions, still};
  const Topology topology = build_topology(scene.mesh);
  const std::vector<Index> bodies = body_of_vertex(scene);
  const auto body_of = [&](Index v) -> const Body& {
    return scene.bodies[static_cast<std::size_t>(bodies[static_cast<std::size_t>(v)])];
  };
  Moving sum;
  for (const Triangle& t : topology.triangles) {
    const Body& body = body_of(t[0]);
    if (body.fixed) continue;
    if (body.material.membrane != MembraneModel::st_venant_kirchhoff)
      throw InputError("the law knows the energy of St. Venant–Kirchhoff membranes alone");
    sum = sum + membrane(now, rest, t, body.material);
  }
  for (const Hinge& hinge : topology.hinges) {
    const Body& body = body_of(hinge.opposite[0]);
    if (body.fixed || body.material.bending == BendingModel::none) continue;
    if (body.material.bending != BendingModel::discrete_hinge)
      throw InputError("the law knows the energy of discrete hinges alone");
    sum = sum + bending(now, rest, topology, hinge, body.material.bending_stiffness);
  }
  return {sum.value, sum.rate};
}

}  // namespace ogc::compare::law_measures
