// Writer and reader of the members that compare/judge/force_members.hpp names.
#include "compare/judge/corpus_forces.hpp"

#include <algorithm>

#include "compare/judge/force_members.hpp"
#include "compare/problem/text.hpp"

namespace ogc::compare {

namespace {

struct Writer {
  Json json;
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

struct Reader {
  const Json& json;
  void operator()(const char* name, float& x) const { x = number(json.at(name)); }
  void operator()(const char* name, std::int32_t& x) const {
    x = json.at(name).get<std::int32_t>();
    if (x < 0 || x > 3)
      throw InputError(std::string(name) + ": " + std::to_string(x) + " is not a vertex of the stencil; use 0 to 3");
  }
  /// Bits of vertices; none in files that are older than they.
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

template <class Case>
Json written(const Case& c) {
  Writer writer;
  visit_members(c, [&](const char* name, const char*, const auto& member) { writer(name, member); });
  return writer.json;
}

template <class Case>
Case read(const Json& data) {
  Case c;
  const Reader reader{data};
  visit_members(c, [&](const char* name, const char*, auto& member) { reader(name, member); });
  return c;
}

void check_own(const ContactForceCase& c) {
  if (c.own >= vertex_count(c.sides))
    throw InputError("own: " + std::to_string(c.own) + " is not a vertex of these sides");
}
ContactForceCase checked(ContactForceCase c) {
  check_own(c);
  return c;
}
SpringCase checked(SpringCase c) {
  if (!(c.ratio >= 0 && c.ratio <= 1)) throw InputError("ratio: give a number from 0 to 1");
  if (c.own < 0 || c.own > (c.ratio > 0 ? 2 : 1))
    throw InputError("own: " + std::to_string(c.own) + " is not a vertex of the spring");
  return c;
}
FrictionForceCase checked(FrictionForceCase c) {
  check_own(c.contact);
  return c;
}

}  // namespace

Json force_case_to_json(const MembraneCase& c) { return written(c); }
Json force_case_to_json(const BendingCase& c) { return written(c); }
Json force_case_to_json(const SpringCase& c) { return written(c); }
Json force_case_to_json(const ContactForceCase& c) { return written(c); }
Json force_case_to_json(const FrictionForceCase& c) { return written(c); }

CaseData to_force_case(Stage stage, const Json& data) {
  switch (stage) {
    case Stage::contact_force: return checked(read<ContactForceCase>(data));
    case Stage::friction_force: return checked(read<FrictionForceCase>(data));
    case Stage::membrane: return read<MembraneCase>(data);
    case Stage::spring: return checked(read<SpringCase>(data));
    default: return read<BendingCase>(data);
  }
}

}  // namespace ogc::compare
