// Lists every constant of a material with unit and range. Validation, rounding, scene files and their schema read this
// table.
#pragma once

#include <span>
#include <string_view>

#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// One row of the table of material constants.
struct MaterialInfo {
  std::string_view name, unit, meaning;  ///< "contact_stiffness", "N/m", one line
  double minimum, maximum;               ///< inclusive; single precision holds both exactly
  double Material::*field;               ///< the member that it sets
};

/// Returns the rows of all constants, in the order of the struct. Ranges are so small that squares of constants and
/// products of two constants are finite and normal in single precision.
std::span<const MaterialInfo> material_table();

/// Holds what files and settings may give in place of a solid's Lamé constants.
struct Elasticity {
  double young = 0;    ///< Young's modulus E [Pa]
  double poisson = 0;  ///< Poisson's ratio ν [1]
};

/// Ranges of E and ν for which the Lamé constants are within their ranges.
inline constexpr double least_young = 0x1p-28, most_young = 0x1p30, most_poisson = 0.4999;

/// Returns E and ν of a solid.
Elasticity elasticity_of(const Material& material);
/// Sets μ = E/(2(1 + ν)) and λ = Eν/((1 + ν)(1 − 2ν)).
void set_elasticity(Material& material, const Elasticity& elasticity);

}  // namespace ogc::compare
