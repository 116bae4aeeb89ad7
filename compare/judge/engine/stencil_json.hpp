// Writes and reads the members listed in compare/judge/engine/force_members.hpp.
#pragma once

#include <algorithm>

#include "compare/judge/engine/force_members.hpp"
#include "compare/judge/engine/numbers_json.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {

/// Adds members to an object.
struct StencilWriter {
  Json json;  ///< object so far
  void operator()(const char* name, float x) { json[name] = hexadecimal(x); }
  void operator()(const char* name, std::int32_t x) { json[name] = x; }
  void operator()(const char* name, std::uint8_t bits) { json[name] = bits; }
  void operator()(const char* name, Named auto x) { json[name] = names_of(x)[static_cast<std::size_t>(x)]; }
  template <std::size_t n>
  void operator()(const char* name, const std::array<Vec3f, n>& points) {
    json[name] = points_to_json(points);
  }
  template <std::size_t n>
  void operator()(const char* name, const std::array<float, n>& numbers) {
    json[name] = numbers_to_json({numbers.begin(), numbers.end()});
  }
};

/// Reads members from an object. Throws InputError for a value that no case can have.
struct StencilReader {
  const Json& json;  ///< object to read
  void operator()(const char* name, float& x) const { x = number(json.at(name)); }
  void operator()(const char* name, std::int32_t& x) const {
    x = json.at(name).get<std::int32_t>();
    if (x < 0 || x > 3)
      throw InputError(std::string(name) + ": " + std::to_string(x) + " is not a vertex of the stencil; use 0 to 3");
  }
  /// Reads a bit mask of vertices; 0 if the file has none.
  void operator()(const char* name, std::uint8_t& bits) const {
    const auto given = json.value(name, std::int32_t{0});
    if (given < 0 || given > 15)
      throw InputError(std::string(name) + ": " + std::to_string(given) +
                       " are not bits of four vertices; use 0 to 15");
    bits = static_cast<std::uint8_t>(given);
  }
  template <Named Enum>
  void operator()(const char* name, Enum& x) const {
    const std::string text = json.at(name).get<std::string>();
    const auto names = names_of(x);
    const auto at = std::find(names.begin(), names.end(), text);
    if (at == names.end()) throw InputError(unknown_name(name, text, names));
    x = static_cast<Enum>(at - names.begin());
  }
  template <std::size_t n>
  void operator()(const char* name, std::array<Vec3f, n>& points) const {
    points = to_points<n>(json.at(name));
  }
  template <std::size_t n>
  void operator()(const char* name, std::array<float, n>& numbers) const {
    for (std::size_t i = 0; i < n; ++i) numbers[i] = number(json.at(name).at(i));
  }
};

/// Writes a stencil as a JSON object.
template <class Case>
Json write_stencil(const Case& c) {
  StencilWriter writer;
  visit_members(c, [&](const char* name, const char*, const auto& member) { writer(name, member); });
  return writer.json;
}

/// Reads a stencil from a JSON object.
template <class Case>
Case read_stencil(const Json& data) {
  Case c;
  const StencilReader reader{data};
  visit_members(c, [&](const char* name, const char*, auto& member) { reader(name, member); });
  return c;
}

}  // namespace ogc::compare
