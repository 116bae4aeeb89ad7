// Declares the material constants that --set accepts: constants of contact for every body, constants of solids for
// every body with tetrahedra.
#pragma once

#include <string>
#include <vector>

#include "compare/problem/scene.hpp"

namespace ogc::experiments {

/// Describes one constant for lists and help texts.
struct MaterialSetting {
  std::string_view name, unit;
  std::string range;  ///< "0 to 1024"
  std::string meaning;
};

/// Returns all constants.
std::vector<MaterialSetting> material_settings();

/// Sets the named constant for the scene's bodies. Returns false if there is no such constant. Setting Young's modulus
/// keeps Poisson's ratio, and vice versa. Throws compare::InputError if the value is no number or out of range, or if a
/// constant of solids is set for a scene without solids.
bool set_material(compare::Scene& scene, const std::string& key, const std::string& value);

/// Sets the constants of solids among the assignments ("key=value") and ignores the others. Must be called before
/// settings are suggested, because these depend on a solid's material.
void set_solid_constants(compare::Scene& scene, const std::vector<std::string>& assignments);

}  // namespace ogc::experiments
