// Limits of settings are numbers that single precision holds exactly, so that rounding can't take a setting out of its
// range.
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
    {"ipc_distance", "m", "IPC: distance at which the barrier begins to act; 0: by ipc_relative_distance", 0,
     most_length, Declared{real, 0}},
    {"ipc_relative_distance", "1", "IPC: the same distance as a share of the diagonal of the scene's box at rest",
     least_length, 1, Declared{real, 1e-3}},
    {"ipc_thickness", "m", "IPC: the distance that surfaces keep at least", 0, most_length, Declared{real, 0}},
    {"ipc_stiffness", "J/m⁴", "IPC: stiffness of the barrier, held fixed; 0: it adapts", 0, 0x1p120, Declared{real, 0}},
    {"ipc_adaptation", "1",
     "IPC: whether the stiffness adapts to distances, or to the gaps that a thickness leaves of them", 0, 1,
     Declared{choice, static_cast<double>(IpcAdaptation::distance)}, adaptation_names},
    {"ipc_stopping", "1",
     "IPC: whether the last iteration's displacement ends a step, or the mean velocity of the last three", 0, 1,
     Declared{choice, static_cast<double>(IpcStopping::displacement)}, stopping_names},
    {"ipc_ccd", "1", "IPC: whether the pairs near each other alone limit a move, or all pairs", 0, 1,
     Declared{choice, static_cast<double>(IpcCcd::partial)}, ccd_names},
    {"ipc_tolerance", "1/s",
     "IPC, displacement: motion at which a step ends, in diagonals of the smallest free body's box a second; 0: all "
     "iterations are done",
     0, 0x1p10, Declared{real, 1e-2}},
    {"ipc_velocity_tolerance", "m/s", "IPC, velocity: mean velocity at which a step ends; 0: all iterations are done",
     0, 0x1p10, Declared{real, 1e-3}},
    {"ipc_iterations", "1", "IPC: iterations in a step at most", 1, most_count, Declared{whole, 10000}},
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
