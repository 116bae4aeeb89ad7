// Limits of settings are exact in single precision, so that a setting stays in its range when it is rounded.
#include "reference/solvers/newton/settings.hpp"

#include <array>

namespace ogc::reference {
namespace {

using enum compare::SettingKind;

constexpr double most_count = 1 << 30;
constexpr std::array<std::string_view, 3> projection_names{"none", "clamp", "absolute"};
constexpr std::array<std::string_view, 2> truncation_names{"vertex", "pair"};  // in the order of Truncation

constexpr std::array<compare::SettingInfo, 6> rows{{
    {"newton_iterations", "1", "newton, penalty: a step has at most so many iterations", 1, most_count,
     compare::DeclaredSetting{whole, 50}},
    {"newton_tolerance", "1",
     "newton, penalty: a step has converged once only this share of the force is left (Eq. 29); 0: a step does all "
     "iterations",
     0, 1, compare::DeclaredSetting{real, 1e-4}},
    {"newton_step_tolerance", "m/s",
     "newton, penalty: a step has converged, too, once no vertex wants to move faster than this; 0: this ends no step",
     0, 0x1p10, compare::DeclaredSetting{real, 0}},
    {"newton_friction_solves", "1",
     "newton, ipc: a step is solved so many times, each time with the friction that the solve before led to", 1,
     1 << 20, compare::DeclaredSetting{whole, 1}},
    {"newton_projection", "1",
     "newton, ipc: negative curvature of an energy is kept (none), set to zero (clamp), or replaced by its absolute "
     "value (absolute)",
     0, 2, compare::DeclaredSetting{choice, static_cast<double>(HessianProjection::clamp)}, projection_names},
    {"newton_truncation", "1",
     "newton: a step is cut at each vertex's bound (vertex), or at planes that travel with near pairs (pair)", 0, 1,
     compare::DeclaredSetting{choice, static_cast<double>(Truncation::vertex)}, truncation_names},
}};

const compare::SettingsDeclaration declaration("newton", rows);

}  // namespace

NewtonSettings newton_settings(const compare::Settings& settings) {
  return {.iterations = static_cast<std::int64_t>(get_setting(settings, "newton_iterations")),
          .tolerance = get_setting(settings, "newton_tolerance"),
          .step_tolerance = get_setting(settings, "newton_step_tolerance"),
          .friction_solves = static_cast<std::int64_t>(get_setting(settings, "newton_friction_solves")),
          .projection = static_cast<HessianProjection>(get_setting(settings, "newton_projection")),
          .truncation = static_cast<Truncation>(get_setting(settings, "newton_truncation"))};
}

}  // namespace ogc::reference
