// Quantities from the values of a case or an answer.
#pragma once

#include <array>
#include <iterator>
#include <string>
#include <vector>

#include "compare/judge/report/inputs.hpp"

namespace ogc::compare {

/// One number.
inline Quantity scalar(std::string name, std::string unit, double x) {
  return {.name = std::move(name), .unit = std::move(unit), .numbers = {x}};
}
/// A number of things.
inline Quantity count(std::string name, std::size_t n) { return scalar(std::move(name), "", static_cast<double>(n)); }
/// One name.
inline Quantity word(std::string name, std::string text) {
  return {.name = std::move(name), .words = {std::move(text)}};
}
/// A list of names.
inline Quantity words(std::string name, std::vector<std::string> texts) {
  return {.name = std::move(name), .words = std::move(texts), .is_list = true};
}

/// "yes", "no", or what it is instead.
inline Quantity flag(std::string name, unsigned value) {
  return word(std::move(name), value == 0 ? "no" : value == 1 ? "yes" : std::to_string(value));
}

/// A list of numbers.
template <class Numbers>
Quantity numbers(std::string name, std::string unit, const Numbers& values) {
  return {.name = std::move(name), .unit = std::move(unit), .numbers = {values.begin(), values.end()}, .is_list = true};
}

/// One point is no list.
template <class Points>
Quantity points(std::string name, std::string unit, const Points& all) {
  Quantity quantity{.name = std::move(name), .unit = std::move(unit), .width = 3, .is_list = all.size() != 1};
  for (const auto& p : all)
    for (const double x : {double(p.x), double(p.y), double(p.z)}) quantity.numbers.push_back(x);
  return quantity;
}

/// Rows of so many numbers each: gradients, blocks, triangles.
template <class Row>
Quantity rows(std::string name, std::string unit, const std::vector<Row>& all) {
  Quantity quantity{.name = std::move(name), .unit = std::move(unit), .width = std::tuple_size_v<Row>, .is_list = true};
  for (const Row& row : all) quantity.numbers.insert(quantity.numbers.end(), row.begin(), row.end());
  return quantity;
}

/// A list of what `pick` takes of each item.
template <class Item, class Pick>
Quantity each(std::string name, std::string unit, const std::vector<Item>& items, Pick pick) {
  std::vector<double> values;
  for (const Item& item : items) values.push_back(pick(item));
  return numbers(std::move(name), std::move(unit), values);
}

/// Numbers of vertices, one or more an entry.
template <std::size_t n>
Quantity indices(std::string name, const std::vector<std::array<Index, n>>& all) {
  return rows(std::move(name), "", all);
}
/// The same, one an entry.
inline Quantity indices(std::string name, const std::vector<Index>& all) { return numbers(std::move(name), "", all); }

/// Its entries by name.
inline Quantity labelled(Quantity quantity, std::vector<std::string> labels) {
  quantity.labels = std::move(labels);
  return quantity;
}

/// What a mesh is made of, and a scene: settings that a stage reads, gravity, bodies with their materials.
std::vector<Quantity> mesh_quantities(const Topology& topology);
std::vector<Quantity> scene_quantities(const Scene& scene);
/// A mesh with positions [m] and rigid groups by vertex, and pairs that are left out, where there are any.
std::vector<Quantity> state_quantities(const Topology& topology, const std::vector<Vec3f>& positions,
                                       const std::vector<Index>& rigid_groups, const CompressedRows& partners);

/// One list after another.
template <class... Lists>
std::vector<Quantity> joined(std::vector<Quantity> all, Lists... more) {
  (all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end())), ...);
  return all;
}

}  // namespace ogc::compare
