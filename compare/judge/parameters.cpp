#include "compare/judge/parameters.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {

namespace {

constexpr float least = 0x1p-20f, most = 0x1p20f, tiny = 0x1p-100f;

constexpr ParameterInfo radius{"r", "contact radius [m]", least, most},
    stiffness{"k_c", "contact stiffness [N/m]", 0x1p-30f, 0x1p40f};
constexpr ParameterInfo time_step{"h", "time step [s]", least, 1}, bound_limit{"b", "bound [m]", 0, 0x1p40f};
constexpr ParameterInfo relaxation{"gamma_p", "bound relaxation, Eq. 21", 0x1p-10f, 0.5f - 0x1p-10f},
    friction{"mu", "friction coefficient", 0, 0x1p10f};

constexpr ParameterInfo larger_radius{"r_q", "query radius [m], at least r", least, most};
constexpr std::array detect_parameters{radius, larger_radius};
constexpr std::array bound_parameters{relaxation};
constexpr std::array guess_parameters{time_step, bound_limit};
constexpr std::array activation_parameters{ParameterInfo{"d", "distance [m]", std::numeric_limits<float>::min(), most},
                                           radius, stiffness};
constexpr std::array truncate_parameters{bound_limit};
constexpr std::array contact_parameters{radius, stiffness};
constexpr std::array friction_parameters{radius, stiffness, friction,
                                         ParameterInfo{"slip", "slip limit ε_v h [m]", tiny, most}};
constexpr std::array membrane_parameters{
    ParameterInfo{"lambda", "first Lamé constant times thickness [N/m]", 0, 0x1p40f},
    ParameterInfo{"G", "second Lamé constant times thickness [N/m]", 0x1p-30f, 0x1p40f},
    ParameterInfo{"k", "damping k_d/h", 0, 0x1p20f}};
constexpr std::array bending_parameters{ParameterInfo{"c", "stiffness of the hinge [J]", 0x1p-60f, 0x1p40f},
                                        ParameterInfo{"theta_0", "rest angle [rad]", -3.1415925f, 3.1415925f},
                                        ParameterInfo{"k", "damping k_d/h", 0, 0x1p20f}};
constexpr std::array spring_parameters{ParameterInfo{"k_s", "stiffness of the spring [N/m]", 0x1p-30f, 0x1p40f},
                                       ParameterInfo{"l_0", "rest length [m]", 0, most},
                                       ParameterInfo{"k", "damping k_d/h", 0, 0x1p20f}};
constexpr std::array sweep_parameters{radius, larger_radius, time_step, relaxation, stiffness, friction};
constexpr std::array step_parameters{radius, time_step, relaxation, stiffness, friction};

/// Where a parameter of the table above lives; null where the case does not have it.
struct Place {
  std::string_view name;
  float* operator()(MeshCase& c) const { return name == "r" ? &c.contact_radius : &c.query_radius; }
  float* operator()(BoundCase& c) const { return &c.bound_relaxation; }
  float* operator()(InitialGuessCase& c) const { return name == "h" ? &c.time_step : &c.bound; }
  float* operator()(ActivationCase& c) const {
    return name == "d" ? &c.distance : name == "r" ? &c.contact_radius : &c.stiffness;
  }
  float* operator()(TruncateCase& c) const { return &c.bound; }
  float* operator()(ContactForceCase& c) const { return name == "r" ? &c.contact_radius : &c.stiffness; }
  float* operator()(FrictionForceCase& c) const {
    return name == "mu" ? &c.friction : name == "slip" ? &c.slip_limit : (*this)(c.contact);
  }
  float* operator()(MembraneCase& c) const {
    return name == "lambda" ? &c.lame_lambda : name == "G" ? &c.lame_mu : &c.damping;
  }
  float* operator()(BendingCase& c) const {
    return name == "c" ? &c.stiffness : name == "theta_0" ? &c.rest_angle : &c.damping;
  }
  float* operator()(SpringCase& c) const {
    return name == "k_s" ? &c.stiffness : name == "l_0" ? &c.rest_length : &c.damping;
  }
  template <class Other>
  float* operator()(Other&) const {
    return nullptr;
  }
};

void set_in_scene(Scene& scene, const Override& parameter) {
  const double value = parameter.value;
  if (parameter.name == "r") scene.settings.contact_radius = value;
  if (parameter.name == "h") scene.settings.time_step = value;
  if (parameter.name == "gamma_p") scene.settings.bound_relaxation = value;
  for (Body& body : scene.bodies) {
    if (parameter.name == "k_c") body.material.contact_stiffness = value;
    if (parameter.name == "mu") body.material.friction = value;
  }
}

std::shared_ptr<const Scene> with_parameters(const Scene& scene, const std::vector<Override>& overrides) {
  auto changed = std::make_shared<Scene>(scene);
  for (const Override& parameter : overrides) set_in_scene(*changed, parameter);
  return changed;
}

void check_radii(const TestCase& test, float contact_radius, float query_radius) {
  if (contact_radius > query_radius)
    throw InputError("'" + print_problem(test.name) +
                     "': the contact radius is above the query radius; give r_q too, at least as large as r");
}

std::string names_of(Stage stage) {
  std::string names;
  for (const ParameterInfo& info : parameters(stage)) names += (names.empty() ? "" : ", ") + std::string(info.name);
  return names.empty() ? "none" : names;
}

}  // namespace

std::span<const ParameterInfo> parameters(Stage stage) {
  switch (stage) {
    case Stage::detect_vertex_facet:
    case Stage::detect_edge_edge: return detect_parameters;
    case Stage::bound: return bound_parameters;
    case Stage::initial_guess: return guess_parameters;
    case Stage::activation: return activation_parameters;
    case Stage::truncate: return truncate_parameters;
    case Stage::contact_force: return contact_parameters;
    case Stage::friction_force: return friction_parameters;
    case Stage::membrane: return membrane_parameters;
    case Stage::bending: return bending_parameters;
    case Stage::spring: return spring_parameters;
    case Stage::sweep: return sweep_parameters;
    case Stage::step: return step_parameters;
    default: return {};
  }
}

void make_canonical(Stage stage, std::vector<Override>& overrides) {
  std::vector<Override> ordered;
  for (const ParameterInfo& info : parameters(stage)) {
    const auto is_it = [&](const Override& parameter) { return parameter.name == info.name; };
    const auto count = std::count_if(overrides.begin(), overrides.end(), is_it);
    if (count == 0) continue;
    if (count > 1) throw InputError("problem string: '" + std::string(info.name) + "' is given twice");
    const Override& given = *std::find_if(overrides.begin(), overrides.end(), is_it);
    if (!(given.value >= info.minimum && given.value <= info.maximum))
      throw InputError("problem string: " + std::string(info.name) + " (" + std::string(info.meaning) +
                       ") lies between " + shortest(as_typed(info.minimum)) + " and " +
                       shortest(as_typed(info.maximum)));
    ordered.push_back(given);
  }
  for (const Override& given : overrides)
    if (std::none_of(ordered.begin(), ordered.end(), [&](const Override& known) { return known.name == given.name; }))
      throw InputError("problem string: stage " + std::string(stage_name(stage)) + " has no parameter '" + given.name +
                       "'; it has: " + names_of(stage) + "; other keys: stage, gen, seed, index, states");
  overrides = std::move(ordered);
}

void apply_overrides(TestCase& test) {
  const auto& overrides = test.name.overrides;
  if (auto* sweep = std::get_if<SweepCase>(&test.data)) {
    sweep->scene = with_parameters(*sweep->scene, overrides);
    for (const Override& parameter : overrides)
      if (parameter.name == larger_radius.name) sweep->query_radius = parameter.value;
    check_radii(test, static_cast<float>(sweep->scene->settings.contact_radius), sweep->query_radius);
    return;
  }
  if (auto* step = std::get_if<StepCase>(&test.data)) {
    step->scene = with_parameters(*step->scene, overrides);
    return;
  }
  for (const Override& parameter : overrides)
    if (float* place = std::visit([&](auto& c) { return Place{parameter.name}(c); }, test.data))
      *place = parameter.value;
  if (const auto* mesh = std::get_if<MeshCase>(&test.data)) check_radii(test, mesh->contact_radius, mesh->query_radius);
}

}  // namespace ogc::compare
