#include "fast/stages/settings.hpp"

#include <array>
#include <string>

#include "compare/problem/error.hpp"
#include "compare/problem/rods.hpp"
#include "compare/problem/settings.hpp"
#include "fast/kernels/skin.hpp"

namespace ogc::fast {
namespace {

constexpr double by_scene = -1;

constexpr std::array<compare::SettingInfo, 1> rows{{
    {"skin", "r",
     "largest margin within which a detection of vbd keeps pairs, which the next ones look at again in place of a "
     "search; it changes the time alone; 0: each searches; -1: 1 for rods without triangles, else 0",
     by_scene, 8, compare::DeclaredSetting{compare::SettingKind::real, by_scene}},
}};

const compare::SettingsDeclaration declaration("vbd", rows);

}  // namespace

float skin_share(const compare::Scene& scene) {
  const double asked = get_setting(scene.settings, "skin");
  const bool has_planes = compare::has_planes(scene.settings.bounds),
             searches = has_planes || scene.settings.guess == compare::Guess::pairs;
  if (asked > 0 && searches)
    throw compare::InputError("setting 'skin' can't be above 0 with " +
                              std::string(has_planes ? "bounds=planes and bounds=dat" : "guess=pairs") +
                              ", which search at each detection; leave it out");
  if (asked >= 0) return static_cast<float>(asked);
  return has_rods(scene) && scene.mesh.triangles.empty() && !searches ? usual_skin : 0;
}

}  // namespace ogc::fast
