// Constants of materials that --set can be given: of contact for every body, of solids for every one that has
// tetrahedra.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// One constant, for lists and help.
struct MaterialSetting {
  std::string_view name, unit;
  std::string range;  ///< "0 to 1024"
  std::string meaning;
};

/// All of them.
std::vector<MaterialSetting> material_settings();

/// Gives the constant of that name to the scene's bodies; false where there is no such constant. Young's modulus keeps
/// Poisson's ratio, and the other way round. Throws compare::InputError for a value that is no number or out of range,
/// and for a constant of solids where the scene has none.
bool set_material(compare::Scene& scene, const std::string& key, const std::string& value);

/// Of all "key=value" those that name a constant of solids, given to the scene: what a solid is made of must be known
/// before settings can follow from it. Others are left alone.
void set_solid_constants(compare::Scene& scene, const std::vector<std::string>& assignments);

}  // namespace ogc::experiments
