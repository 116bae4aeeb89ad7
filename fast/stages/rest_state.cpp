#include "fast/stages/rest_state.hpp"

#include <string>

#include "compare/problem/element_names.hpp"
#include "compare/problem/error.hpp"
#include "fast/kernels/rest_state.hpp"

namespace ogc::fast {
namespace {

/// Returns the rest data that do not depend on the rest shape: mobility, materials and models.
RestState without_shape(const compare::Scene& scene) {
  RestState rest;
  rest.body = compare::body_of_vertex(scene);
  rest.mobility.assign(rest.body.size(), Mobility::free);
  const double h = scene.settings.time_step;
  for (const compare::Body& body : scene.bodies) {
    if (body.fixed) {
      for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v)
        rest.mobility[as_index(v)] = Mobility::fixed;
    }
    rest.materials.push_back({static_cast<float>(body.material.lame_lambda), static_cast<float>(body.material.lame_mu),
                              static_cast<float>(body.material.membrane_damping / h),
                              static_cast<float>(body.material.bending_damping / h)});
    rest.models.push_back({body.material.membrane, body.material.bending, scene.settings.damping});
  }
  rest.activation = scene.settings.contact_activation;
  for (const compare::PrescribedMotion& motion : scene.motions) {
    for (const int v : motion.vertices) rest.mobility[as_index(v)] = Mobility::prescribed;
  }
  return rest;
}

template <class... All, class... From>
void add_elements(KindList<All...>, RestState& rest, const From&... from) {
  (static_cast<AtRest<All>&>(rest).add(from...), ...);
}
template <class... All>
void give_elements(KindList<All...>, const RestState& rest, compare::RestStateOut& out) {
  (at_rest<All>(rest).give(out), ...);
}

void set_masses(const compare::Scene& scene, const std::vector<double>& mass, RestState& rest) {
  for (std::size_t v = 0; v < mass.size(); ++v) {
    rest.mass.push_back(static_cast<float>(mass[v]));
    if (rest.mobility[v] == Mobility::free && !(rest.mass[v] > 0)) {
      throw compare::InputError(compare::ElementNames(scene).vertex(static_cast<compare::Index>(v)) +
                                " moves but has no mass: give it a triangle, a tetrahedron or a rod's edge and a "
                                "density above zero, or hold it by a motion or a fixed body");
    }
  }
}

void add_edge_lengths(const compare::Scene& scene, const compare::Topology& topology, RestState& rest) {
  for (const compare::Edge& edge : topology.edges) {
    const RestVector e = rest_difference(scene.rest_positions[as_index(edge[1])],
                                         scene.rest_positions[as_index(edge[0])]);
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
  std::vector<double> mass(scene.mesh.positions.size(), 0.0);
  add_elements(Kinds{}, rest, RestBuild{scene, topology, rest, mass});
  set_masses(scene, mass, rest);
  add_edge_lengths(scene, topology, rest);
  add_contact_materials(scene, rest);
  return rest;
}

compare::RestStateOut rest_state_out(const compare::RestStateIn& in) {
  const RestState rest = build_rest_state(*in.scene, *in.topology);
  compare::RestStateOut out;
  out.mass = rest.mass;
  out.edge_length_squared = rest.edge_length_squared;
  for (const ContactMaterial& m : rest.contact) out.meetings.push_back({m.stiffness, m.friction});
  give_elements(Kinds{}, rest, out);
  return out;
}

RestState rest_state_of(const compare::RestStateIn& in, const compare::RestStateOut& out) {
  RestState rest = without_shape(*in.scene);
  rest.mass = out.mass;
  rest.edge_length_squared = out.edge_length_squared;
  for (const compare::MeetingMaterial& m : out.meetings) rest.contact.push_back({m.stiffness, m.friction});
  add_elements(Kinds{}, rest, in, out);
  return rest;
}

}  // namespace ogc::fast
