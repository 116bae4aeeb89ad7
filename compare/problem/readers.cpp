#include "compare/problem/readers.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <variant>

#include "compare/problem/error.hpp"

namespace ogc::compare {
namespace {

/// One row: the solvers that read `setting` if it has `value`; "" stands for any value but the default.
struct Readers {
  std::string_view setting, value;
  std::array<std::string_view, 4> solvers;  ///< "" after the last one
  std::string_view why;                     ///< reason why other solvers do not read it
  bool has(std::string_view solver) const { return std::ranges::find(solvers, solver) != solvers.end(); }
};

constexpr auto table = std::to_array<Readers>({
    {"bounds", "dat", {"vbd", "reference_vbd"}, "whose line search scales all vertices at once"},
    {"detection_gap", "", {"vbd", "reference_vbd"}, "whose iterations detect where a line search ends"},
    {"detection_deep", "", {"vbd", "reference_vbd"}, "whose iterations detect where a line search ends"},
    {"settled_move", "", {"vbd", "reference_vbd"}, "which ends its steps by tolerances of its own"},
    {"newton_truncation", "", {"newton"}, "which holds no pairs to planes that travel with them"},
    {"rod_orientation", "", {"vbd", "reference_vbd"}, "which sweeps over no orientations"},
    {"reference_contact_set", "", {"reference_vbd", "newton", "penalty"}, "which lists the method's contacts"},
    {"reference_vbd_colours", "", {"reference_vbd"}, "which has colours of its own, or none"},
    {"reference_vbd_contact_blocks", "", {"reference_vbd"}, "which has blocks of its own, or none"},
    {"reference_vbd_cut_after", "", {"reference_vbd"}, "which cuts as the method does"},
});

constexpr auto required = std::to_array<RequiredSetting>({
    {"penalty", "bounds", "off"},
    {"penalty", "contact_activation", "quadratic"},
});

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

/// Returns whether the setting has the row's value; if that is "", whether the setting differs from its default.
bool is_asked(const Settings& settings, const SettingInfo& info, const Readers& row) {
  if (!row.value.empty()) return setting_text(settings, info) == row.value;
  return get_setting(settings, info) != get_setting(Settings{}, info);
}

std::string joined(const Readers& row) {
  std::string all;
  for (const std::string_view solver : row.solvers)
    if (!solver.empty()) all += (all.empty() ? "" : " or ") + std::string(solver);
  return all;
}

}  // namespace

std::span<const RequiredSetting> required_settings() { return required; }

void refuse_unread(const Settings& settings, std::string_view solver) {
  for (const SettingInfo& info : setting_table()) {
    for (const RequiredSetting& own : required)
      if (own.solver == solver && own.setting == info.name && setting_text(settings, info) != own.value)
        throw InputError("setting " + quoted(info.name) + " can't be " + quoted(setting_text(settings, info)) +
                         " with --solver " + std::string(solver) + ", which has " + std::string(info.name) + "=" +
                         std::string(own.value) + "; give that, or another solver");
    for (const Readers& row : table)
      if (row.setting == info.name && !row.has(solver) && is_asked(settings, info, row))
        throw InputError("setting " + quoted(info.name) + " can't be " + quoted(setting_text(settings, info)) +
                         " with --solver " + std::string(solver) + ", " + std::string(row.why) + "; leave it out, or " +
                         "take --solver " + joined(row) + ", which reads it");
  }
}

bool has_declared_settings() {
  return std::ranges::any_of(
      setting_table(), [](const SettingInfo& info) { return std::holds_alternative<DeclaredSetting>(info.field); });
}

}  // namespace ogc::compare
