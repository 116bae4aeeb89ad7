// Bounds are powers of two, so that rounding a value to single precision can't take it out of its range.
#include "compare/problem/material_table.hpp"

#include <array>

namespace ogc::compare {
namespace {

constexpr double least = 0x1p-30, most = 0x1p40;

constexpr std::array<MaterialInfo, 12> table{{
    {"density", "kg/m²", "mass per rest area", least, most, &Material::density},
    {"lame_mu", "N/m", "membrane: second Lamé constant times thickness", 0, most, &Material::lame_mu},
    {"lame_lambda", "N/m", "membrane: first Lamé constant (plane stress) times thickness", 0, most,
     &Material::lame_lambda},
    {"bending_stiffness", "J", "bending: k_b of k_b/2 · 3‖e‖²/(A₀+A₁) · (θ−θ₀)²", 0, most,
     &Material::bending_stiffness},
    {"membrane_damping", "s", "stiffness-proportional damping k_d of the membrane", 0, most,
     &Material::membrane_damping},
    {"bending_damping", "s", "stiffness-proportional damping k_d of bending", 0, most, &Material::bending_damping},
    {"contact_stiffness", "N/m", "k_c; two surfaces meet with the harmonic mean", least, most,
     &Material::contact_stiffness},
    {"friction", "1", "μ_c; two surfaces meet with the arithmetic mean", 0, 0x1p10, &Material::friction},
    {"solid_density", "kg/m³", "tetrahedra: mass per rest volume", least, most, &Material::solid_density},
    {"solid_mu", "Pa", "tetrahedra: second Lamé constant", least, most, &Material::solid_mu},
    {"solid_lambda", "Pa", "tetrahedra: first Lamé constant", 0, most, &Material::solid_lambda},
    {"solid_damping", "s", "stiffness-proportional damping k_d of tetrahedra", 0, most, &Material::solid_damping},
}};

}  // namespace

std::span<const MaterialInfo> material_table() { return table; }

Elasticity elasticity_of(const Material& material) {
  const double mu = material.solid_mu, lambda = material.solid_lambda;
  return {mu * (3 * lambda + 2 * mu) / (lambda + mu), lambda / (2 * (lambda + mu))};
}

void set_elasticity(Material& material, const Elasticity& elasticity) {
  const auto [young, poisson] = elasticity;
  material.solid_mu = young / (2 * (1 + poisson));
  material.solid_lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson));
}

}  // namespace ogc::compare
