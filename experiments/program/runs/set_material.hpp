// Declares the constants of materials that --set accepts: those of contact for every body, those of solids for every
// body with tetrahedra.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Holds one constant, for lists and help.
struct MaterialSetting {
  std::string_view name, unit;
  std::string range;  ///< "0 to 1024"
  std::string meaning;
};

/// Returns all constants.
std::vector<MaterialSetting> material_settings();

/// Sets the constant of that name for the scene's bodies; returns false if there is no such constant. Setting Young's
/// modulus keeps Poisson's ratio, and vice versa. Throws compare::InputError for a value that is not a number or out of
/// range, and for a constant of solids if the scene has none.
bool set_material(compare::Scene& scene, const std::string& key, const std::string& value);

/// Sets those "key=value" that name a constant of solids and leaves the others alone. The material of a solid must be
/// known before settings are derived from it.
void set_solid_constants(compare::Scene& scene, const std::vector<std::string>& assignments);

}  // namespace ogc::experiments
