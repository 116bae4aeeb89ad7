// Writes numbers and points of saved cases as hexadecimal text, which keeps every bit, and choices by name.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "compare/problem/error.hpp"
#include "compare/problem/vector.hpp"

namespace ogc::compare {

using Json = nlohmann::ordered_json;

/// Returns the number as hexadecimal text, for example "0x1.8p-3".
inline std::string hexadecimal_of(double x) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%a", x);
  return buffer;
}
inline std::string hexadecimal(float x) { return hexadecimal_of(static_cast<double>(x)); }

/// Parses the text by `parse`, a function of C's library. Throws InputError if `parse` does not use the whole text.
template <class Number>
Number parsed_number(const Json& json, Number (*parse)(const char*, char**)) {
  const std::string text = json.get<std::string>();
  char* end = nullptr;
  const Number x = parse(text.c_str(), &end);
  if (text.empty() || *end != '\0')
    throw InputError("'" + text + "' is not a number; write it as in 0x1.8p-3 or 0.1875");
  return x;
}

/// Return the number of a hexadecimal or decimal text; throw InputError for other text.
inline float number(const Json& json) { return parsed_number(json, &std::strtof); }
inline double number_of_double(const Json& json) { return parsed_number(json, &std::strtod); }

/// Convert a point to [x, y, z] and back.
inline Json to_json(const Vec3f& p) { return {hexadecimal(p.x), hexadecimal(p.y), hexadecimal(p.z)}; }
inline Vec3f to_point(const Json& json) { return {number(json.at(0)), number(json.at(1)), number(json.at(2))}; }

/// Writes an array of points.
template <class Points>
Json points_to_json(const Points& points) {
  Json json = Json::array();
  for (const Vec3f& p : points) json.push_back(to_json(p));
  return json;
}

/// Reads the first n points of an array.
template <std::size_t n>
std::array<Vec3f, n> to_points(const Json& json) {
  std::array<Vec3f, n> points;
  for (std::size_t i = 0; i < n; ++i) points[i] = to_point(json.at(i));
  return points;
}

/// Writes an array of numbers.
inline Json numbers_to_json(const std::vector<float>& numbers) {
  Json json = Json::array();
  for (const float x : numbers) json.push_back(hexadecimal(x));
  return json;
}

/// Reads an array of numbers.
inline std::vector<float> to_numbers(const Json& json) {
  std::vector<float> numbers;
  for (const Json& x : json) numbers.push_back(number(x));
  return numbers;
}

/// Returns the index of a name in a list of names. Throws InputError if the list lacks it.
template <class Names>
int number_of(const Json& name, const Names& names) {
  const auto found = std::find(names.begin(), names.end(), name.get<std::string>());
  if (found == names.end())
    throw InputError("'" + name.get<std::string>() + "' is none of the names that may stand there");
  return static_cast<int>(found - names.begin());
}

}  // namespace ogc::compare
