// The limits of settings are single-precision numbers, so that rounding cannot take a setting out of its range.
#include "reference/ipc/settings.hpp"

#include <array>

namespace ogc::reference {
namespace {

using enum compare::SettingKind;
using Declared = compare::DeclaredSetting;

constexpr double most_count = 1 << 30, least_length = 0x1p-20, most_length = 0x1p20;
constexpr std::array<std::string_view, 2> adaptation_names{"distance", "gap"};
constexpr std::array<std::string_view, 2> stopping_names{"displacement", "velocity"};
constexpr std::array<std::string_view, 2> ccd_names{"partial", "full"};

constexpr std::array<compare::SettingInfo, 10> rows{{
    {"ipc_distance", "m", "ipc: the barrier begins to act at this distance; 0: ipc_relative_distance says where", 0,
     most_length, Declared{real, 0}},
    {"ipc_relative_distance", "1", "ipc: the same distance is this share of the diagonal of the scene's box at rest",
     least_length, 1, Declared{real, 1e-3}},
    {"ipc_thickness", "m", "ipc: surfaces keep at least this distance", 0, most_length, Declared{real, 0}},
    {"ipc_stiffness", "J/m⁴", "ipc: the barrier has this fixed stiffness; 0: the stiffness adapts", 0, 0x1p120,
     Declared{real, 0}},
    {"ipc_adaptation", "1",
     "ipc: the stiffness adapts to distances (distance), or to distances less ipc_thickness (gap)", 0, 1,
     Declared{choice, static_cast<double>(IpcAdaptation::distance)}, adaptation_names},
    {"ipc_stopping", "1",
     "ipc: a step ends by the displacement of the last iteration (displacement), or by the mean velocity of the last "
     "three (velocity)",
     0, 1, Declared{choice, static_cast<double>(IpcStopping::displacement)}, stopping_names},
    {"ipc_ccd", "1", "ipc: pairs that are near each other limit a move (partial), or all pairs do (full)", 0, 1,
     Declared{choice, static_cast<double>(IpcCcd::partial)}, ccd_names},
    {"ipc_tolerance", "1/s",
     "ipc, with ipc_stopping=displacement: a step ends at this motion, in diagonals of the smallest free body's box a "
     "second; 0: a step does all iterations",
     0, 0x1p10, Declared{real, 1e-2}},
    {"ipc_velocity_tolerance", "m/s",
     "ipc, with ipc_stopping=velocity: a step ends at this mean velocity; 0: a step does all iterations", 0, 0x1p10,
     Declared{real, 1e-3}},
    {"ipc_iterations", "1", "ipc: a step has at most so many iterations", 1, most_count, Declared{whole, 10000}},
}};

const compare::SettingsDeclaration declaration("ipc", rows);

}  // namespace

IpcSettings ipc_settings(const compare::Settings& settings) {
  return {.distance = get_setting(settings, "ipc_distance"),
          .relative_distance = get_setting(settings, "ipc_relative_distance"),
          .thickness = get_setting(settings, "ipc_thickness"),
          .stiffness = get_setting(settings, "ipc_stiffness"),
          .adaptation = static_cast<IpcAdaptation>(get_setting(settings, "ipc_adaptation")),
          .stopping = static_cast<IpcStopping>(get_setting(settings, "ipc_stopping")),
          .ccd = static_cast<IpcCcd>(get_setting(settings, "ipc_ccd")),
          .tolerance = get_setting(settings, "ipc_tolerance"),
          .velocity_tolerance = get_setting(settings, "ipc_velocity_tolerance"),
          .iterations = static_cast<std::int64_t>(get_setting(settings, "ipc_iterations"))};
}

}  // namespace ogc::reference
