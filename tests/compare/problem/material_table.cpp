#include "compare/problem/material_table.hpp"

#include <set>

#include "compare/problem/names.hpp"
#include "compare/problem/rods.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

TEST_CASE("the table reaches every constant of a material", "[unit]") {
  std::set<const double*> fields;
  std::set<std::string_view> names;
  Material material;
  for (const MaterialInfo& info : material_table()) {
    fields.insert(&(material.*info.field));
    names.insert(info.name);
  }
  constexpr std::size_t models = sizeof(MembraneModel) + sizeof(BendingModel), padding = 2 * sizeof(double) - models;
  CHECK(fields.size() == names.size());
  CHECK(fields.size() * sizeof(double) == sizeof(Material) - models - padding - sizeof material.rod);
  std::set<const double*> of_rod;
  RodMaterial rod;
  for (const RodInfo& info : rod_table()) of_rod.insert(&(rod.*info.field));
  CHECK(of_rod.size() * sizeof(double) == sizeof rod);
}

TEST_CASE("default constants lie within ranges that single precision holds exactly", "[unit]") {
  const Material defaults;
  for (const MaterialInfo& info : material_table()) {
    INFO(info.name);
    CHECK(defaults.*info.field >= info.minimum);
    CHECK(defaults.*info.field <= info.maximum);
    CHECK(static_cast<double>(static_cast<float>(info.minimum)) == info.minimum);
    CHECK(static_cast<double>(static_cast<float>(info.maximum)) == info.maximum);
  }
  for (const RodInfo& info : rod_table()) {
    INFO(info.name);
    CHECK(in_range(info, RodMaterial{}.*info.field));
    CHECK(static_cast<double>(static_cast<float>(info.minimum)) == info.minimum);
    CHECK(static_cast<double>(static_cast<float>(info.maximum)) == info.maximum);
  }
}

TEST_CASE("models have names, in the order of their enumerations", "[unit]") {
  CHECK(name_of(MembraneModel::none) == "none");
  CHECK(name_of(MembraneModel::st_venant_kirchhoff) == "st_venant_kirchhoff");
  CHECK(name_of(BendingModel::none) == "none");
  CHECK(name_of(BendingModel::discrete_hinge) == "discrete_hinge");
}
