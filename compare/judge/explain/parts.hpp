// Quantities from the values of a case or an answer.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "compare/judge/explain/inputs.hpp"

namespace ogc::compare {

inline Quantity scalar(std::string name, std::string unit, double x) {
  return {.name = std::move(name), .unit = std::move(unit), .numbers = {x}};
}
inline Quantity count(std::string name, std::size_t n) { return scalar(std::move(name), "", static_cast<double>(n)); }
inline Quantity word(std::string name, std::string text) {
  return {.name = std::move(name), .words = {std::move(text)}};
}
inline Quantity words(std::string name, std::vector<std::string> texts) {
  return {.name = std::move(name), .words = std::move(texts), .is_list = true};
}

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

template <std::size_t n>
Quantity indices(std::string name, const std::vector<std::array<Index, n>>& all) {
  return rows(std::move(name), "", all);
}
inline Quantity indices(std::string name, const std::vector<Index>& all) { return numbers(std::move(name), "", all); }

}  // namespace ogc::compare
