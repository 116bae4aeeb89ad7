#include "experiments/program/runs/set_material.hpp"

#include <algorithm>
#include <iterator>

#include "compare/files/numbers.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/material_table.hpp"
#include "compare/problem/ranges.hpp"
#include "compare/problem/text.hpp"

namespace ogc::experiments {

namespace {

using compare::Material;
using compare::MaterialInfo;

/// E and ν are missing in material_table, because the Lamé constants contain the same information.
constexpr MaterialInfo young{
    "solid_young", "Pa", "bodies with tetrahedra: Young's modulus", compare::least_young, compare::most_young, nullptr},
    poisson{"solid_poisson", "1", "bodies with tetrahedra: Poisson's ratio", 0, compare::most_poisson, nullptr};

bool is_of_solids(std::string_view name) { return name.starts_with("solid_"); }

/// Returns whether --set accepts the constant. Constants of cloth differ between bodies, so that only the scene sets
/// them.
bool is_offered(const MaterialInfo& info) {
  return is_of_solids(info.name) || info.name == "contact_stiffness" || info.name == "friction";
}

std::vector<MaterialInfo> offered() {
  std::vector<MaterialInfo> all;
  std::ranges::copy_if(compare::material_table(), std::back_inserter(all), is_offered);
  all.insert(all.end(), {young, poisson});
  return all;
}

void set(Material& material, const MaterialInfo& info, double value) {
  if (info.field != nullptr) {
    material.*info.field = value;
    return;
  }
  compare::Elasticity elasticity = compare::elasticity_of(material);
  (info.name == young.name ? elasticity.young : elasticity.poisson) = value;
  compare::set_elasticity(material, elasticity);
}

}  // namespace

std::vector<MaterialSetting> material_settings() {
  std::vector<MaterialSetting> all;
  for (const MaterialInfo& info : offered())
    all.push_back({info.name, info.unit, compare::range_text(info),
                   (is_of_solids(info.name) ? "" : "every body: ") + std::string(info.meaning)});
  return all;
}

bool set_material(compare::Scene& scene, const std::string& key, const std::string& value) {
  const std::vector<MaterialInfo> all = offered();
  const auto info = std::ranges::find(all, std::string_view(key), &MaterialInfo::name);
  if (info == all.end()) return false;
  double number = 0;
  if (!compare::parse_number(value, number) || !compare::in_range(*info, number))
    throw compare::InputError(key + ": '" + compare::shown(value) + "' is not " + describe_range(*info));
  const bool solids_alone = is_of_solids(info->name);
  if (solids_alone && scene.mesh.tetrahedra.empty())
    throw compare::InputError("--set " + key + " belongs to bodies with tetrahedra, and scene '" + scene.name +
                              "' has none; leave it out, or give a mesh with tetrahedra (.msh)");
  for (compare::Body& body : scene.bodies)
    if (!solids_alone || body.is_solid()) set(body.material, *info, number);
  return true;
}

void set_solid_constants(compare::Scene& scene, const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments) {
    const std::size_t equals = assignment.find('=');
    if (equals != std::string::npos && is_of_solids(assignment))
      set_material(scene, assignment.substr(0, equals), assignment.substr(equals + 1));
  }
}

}  // namespace ogc::experiments
