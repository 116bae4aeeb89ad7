#include "compare/laws/measures.hpp"

#include <algorithm>
#include <cmath>

#include "compare/problem/rods.hpp"

namespace ogc::compare::law_measures {
namespace {

const Vec3& at(const std::vector<Vec3>& values, Index v) { return values[static_cast<std::size_t>(v)]; }

double area(const Vec3& a, const Vec3& b, const Vec3& c) { return length(cross(plus(b, a, -1), plus(c, a, -1))) / 2; }

template <class Visit>
void each_vertex(const Body& body, Visit visit) {
  for (Index v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) visit(static_cast<std::size_t>(v));
}

/// Returns the mean of `values` over a body's vertices, weighted by mass.
Vec3 mean(const Scene& scene, std::size_t body, const std::vector<Vec3>& values) {
  const std::vector<double> m = masses(scene);
  Vec3 sum{};
  double all = 0;
  each_vertex(scene.bodies[body], [&](std::size_t v) {
    sum = plus(sum, values[v], m[v]);
    all += m[v];
  });
  return {sum.x / all, sum.y / all, sum.z / all};
}

/// Returns f₁(|share|) of friction (method.md §4.4) with the sign of `share`, which is v/ε_v.
double smoothed_sign(double share) {
  const double y = std::min(std::abs(share), 1.);
  return std::copysign(y * (2 - y), share);
}

}  // namespace

Vec3 plus(const Vec3& a, const Vec3& b, double s) { return {a.x + s * b.x, a.y + s * b.y, a.z + s * b.z}; }
double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double length(const Vec3& a) { return std::sqrt(dot(a, a)); }

double force_left(const Trajectory& run) { return run.by.is_solved ? 1e-4 : 1. / 40; }

double lagged_steps(const Trajectory& run) { return run.by.has_contact_energy ? 1 : 2; }

std::vector<double> masses(const Scene& scene) {
  std::vector<double> m(scene.mesh.positions.size());
  const auto& x = scene.rest_positions;
  for (const Body& body : scene.bodies) {
    if (body.fixed) continue;
    for (Index k = body.first_tetrahedron; k < body.first_tetrahedron + body.tetrahedron_count; ++k) {
      const Tetrahedron& t = scene.mesh.tetrahedra[static_cast<std::size_t>(k)];
      const Vec3 a = at(x, t[0]);
      const double volume = std::abs(dot(plus(at(x, t[1]), a, -1),
                                         cross(plus(at(x, t[2]), a, -1), plus(at(x, t[3]), a, -1)))) /
                            6;
      for (const Index v : t) m[static_cast<std::size_t>(v)] += body.material.solid_density * volume / 4;
    }
    if (body.is_solid()) continue;
    for (Index k = body.first_triangle; k < body.first_triangle + body.triangle_count; ++k) {
      const Triangle& t = scene.mesh.triangles[static_cast<std::size_t>(k)];
      const double share = body.material.density * area(at(x, t[0]), at(x, t[1]), at(x, t[2])) / 3;
      for (const Index v : t) m[static_cast<std::size_t>(v)] += share;
    }
  }
  const std::vector<Index> bodies = body_of_vertex(scene);
  for (const Index segment : rod_segments(scene)) {
    const Edge& e = scene.mesh.loose_edges[static_cast<std::size_t>(segment)];
    const Body& body = scene.bodies[static_cast<std::size_t>(bodies[static_cast<std::size_t>(e[0])])];
    const double share = body.fixed ? 0 : body.material.rod->density * length(plus(at(x, e[1]), at(x, e[0]), -1)) / 2;
    for (const Index v : e) m[static_cast<std::size_t>(v)] += share;
  }
  return m;
}

double mass_of(const Scene& scene, std::size_t body) {
  const std::vector<double> m = masses(scene);
  double sum = 0;
  each_vertex(scene.bodies[body], [&](std::size_t v) { sum += m[v]; });
  return sum;
}

Vec3 centre(const Scene& scene, std::size_t body, const LawState& state) { return mean(scene, body, state.positions); }
Vec3 centre_velocity(const Scene& scene, std::size_t body, const LawState& state) {
  return mean(scene, body, state.velocities);
}

Vec3 momentum(const Scene& scene, const LawState& state) {
  const std::vector<double> m = masses(scene);
  Vec3 sum{};
  for (std::size_t v = 0; v < m.size(); ++v) sum = plus(sum, state.velocities[v], m[v]);
  return sum;
}

Vec3 angular_momentum(const Scene& scene, const LawState& state) {
  const std::vector<double> m = masses(scene);
  Vec3 sum{};
  for (std::size_t v = 0; v < m.size(); ++v) sum = plus(sum, cross(state.positions[v], state.velocities[v]), m[v]);
  return sum;
}

double kinetic_energy(const Scene& scene, const LawState& state) {
  const std::vector<double> m = masses(scene);
  double sum = 0;
  for (std::size_t v = 0; v < m.size(); ++v) sum += m[v] * dot(state.velocities[v], state.velocities[v]) / 2;
  return sum;
}

double largest_coordinate(const Trajectory& run) {
  double largest = 0;
  for (const LawState& state : run.states)
    for (const Vec3& x : state.positions) largest = std::max({largest, std::abs(x.x), std::abs(x.y), std::abs(x.z)});
  return largest;
}

double flight_rounding(std::int64_t n, double largest_coordinate) {
  const auto steps = static_cast<double>(n);
  return (steps + steps * (steps + 1)) * unit_roundoff * largest_coordinate;
}

double slid(double velocity, double drive, double brake, double friction_velocity, double time_step) {
  double low = velocity + time_step * (drive - brake), high = velocity + time_step * (drive + brake);
  for (int k = 0; k < 200 && low < high; ++k) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    const bool is_below = middle < velocity + time_step * (drive - brake * smoothed_sign(middle / friction_velocity));
    (is_below ? low : high) = middle;
  }
  return (low + high) / 2;
}

Height bounced(const Height& from, double acceleration, double stiffness_over_mass, double radius, double time_step) {
  const double target = from.x + time_step * from.v + time_step * time_step * acceleration;
  const double k = time_step * time_step * stiffness_over_mass;
  const double x = target >= radius ? target : (target + k * radius) / (1 + k);
  return {x, (x - from.x) / time_step};
}

}  // namespace ogc::compare::law_measures
