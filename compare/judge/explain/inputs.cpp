#include "compare/judge/explain/inputs.hpp"

#include <span>

#include "compare/judge/explain/parts.hpp"
#include "compare/judge/features.hpp"
#include "compare/judge/force_members.hpp"

namespace ogc::compare {

namespace {

const std::vector<std::string> edge_ends{"end 0", "end 1"}, triangle_corners{"vertex 0", "vertex 1", "vertex 2"};

/// What the vertices of a contact are.
std::vector<std::string> roles(ContactSides sides) {
  switch (sides) {
    case ContactSides::point_point: return {"vertex 0, the first point", "vertex 1, the second point"};
    case ContactSides::point_edge: return {"vertex 0, the point", "vertex 1, of the edge", "vertex 2, of the edge"};
    case ContactSides::edge_edge:
      return {"vertex 0, of the first edge", "vertex 1, of the first edge", "vertex 2, of the second edge",
              "vertex 3, of the second edge"};
    case ContactSides::point_triangle:
      return {"vertex 0, the point", "vertex 1, of the triangle", "vertex 2, of the triangle",
              "vertex 3, of the triangle"};
  }
  return {};
}

/// What the vertices of a stencil are; those that it lacks are left out.
std::vector<std::string> roles(const MembraneCase&) { return {"corner 0, asked about", "corner 1", "corner 2"}; }
std::vector<std::string> roles(const BendingCase&) {
  return {"vertex 0, x0 of the edge", "vertex 1, x1 of the edge", "vertex 2, opposite o0", "vertex 3, opposite o1"};
}
std::vector<std::string> roles(const SpringCase& c) {
  if (c.ratio == 0) return {"vertex 0, one end", "vertex 1, the other end"};
  return {"vertex 0, the end", "vertex 1, of the edge", "vertex 2, of the edge"};
}
std::vector<std::string> roles(const ContactForceCase& c) { return roles(c.sides); }
std::vector<std::string> roles(const FrictionForceCase& c) { return roles(c.contact.sides); }

/// Members of a force stage's case, one after another.
class StencilInputs {
 public:
  StencilInputs(std::vector<std::string> roles, std::vector<Quantity>& inputs)
      : roles_(std::move(roles)), inputs_(inputs) {}
  void operator()(const char* name, const char* unit, float x) { inputs_.push_back(scalar(name, unit, x)); }
  void operator()(const char* name, const char*, std::int32_t own) {
    inputs_.push_back(word(name, roles_.at(static_cast<std::size_t>(own))));
  }
  void operator()(const char* name, const char*, std::uint8_t bits) {
    std::string all;
    for (std::size_t k = 0; k < roles_.size(); ++k)
      if ((bits >> k & 1) != 0) all += (all.empty() ? "" : "; ") + roles_[k];
    inputs_.push_back(word(name, all.empty() ? "none" : all));
  }
  void operator()(const char* name, const char*, Named auto x) {
    inputs_.push_back(word(name, std::string(names_of(x)[static_cast<std::size_t>(x)])));
  }
  template <std::size_t n>
  void operator()(const char* name, const char* unit, const std::array<Vec3f, n>& stencil) {
    inputs_.push_back(points(name, unit, std::span(stencil).first(roles_.size())));
    inputs_.back().labels = roles_;
  }
  template <std::size_t n>
  void operator()(const char* name, const char* unit, const std::array<float, n>& values) {
    inputs_.push_back(numbers(name, unit, values));
  }

 private:
  std::vector<std::string> roles_;
  std::vector<Quantity>& inputs_;
};

struct Inputs {
  std::vector<Quantity> all;

  void add(Quantity quantity) { all.push_back(std::move(quantity)); }
  void labelled(Quantity quantity, const std::vector<std::string>& labels) {
    quantity.labels = labels;
    add(std::move(quantity));
  }
  void mesh(const Topology& topology) {
    add(count("vertices", static_cast<std::size_t>(topology.vertex_count)));
    add(indices("triangles", topology.triangles));
    std::vector<Edge> loose;
    for (std::size_t e = 0; e < topology.edges.size(); ++e)
      if (topology.edge_triangles[e].empty()) loose.push_back(topology.edges[e]);
    if (!loose.empty()) add(indices("loose_edges", loose));
  }
  void scene(const Scene& scene) {
    for (const SettingInfo& info : setting_table()) {
      if (info.name.starts_with("newton") || info.name.starts_with("ipc")) continue;  // no stage reads them
      const bool is_choice = !info.choices.empty();
      add(is_choice ? word(std::string(info.name), setting_text(scene.settings, info))
                    : scalar(std::string(info.name), std::string(info.unit), get_setting(scene.settings, info)));
    }
    add(points("gravity", "m/s²", std::array{scene.gravity}));
    for (const Body& body : scene.bodies) {
      const std::string of = body.name + ".";
      add(word(of + "vertices",
               std::to_string(body.first_vertex) + " to " + std::to_string(body.first_vertex + body.vertex_count - 1)));
      add(word(of + "membrane", std::string(name_of(body.material.membrane))));
      add(word(of + "bending", std::string(name_of(body.material.bending))));
      for (const MaterialInfo& info : material_table())
        add(scalar(of + std::string(info.name), std::string(info.unit), body.material.*info.field));
    }
  }

  void operator()(const ClosestFaceCase& c) {
    add(points("point", "m", std::array{c.point}));
    labelled(points("triangle", "m", c.triangle), triangle_corners);
  }
  void operator()(const ClosestPointsCase& c) {
    labelled(points("first", "m", c.first), edge_ends);
    labelled(points("second", "m", c.second), edge_ends);
  }
  void operator()(const MeshCase& c) {
    add(scalar("contact_radius", "m", c.contact_radius));
    add(scalar("query_radius", "m", c.query_radius));
    mesh(*c.topology);
    add(points("positions", "m", c.positions));
    add(indices("rigid_groups", c.rigid_groups));
    if (c.partners.rows() > 0) add(indices("excluded_pairs", pairs_of(c.partners)));
  }
  void operator()(const BoundCase& c) {
    add(scalar("bound_relaxation", "1", c.bound_relaxation));
    mesh(*c.topology);
    add(numbers("d_min_vertex", "m", c.d_min_vertex));
    add(numbers("d_min_edge", "m", c.d_min_edge));
    add(numbers("d_min_triangle", "m", c.d_min_triangle));
  }
  void operator()(const ActivationCase& c) {
    add(scalar("distance", "m", c.distance));
    add(scalar("contact_radius", "m", c.contact_radius));
    add(scalar("stiffness", "N/m", c.stiffness));
    add(word("activation", std::string(names_of(c.activation)[static_cast<std::size_t>(c.activation)])));
  }
  void operator()(const TruncateCase& c) {
    add(points("previous", "m", std::array{c.previous}));
    add(points("position", "m", std::array{c.position}));
    add(scalar("bound", "m", c.bound));
  }
  void operator()(const InitialGuessCase& c) {
    add(points("start", "m", std::array{c.start}));
    add(points("velocity", "m/s", std::array{c.velocity}));
    add(points("acceleration", "m/s²", std::array{c.acceleration}));
    add(scalar("time_step", "s", c.time_step));
    add(points("previous", "m", std::array{c.previous}));
    add(scalar("bound", "m", c.bound));
    add(word("held", c.held ? "yes" : "no"));
  }
  void operator()(const BlockCase& c) {
    mesh(*c.topology);
    add(points("positions", "m", c.positions));
    std::vector<std::string> questions;
    for (const BlockQuestion& question : c.questions) questions.push_back(question_name(question, *c.topology));
    add(words("questions", questions));
  }
  void operator()(const RestStateCase& c) {
    mesh(*c.topology);
    scene(*c.scene);
    add(points("rest_positions", "m", c.scene->rest_positions));
  }
  void operator()(const StepCase& c) {
    mesh(*c.topology);
    scene(*c.scene);
    add(points("positions", "m", c.scene->mesh.positions));
    add(points("velocities", "m/s", c.scene->velocities));
  }
  void operator()(const SweepCase& c) {
    mesh(build_topology(*c.scene));
    scene(*c.scene);
    add(scalar("query_radius", "m", c.query_radius));
    add(indices("colour", c.colour));
    add(points("old", "m", c.old));
    add(points("start", "m", c.start));
    add(points("target", "m", c.target));
    add(points("previous", "m", c.previous));
    add(numbers("largest_bound", "m", c.largest_bound));
  }
  template <class ForceCase>
  void operator()(const ForceCase& c) {
    visit_members(c, StencilInputs(roles(c), all));
  }
};

}  // namespace

std::vector<Quantity> inputs_of(const CaseData& data) {
  Inputs inputs;
  std::visit([&](const auto& c) { inputs(c); }, data);
  return std::move(inputs.all);
}

}  // namespace ogc::compare
