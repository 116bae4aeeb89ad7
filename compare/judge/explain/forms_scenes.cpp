// Forms of rest_state and sweep.
#include <cmath>

#include "compare/judge/explain/form_tools.hpp"

namespace ogc::compare {

namespace {

void scale(std::vector<double>& values, double factor) {
  for (double& x : values) x *= factor;
}

/// The rounded answer from the values.
void round_exact(RestStateTruth& truth) {
  RestStateOut& exact = truth.exact;
  exact.mass.assign(truth.mass.begin(), truth.mass.end());
  exact.edge_length_squared.assign(truth.edge_length_squared.begin(), truth.edge_length_squared.end());
  for (std::size_t t = 0; t < exact.triangles.size(); ++t) {
    exact.triangles[t].area = static_cast<float>(truth.area[t]);
    for (std::size_t k = 0; k < 2; ++k)
      exact.triangles[t].gradient[k] = {static_cast<float>(truth.gradient[t][k][0]),
                                        static_cast<float>(truth.gradient[t][k][1])};
  }
  for (std::size_t i = 0; i < exact.hinges.size(); ++i) {
    exact.hinges[i].rest_angle = static_cast<float>(truth.rest_angle[i]);
    exact.hinges[i].stiffness = static_cast<float>(truth.stiffness[i]);
  }
}

template <class Change>
WrongForm rest_told(std::string name, std::string meaning, Change change) {
  return told(std::move(name), std::move(meaning), &Authority::rest_state,
              [change](const RestStateIn&, RestStateTruth& truth) {
                change(truth);
                round_exact(truth);
              });
}

}  // namespace

std::vector<WrongForm> rest_state_forms() {
  return {
      rest_told("area_not_halved", "twice the area of each triangle: the cross product itself",
                [](RestStateTruth& truth) { scale(truth.area, 2), scale(truth.area_scale, 2); }),
      rest_told("mass_of_whole_triangles", "ρ A in place of ρ A/3 for each corner",
                [](RestStateTruth& truth) { scale(truth.mass, 3), scale(truth.mass_scale, 3); }),
      rest_told("rest_angle_flipped", "θ₀ with the other sign",
                [](RestStateTruth& truth) { scale(truth.rest_angle, -1); }),
      rest_told("rest_angle_missing", "θ₀ is 0", [](RestStateTruth& truth) { scale(truth.rest_angle, 0); }),
      rest_told("hinge_stiffness_third", "k_b ‖e‖²/(A₀ + A₁) without the factor 3",
                [](RestStateTruth& truth) { scale(truth.stiffness, 1.0 / 3), scale(truth.stiffness_scale, 1.0 / 3); }),
      rest_told("lengths_not_squared", "lengths of edges in place of their squares",
                [](RestStateTruth& truth) {
                  for (double& x : truth.edge_length_squared) x = std::sqrt(x);
                  for (double& x : truth.edge_length_squared_scale) x = std::sqrt(x);
                }),
      rest_told("gradients_exchanged", "∇N₁ and ∇N₂ exchanged", [](RestStateTruth& truth) {
        for (auto& gradient : truth.gradient) std::swap(gradient[0], gradient[1]);
        for (auto& scales : truth.gradient_scale) std::swap(scales[0], scales[1]);
      })};
}

namespace {

/// What a sweep reads, as copies that a form may change.
struct Read {
  SweepIn in;
  Scene scene;
  RestStateOut rest;
  std::vector<Index> colour;
};

template <class Change>
WrongForm sweep_asked(std::string name, std::string meaning, Change change) {
  return form_of(std::move(name), std::move(meaning), [change](const Authority& authority) {
    Authority wrong = authority;
    wrong.sweep = [right = authority.sweep, change](const SweepIn& in, const SweepOut& out) {
      Read read{in, *in.scene, *in.rest, {in.colour.begin(), in.colour.end()}};
      change(read);
      read.in.colour = read.colour;
      read.in.scene = &read.scene;
      read.in.rest = &read.rest;
      return right(read.in, out);
    };
    return wrong;
  });
}

template <class Change>
auto materials(Change change) {
  return [change](Read& read) {
    for (Body& body : read.scene.bodies) change(body.material);
  };
}

template <class Change>
auto meetings(Change change) {
  return [change](Read& read) {
    for (MeetingMaterial& meeting : read.rest.meetings) change(meeting);
  };
}

}  // namespace

std::vector<WrongForm> sweep_forms() {
  std::vector<WrongForm> forms{
      sweep_asked("contacts_missing", "no contact acts",
                  [](Read& read) { read.in.vertex_facet = {}, read.in.edge_edge = {}; }),
      sweep_asked("vertex_facet_missing", "contacts of vertices with facets do not act",
                  [](Read& read) { read.in.vertex_facet = {}; }),
      sweep_asked("edge_edge_missing", "contacts of edges do not act", [](Read& read) { read.in.edge_edge = {}; }),
      sweep_asked("contacts_twice_as_stiff", "2 k_c for k_c", meetings([](MeetingMaterial& m) { m.stiffness *= 2; })),
      sweep_asked("friction_missing", "no friction", meetings([](MeetingMaterial& m) { m.friction = 0; })),
      sweep_asked("membranes_missing", "no membrane acts", [](Read& read) { read.rest.triangles.clear(); }),
      sweep_asked("bending_missing", "no hinge acts", [](Read& read) { read.rest.hinges.clear(); }),
      sweep_asked("springs_missing", "no spring acts", [](Read& read) { read.scene.springs.clear(); }),
      sweep_asked("mollifier_missing", "e_k is 1: nearly parallel edges act in full",
                  [](Read& read) { read.rest.edge_length_squared.assign(read.rest.edge_length_squared.size(), -1); }),
      sweep_asked("damping_missing", "membranes, hinges and springs without damping",
                  [](Read& read) {
                    materials([](Material& m) { m.membrane_damping = m.bending_damping = 0; })(read);
                    for (Spring& spring : read.scene.springs) spring.damping = 0;
                  }),
      sweep_asked("bending_damping_missing", "hinges without damping",
                  materials([](Material& m) { m.bending_damping = 0; })),
      sweep_asked("membrane_damping_missing", "membranes without damping",
                  materials([](Material& m) { m.membrane_damping = 0; })),
      sweep_asked("jacobi", "every neighbour is read where it was before the sweep, whatever its colour",
                  [](Read& read) {
                    for (Index& colour : read.colour)
                      if (colour > 0) colour = 0;
                  })};
  for (const auto& [kind, name, meaning] : other_activations)
    forms.push_back(sweep_asked(name, std::string(meaning) + ", where `ogc` is asked for", [to = kind](Read& read) {
      if (read.scene.settings.activation == ContactActivation::ogc) read.scene.settings.activation = to;
    }));
  return forms;
}

}  // namespace ogc::compare
