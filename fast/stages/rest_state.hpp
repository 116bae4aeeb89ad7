// Rest data of a scene, made once on the host in double and rounded once. Triangles and hinges without energy (fixed bodies, models `none`) are left
// out here, so that no later stage has to ask.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compare/problem/error.hpp"
#include "compare/problem/scene.hpp"
#include "fast/kernels/bending.hpp"
#include "fast/kernels/contact_force.hpp"
#include "fast/kernels/membrane.hpp"
#include "fast/kernels/rest_state.hpp"

namespace ogc::fast {

/// How a vertex moves.
enum class Mobility : std::uint8_t { free, prescribed, fixed };

struct RestState {
  std::vector<float> mass;             ///< m_v [kg]: a third of each incident triangle's; 0 on fixed bodies
  std::vector<Mobility> mobility;
  std::vector<int> body;               ///< of each vertex
  std::vector<TriangleRest> triangles;
  std::vector<HingeRest> hinges;
  std::vector<SurfaceMaterial> materials;  ///< by body
  std::vector<ContactMaterial> contact;    ///< of bodies a and b, at a · bodies + b
};

namespace detail {

inline void add_triangles(const compare::Scene& scene, const compare::Body& body, int number, std::vector<double>& mass, RestState& rest) {
  for (int t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t) {
    const compare::Triangle& corners = scene.mesh.triangles[static_cast<std::size_t>(t)];
    const auto& p = scene.rest_positions;
    const RestTriangle shape = rest_triangle(p[static_cast<std::size_t>(corners[0])], p[static_cast<std::size_t>(corners[1])],
                                             p[static_cast<std::size_t>(corners[2])]);
    for (const int corner : corners) mass[static_cast<std::size_t>(corner)] += body.material.density * shape.area / 3;
    if (body.material.membrane == compare::MembraneModel::none) continue;
    TriangleRest triangle;
    for (int k = 0; k < 3; ++k) {
      triangle.corner[k] = corners[static_cast<std::size_t>(k)];
      for (int axis = 0; axis < 2; ++axis) triangle.gradient[k][axis] = static_cast<float>(shape.gradient[k][axis]);
    }
    triangle.body = number;
    triangle.area = static_cast<float>(shape.area);
    rest.triangles.push_back(triangle);
  }
}

inline void add_hinges(const compare::Scene& scene, const compare::Topology& topology, RestState& rest) {
  for (const compare::Hinge& hinge : topology.hinges) {
    const compare::Edge& edge = topology.edges[static_cast<std::size_t>(hinge.edge)];
    const int number = rest.body[static_cast<std::size_t>(edge[0])];
    const compare::Body& body = scene.bodies[static_cast<std::size_t>(number)];
    if (body.fixed || body.material.bending == compare::BendingModel::none) continue;
    const auto& p = scene.rest_positions;
    const RestHinge shape = rest_hinge(p[static_cast<std::size_t>(edge[0])], p[static_cast<std::size_t>(edge[1])],
                                       p[static_cast<std::size_t>(hinge.opposite[0])], p[static_cast<std::size_t>(hinge.opposite[1])]);
    rest.hinges.push_back({{edge[0], edge[1], hinge.opposite[0], hinge.opposite[1]}, number, static_cast<float>(shape.angle),
                           static_cast<float>(body.material.bending_stiffness * shape.factor)});
  }
}

inline void add_contact_materials(const compare::Scene& scene, RestState& rest) {
  for (const compare::Body& a : scene.bodies) {
    for (const compare::Body& b : scene.bodies) {
      const double ka = a.material.contact_stiffness, kb = b.material.contact_stiffness;
      const double harmonic = ka + kb > 0 ? 2 * ka * kb / (ka + kb) : 0;
      rest.contact.push_back({static_cast<float>(harmonic), static_cast<float>((a.material.friction + b.material.friction) / 2)});
    }
  }
}

}  // namespace detail

/// Throws InputError for bodies that move and have edges without triangles: there is no energy for them here.
inline RestState build_rest_state(const compare::Scene& scene, const compare::Topology& topology) {
  RestState rest;
  std::vector<double> mass(scene.mesh.positions.size(), 0.0);
  rest.body = compare::body_of_vertex(scene);
  rest.mobility.assign(mass.size(), Mobility::free);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const compare::Body& body = scene.bodies[b];
    if (body.fixed) {
      for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) rest.mobility[static_cast<std::size_t>(v)] = Mobility::fixed;
    } else {
      detail::add_triangles(scene, body, static_cast<int>(b), mass, rest);
    }
    const double h = scene.settings.time_step;
    rest.materials.push_back({static_cast<float>(body.material.lame_lambda), static_cast<float>(body.material.lame_mu),
                              static_cast<float>(body.material.membrane_damping / h), static_cast<float>(body.material.bending_damping / h)});
  }
  for (const compare::PrescribedMotion& motion : scene.motions) {
    for (const int v : motion.vertices) rest.mobility[static_cast<std::size_t>(v)] = Mobility::prescribed;
  }
  detail::add_hinges(scene, topology, rest);
  detail::add_contact_materials(scene, rest);
  for (std::size_t v = 0; v < mass.size(); ++v) {
    rest.mass.push_back(static_cast<float>(mass[v]));
    if (rest.mobility[v] == Mobility::free && !(rest.mass[v] > 0)) {
      throw compare::InputError("vertex " + std::to_string(v) + " of body '" + scene.bodies[static_cast<std::size_t>(rest.body[v])].name +
                                "' moves but has no mass: give it a triangle and a density above zero, or hold it by a motion or a fixed body");
    }
  }
  return rest;
}

}  // namespace ogc::fast
