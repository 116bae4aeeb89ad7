#include "fast/stages/settings.hpp"

#include <array>
#include <string>

#include "compare/problem/error.hpp"
#include "compare/problem/settings.hpp"

namespace ogc::fast {
namespace {

constexpr std::array<compare::SettingInfo, 1> rows{{
    {"skin", "r",
     "largest margin within which a detection of vbd keeps pairs, which the next ones look at again in place of a "
     "search; it changes the time alone; 0: each searches",
     0, 8, compare::DeclaredSetting{compare::SettingKind::real, 0}},
}};

const compare::SettingsDeclaration declaration("vbd", rows);

}  // namespace

float skin_share(const compare::Scene& scene) {
  const double asked = get_setting(scene.settings, "skin");
  const bool has_planes = traits_of(scene.settings.bounds).has_planes;
  if (asked > 0 && (has_planes || scene.settings.guess == compare::Guess::pairs))
    throw compare::InputError("setting 'skin' can't be above 0 with " +
                              std::string(has_planes ? "bounds=planes and bounds=dat" : "guess=pairs") +
                              ", which search at each detection; leave it out");
  return static_cast<float>(asked);
}

}  // namespace ogc::fast
