// Every constant of a material with unit and range in one table: validation, rounding, scene files and their schema
// read it.
#pragma once

#include <span>
#include <string_view>

#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// One row of the table of material constants.
struct MaterialInfo {
  std::string_view name, unit, meaning;  ///< "contact_stiffness", "N/m", one line
  double minimum, maximum;               ///< inclusive; single precision holds both exactly
  double Material::*field;               ///< where it is kept
};

/// All constants, in the order of the struct. Ranges keep squares and products of two of them finite and normal in
/// single precision.
std::span<const MaterialInfo> material_table();

/// What stands for the Lamé constants of a solid, in files and settings.
struct Elasticity {
  double young = 0;    ///< Young's modulus E [Pa]
  double poisson = 0;  ///< Poisson's ratio ν [1]
};

/// Ranges of E and ν, so that the Lamé constants are in theirs.
inline constexpr double least_young = 0x1p-28, most_young = 0x1p30, most_poisson = 0.4999;

/// E and ν of a solid.
Elasticity elasticity_of(const Material& material);
/// μ = E/(2(1 + ν)), λ = Eν/((1 + ν)(1 − 2ν)).
void set_elasticity(Material& material, const Elasticity& elasticity);

}  // namespace ogc::compare
