// Both ways to a rest state, from a scene and from an answer to the judge, share what no rounding enters. ∇N₀ is made
// of the stored ∇N₁ and ∇N₂: two gradients tell the third, and an answer that carries two says all.
#include "fast/stages/rest_state.hpp"

#include <algorithm>
#include <string>

#include "compare/problem/element_names.hpp"
#include "compare/problem/error.hpp"
#include "fast/kernels/models/bending_models.hpp"
#include "fast/kernels/rest_state.hpp"

namespace ogc::fast {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// What moves how, materials and models by body, springs: nothing that is computed from the rest shape.
RestState without_shape(const compare::Scene& scene) {
  RestState rest;
  rest.body = compare::body_of_vertex(scene);
  rest.mobility.assign(rest.body.size(), Mobility::free);
  const double h = scene.settings.time_step;
  for (const compare::Body& body : scene.bodies) {
    if (body.fixed) {
      for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v)
        rest.mobility[at(v)] = Mobility::fixed;
    }
    rest.materials.push_back({static_cast<float>(body.material.lame_lambda), static_cast<float>(body.material.lame_mu),
                              static_cast<float>(body.material.membrane_damping / h),
                              static_cast<float>(body.material.bending_damping / h)});
    rest.models.push_back({body.material.membrane, body.material.bending, scene.settings.damping});
    rest.solids.push_back({static_cast<float>(body.material.solid_lambda), static_cast<float>(body.material.solid_mu),
                           static_cast<float>(body.material.solid_damping / h)});
  }
  rest.activation = scene.settings.activation;
  for (const compare::Spring& spring : scene.springs) {
    const int third = spring.ratio > 0 ? spring.third : spring.second;
    rest.springs.push_back({{spring.first, spring.second, third},
                            static_cast<float>(spring.stiffness),
                            static_cast<float>(spring.rest_length),
                            static_cast<float>(spring.damping / h),
                            static_cast<float>(spring.ratio)});
  }
  for (const compare::PrescribedMotion& motion : scene.motions) {
    for (const int v : motion.vertices) rest.mobility[at(v)] = Mobility::prescribed;
  }
  return rest;
}

void complete_gradient(TriangleRest& triangle) {
  for (int axis = 0; axis < 2; ++axis)
    triangle.gradient[0][axis] = -(triangle.gradient[1][axis] + triangle.gradient[2][axis]);
}

void add_triangles(const compare::Scene& scene, int number, std::vector<double>& mass, RestState& rest) {
  const compare::Body& body = scene.bodies[at(number)];
  const auto& p = scene.rest_positions;
  for (int t = body.first_triangle; t < body.first_triangle + body.triangle_count; ++t) {
    const compare::Triangle& corners = scene.mesh.triangles[at(t)];
    const RestTriangle shape = rest_triangle(p[at(corners[0])], p[at(corners[1])], p[at(corners[2])]);
    for (const int corner : corners) mass[at(corner)] += body.material.density * shape.area / 3;
    if (body.material.membrane == compare::MembraneModel::none) continue;
    TriangleRest triangle;
    for (int k = 0; k < 3; ++k) triangle.corner[k] = corners[at(k)];
    for (int k = 1; k < 3; ++k) {
      for (int axis = 0; axis < 2; ++axis) triangle.gradient[k][axis] = static_cast<float>(shape.gradient[k][axis]);
    }
    complete_gradient(triangle);
    triangle.body = number;
    triangle.area = static_cast<float>(shape.area);
    rest.triangles.push_back(triangle);
  }
}

void add_tetrahedra(const compare::Scene& scene, int number, std::vector<double>& mass, RestState& rest) {
  const compare::Body& body = scene.bodies[at(number)];
  const auto& p = scene.rest_positions;
  for (int t = body.first_tetrahedron; t < body.first_tetrahedron + body.tetrahedron_count; ++t) {
    const compare::Tetrahedron& corners = scene.mesh.tetrahedra[at(t)];
    const RestTetrahedron shape = rest_tetrahedron(p[at(corners[0])], p[at(corners[1])], p[at(corners[2])],
                                                   p[at(corners[3])]);
    for (const int corner : corners) mass[at(corner)] += body.material.solid_density * shape.volume / 4;
    TetrahedronRest tetrahedron;
    for (int k = 0; k < 4; ++k) tetrahedron.corner[k] = corners[at(k)];
    tetrahedron.body = number;
    for (int i = 0; i < 6; ++i) tetrahedron.weight[i] = static_cast<float>(shape.weight[i]);
    tetrahedron.inverse = static_cast<float>(1 / (6 * shape.volume));
    tetrahedron.volume = static_cast<float>(shape.volume);
    for (int k = 0; k < 3; ++k) {
      const RestVector& gradient = shape.gradient[k + 1];
      tetrahedron.gradient[k][0] = static_cast<float>(gradient.x);
      tetrahedron.gradient[k][1] = static_cast<float>(gradient.y);
      tetrahedron.gradient[k][2] = static_cast<float>(gradient.z);
    }
    rest.tetrahedra.push_back(tetrahedron);
  }
}

void add_masses(const compare::Scene& scene, RestState& rest) {
  std::vector<double> mass(scene.mesh.positions.size(), 0.0);
  for (int b = 0; b < static_cast<int>(scene.bodies.size()); ++b) {
    const compare::Body& body = scene.bodies[at(b)];
    if (body.fixed) continue;
    if (body.is_solid())
      add_tetrahedra(scene, b, mass, rest);
    else
      add_triangles(scene, b, mass, rest);
  }
  rest.rods = rods_at_rest(scene, mass);
  for (std::size_t v = 0; v < mass.size(); ++v) {
    rest.mass.push_back(static_cast<float>(mass[v]));
    if (rest.mobility[v] == Mobility::free && !(rest.mass[v] > 0)) {
      throw compare::InputError(compare::ElementNames(scene).vertex(static_cast<compare::Index>(v)) +
                                " moves but has no mass: give it a triangle, a tetrahedron or a rod's edge and a "
                                "density above zero, or hold it by a motion or a fixed body");
    }
  }
}

bool has_weights(const compare::Body& body) { return !body.fixed && reads_weights(body.material.bending); }

void add_hinges(const compare::Scene& scene, const compare::Topology& topology, RestState& rest) {
  const auto& p = scene.rest_positions;
  const bool weighted = std::any_of(scene.bodies.begin(), scene.bodies.end(), has_weights);
  for (const compare::Hinge& hinge : topology.hinges) {
    const compare::Edge& edge = topology.edges[at(hinge.edge)];
    const int number = rest.body[at(edge[0])];
    const compare::Body& body = scene.bodies[at(number)];
    if (body.fixed || body.is_solid() || body.material.bending == compare::BendingModel::none) continue;
    const RestHinge shape = rest_hinge(p[at(edge[0])], p[at(edge[1])], p[at(hinge.opposite[0])],
                                       p[at(hinge.opposite[1])]);
    rest.hinges.push_back({{edge[0], edge[1], hinge.opposite[0], hinge.opposite[1]},
                           number,
                           static_cast<float>(shape.angle),
                           static_cast<float>(body.material.bending_stiffness * shape.factor)});
    if (!weighted) continue;
    rest.weights.emplace_back();
    if (!has_weights(body)) continue;
    for (int k = 0; k < 3; ++k) rest.weights.back().weight[k] = static_cast<float>(shape.weight[k]);
  }
}

void add_edge_lengths(const compare::Scene& scene, const compare::Topology& topology, RestState& rest) {
  for (const compare::Edge& edge : topology.edges) {
    const RestVector e = rest_difference(scene.rest_positions[at(edge[1])], scene.rest_positions[at(edge[0])]);
    rest.edge_length_squared.push_back(static_cast<float>(rest_dot(e, e)));
  }
}

void add_contact_materials(const compare::Scene& scene, RestState& rest) {
  for (const compare::Body& a : scene.bodies) {
    for (const compare::Body& b : scene.bodies) {
      const double ka = a.material.contact_stiffness, kb = b.material.contact_stiffness;
      const double harmonic = ka > 0 ? 2 * ka * kb / (ka + kb) : 0;
      rest.contact.push_back(
          {static_cast<float>(harmonic), static_cast<float>((a.material.friction + b.material.friction) / 2)});
    }
  }
}

}  // namespace

RestState build_rest_state(const compare::Scene& scene, const compare::Topology& topology) {
  RestState rest = without_shape(scene);
  add_masses(scene, rest);
  add_hinges(scene, topology, rest);
  add_edge_lengths(scene, topology, rest);
  add_contact_materials(scene, rest);
  return rest;
}

compare::RestStateOut rest_state_out(const compare::RestStateIn& in) {
  const RestState rest = build_rest_state(*in.scene, *in.topology);
  compare::RestStateOut out{rest.mass, {}, {}, rest.edge_length_squared, {}, {}, {}};
  for (const TriangleRest& t : rest.triangles) {
    out.triangles.push_back({{t.corner[0], t.corner[1], t.corner[2]},
                             t.body,
                             t.area,
                             {{{t.gradient[1][0], t.gradient[1][1]}, {t.gradient[2][0], t.gradient[2][1]}}}});
  }
  for (std::size_t i = 0; i < rest.hinges.size(); ++i) {
    const HingeRest& h = rest.hinges[i];
    out.hinges.push_back({{h.vertex[0], h.vertex[1], h.vertex[2], h.vertex[3]}, h.body, h.angle, h.stiffness, {}});
    if (rest.weights.empty()) continue;
    for (std::size_t k = 0; k < 3; ++k) out.hinges.back().weight[k] = rest.weights[i].weight[k];
  }
  for (const ContactMaterial& m : rest.contact) out.meetings.push_back({m.stiffness, m.friction});
  for (const TetrahedronRest& t : rest.tetrahedra) {
    compare::RestTetrahedron shape{
        {t.corner[0], t.corner[1], t.corner[2], t.corner[3]}, t.body, t.volume, t.inverse, {}, {}};
    std::copy_n(t.weight, 6, shape.weight.begin());
    for (std::size_t k = 0; k < 3; ++k) std::copy_n(t.gradient[k], 3, shape.gradient[k].begin());
    out.tetrahedra.push_back(shape);
  }
  out.segments = rest_segments(rest.rods);
  return out;
}

RestState rest_state_of(const compare::RestStateIn& in, const compare::RestStateOut& out) {
  RestState rest = without_shape(*in.scene);
  rest.mass = out.mass;
  rest.edge_length_squared = out.edge_length_squared;
  for (const compare::RestTriangle& t : out.triangles) {
    TriangleRest triangle{{t.corner[0], t.corner[1], t.corner[2]},
                          t.body,
                          {{}, {t.gradient[0][0], t.gradient[0][1]}, {t.gradient[1][0], t.gradient[1][1]}},
                          t.area};
    complete_gradient(triangle);
    rest.triangles.push_back(triangle);
  }
  const bool weighted = std::any_of(in.scene->bodies.begin(), in.scene->bodies.end(), has_weights);
  for (const compare::RestHinge& h : out.hinges) {
    rest.hinges.push_back({{h.vertex[0], h.vertex[1], h.vertex[2], h.vertex[3]}, h.body, h.rest_angle, h.stiffness});
    if (weighted) rest.weights.push_back({{h.weight[0], h.weight[1], h.weight[2]}});
  }
  for (const compare::MeetingMaterial& m : out.meetings) rest.contact.push_back({m.stiffness, m.friction});
  for (const compare::RestTetrahedron& t : out.tetrahedra) {
    TetrahedronRest shape{{t.corner[0], t.corner[1], t.corner[2], t.corner[3]}, t.body, {}, t.inverse, {}, t.volume};
    std::copy_n(t.weight.begin(), 6, shape.weight);
    for (std::size_t k = 0; k < 3; ++k) std::copy_n(t.gradient[k].begin(), 3, shape.gradient[k]);
    rest.tetrahedra.push_back(shape);
  }
  rest.rods = rods_of(*in.scene, out.segments);
  return rest;
}

}  // namespace ogc::fast
