// Makes quantities from the values of a case or an answer.
#pragma once

#include <array>
#include <iterator>
#include <string>
#include <vector>

#include "compare/judge/report/inputs.hpp"

namespace ogc::compare {

/// Returns one number.
inline Quantity scalar(std::string name, std::string unit, double x) {
  return {.name = std::move(name), .unit = std::move(unit), .numbers = {x}};
}
/// Returns a count.
inline Quantity count(std::string name, std::size_t n) { return scalar(std::move(name), "", static_cast<double>(n)); }
/// Returns one name.
inline Quantity word(std::string name, std::string text) {
  return {.name = std::move(name), .words = {std::move(text)}};
}
/// Returns a list of names.
inline Quantity words(std::string name, std::vector<std::string> texts) {
  return {.name = std::move(name), .words = std::move(texts), .is_list = true};
}

/// Returns "yes", "no", or the number if it is neither 0 nor 1.
inline Quantity flag(std::string name, unsigned value) {
  return word(std::move(name), value == 0 ? "no" : value == 1 ? "yes" : std::to_string(value));
}

/// Returns a list of numbers.
template <class Numbers>
Quantity numbers(std::string name, std::string unit, const Numbers& values) {
  return {.name = std::move(name), .unit = std::move(unit), .numbers = {values.begin(), values.end()}, .is_list = true};
}

/// Makes a quantity of points. A single point is not a list.
template <class Points>
Quantity points(std::string name, std::string unit, const Points& all) {
  Quantity quantity{.name = std::move(name), .unit = std::move(unit), .width = 3, .is_list = all.size() != 1};
  for (const auto& p : all)
    for (const double x : {double(p.x), double(p.y), double(p.z)}) quantity.numbers.push_back(x);
  return quantity;
}

/// Returns rows with equally many numbers: gradients, blocks, triangles.
template <class Row>
Quantity rows(std::string name, std::string unit, const std::vector<Row>& all) {
  Quantity quantity{.name = std::move(name), .unit = std::move(unit), .width = std::tuple_size_v<Row>, .is_list = true};
  for (const Row& row : all) quantity.numbers.insert(quantity.numbers.end(), row.begin(), row.end());
  return quantity;
}

/// Returns the list of the values that `pick` gives for the items.
template <class Item, class Pick>
Quantity each(std::string name, std::string unit, const std::vector<Item>& items, Pick pick) {
  std::vector<double> values;
  for (const Item& item : items) values.push_back(pick(item));
  return numbers(std::move(name), std::move(unit), values);
}

/// Returns a list whose entries are n indices of vertices each.
template <std::size_t n>
Quantity indices(std::string name, const std::vector<std::array<Index, n>>& all) {
  return rows(std::move(name), "", all);
}
/// Returns a list of indices of vertices.
inline Quantity indices(std::string name, const std::vector<Index>& all) { return numbers(std::move(name), "", all); }

/// Returns the quantity with labels for its entries.
inline Quantity labelled(Quantity quantity, std::vector<std::string> labels) {
  quantity.labels = std::move(labels);
  return quantity;
}

/// `mesh_quantities` returns the arrays of a mesh. `scene_quantities` returns settings that a stage reads, gravity, and
/// bodies with their materials.
std::vector<Quantity> mesh_quantities(const Topology& topology);
std::vector<Quantity> scene_quantities(const Scene& scene);
/// Returns a mesh with positions [m] and rigid groups by vertex, and excluded pairs if there are any.
std::vector<Quantity> state_quantities(const Topology& topology, const std::vector<Vec3f>& positions,
                                       const std::vector<Index>& rigid_groups, const CompressedRows& partners);

/// Returns all lists joined into one.
template <class... Lists>
std::vector<Quantity> joined(std::vector<Quantity> all, Lists... more) {
  (all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end())), ...);
  return all;
}

}  // namespace ogc::compare
