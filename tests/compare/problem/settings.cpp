// Tests the table of settings. Only the table defines ranges, so these checks hold for all code that reads it.
#include "compare/problem/settings.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <vector>

#include "compare/problem/error.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/ranges.hpp"
#include "tests/catch.hpp"
#include "tests/compare/problem/renamed.hpp"

using namespace ogc::compare;
using Catch::Matchers::Equals;

TEST_CASE("every setting has a name of its own and a default within its range", "[unit]") {
  const Settings defaults;
  std::set<std::string_view> names;
  for (const SettingInfo& info : setting_table()) {
    INFO(info.name);
    CHECK(names.insert(info.name).second);
    CHECK(in_range(info, get_setting(defaults, info)));
    CHECK(info.minimum < info.maximum);
    CHECK(std::ranges::count(info.meaning, ' ') >= 3);  // requires words, not only a symbol
    CHECK(!info.unit.empty());
  }
}

TEST_CASE("traits of each policy of bounds fit together, and its name sets it", "[unit]") {
  for (const Bounds bounds : choices<Bounds>) {
    const BoundsTraits policy = traits_of(bounds);
    INFO(name_of(bounds));
    CHECK((policy.has_planes || (policy.slides && !policy.divides)));
    CHECK((policy.certifies || !policy.has_planes));
    Settings settings;
    set_setting(settings, "bounds", name_of(bounds));
    CHECK(settings.bounds == bounds);
  }
  CHECK(traits_of(Bounds{}).certifies);
}

TEST_CASE("the table reaches every byte of the settings but those that contestants declare", "[unit]") {
  std::set<const char*> fields;
  Settings settings;
  for (const SettingInfo& info : setting_table()) {
    std::visit(
        [&]<class Field>(Field field) {
          if constexpr (!std::is_same_v<Field, DeclaredSetting>)
            fields.insert(reinterpret_cast<const char*>(&(settings.*field)));
        },
        info.field);
  }
  CHECK(fields.size() * 8 + sizeof settings.declared == sizeof(Settings));
}

TEST_CASE("bounds survive rounding to single precision, so rounding a setting can't leave its range", "[unit]") {
  for (const SettingInfo& info : setting_table()) {
    if (kind_of(info) != SettingKind::real) continue;
    INFO(info.name);
    CHECK(static_cast<double>(static_cast<float>(info.minimum)) == info.minimum);
    CHECK(static_cast<double>(static_cast<float>(info.maximum)) == info.maximum);
  }
}

TEST_CASE("a setting is read back as it was set, at both ends of its range", "[unit]") {
  for (const SettingInfo& info : setting_table()) {
    if (!info.choices.empty()) continue;
    INFO(info.name);
    const bool whole = kind_of(info) == SettingKind::whole;
    for (const double value : {info.minimum, info.maximum}) {
      char text[64];
      std::snprintf(text, sizeof text, whole ? "%.0f" : "%.17g", value);
      Settings settings;
      set_setting(settings, info.name, text);
      CHECK(get_setting(settings, info.name) == value);
    }
  }
}

TEST_CASE("values out of range, of the wrong type or not numbers are refused and leave the setting alone", "[unit]") {
  for (const SettingInfo& info : setting_table()) {
    if (!info.choices.empty()) continue;
    INFO(info.name);
    const bool whole = kind_of(info) == SettingKind::whole;
    for (const double value : {info.minimum - 1, info.maximum * 2}) {
      char text[64];
      std::snprintf(text, sizeof text, whole ? "%.0f" : "%.17g", value);
      Settings settings;
      CHECK_THROWS_AS(set_setting(settings, info.name, text), InputError);
      CHECK(settings == Settings{});
    }
    for (const char* text : {"", "nan", "inf", "-inf", "1e400", "1e-46", "five", "1 2", "1;", "0x10"}) {
      Settings settings;
      CHECK_THROWS_AS(set_setting(settings, info.name, text), InputError);
      CHECK(settings == Settings{});
    }
    Settings settings;
    if (whole) CHECK_THROWS_AS(set_setting(settings, info.name, "1.5"), InputError);
  }
}

TEST_CASE("messages name the setting, its unit, its range and the nearest name", "[unit]") {
  Settings settings;
  CHECK_THROWS_WITH(set_setting(settings, "contact_radius", "-1"),
                    ContainsSubstring("contact_radius") && ContainsSubstring(" m ") && ContainsSubstring("1048576") &&
                        ContainsSubstring("-1"));
  CHECK_THROWS_WITH(set_setting(settings, "contactradius", "1"),
                    ContainsSubstring("'contactradius'") && ContainsSubstring("'contact_radius'"));
  CHECK_THROWS_WITH(set_setting(settings, "iteration", "1"), ContainsSubstring("did you mean 'iterations'?"));
  CHECK_THROWS_WITH(get_setting(settings, "gamma"), ContainsSubstring("unknown setting 'gamma'"));
}

TEST_CASE("a name that a setting had before is refused with the one that it has now", "[unit]") {
  for (const ogc::tests::Renamed& setting : ogc::tests::renamed_settings) {
    Settings settings;
    CHECK_THROWS_WITH(set_setting(settings, setting.before, "1"), Equals(setting.refusal()));
    // body_contact is a property of bodies, not a setting.
    if (setting.now != "body_contact") CHECK_NOTHROW(get_setting(settings, setting.now));
  }
}

TEST_CASE("what help says of a range is what is taken: its ends are, and what lies just outside is not", "[property]") {
  for (const SettingInfo& info : setting_table()) {
    if (!info.choices.empty() || info.name == "lanes") continue;
    std::istringstream range(range_text(info));
    std::vector<double> ends;
    for (std::string word; range >> word;)
      if (word != "to" && word != "or") ends.push_back(std::stod(word));
    INFO(info.name << ": " << range_text(info));
    REQUIRE(ends.size() >= 2);
    const bool whole = kind_of(info) == SettingKind::whole;
    const double below = whole ? ends.front() - 1 : std::nextafter(ends.front(), -1.0),
                 above = std::max(ends.back() + (whole ? 1 : 0), std::nextafter(ends.back(), 1e300));
    for (const double end : ends) CHECK(in_range(info, end));
    for (const double outside : {below, above}) CHECK(!in_range(info, outside));
    if (ends.size() == 3) CHECK(!in_range(info, ends[1] / 2));
  }
}

TEST_CASE("lanes is 0, 2, 4, 8 or 16", "[unit]") {
  for (int lanes = 0; lanes <= 33; ++lanes) {
    Settings settings;
    const bool good = lanes == 0 || lanes == 2 || lanes == 4 || lanes == 8 || lanes == 16;
    INFO(lanes);
    if (good) {
      CHECK_NOTHROW(set_setting(settings, "lanes", std::to_string(lanes)));
    } else {
      CHECK_THROWS_WITH(set_setting(settings, "lanes", std::to_string(lanes)), ContainsSubstring("0, 2, 4, 8 or 16"));
    }
  }
}

TEST_CASE("a choice is set and printed by its name; any other name is refused with the list", "[unit]") {
  for (const SettingInfo& info : setting_table()) {
    INFO(info.name);
    CHECK(info.choices.empty() == (kind_of(info) != SettingKind::choice));
    for (const std::string_view name : info.choices) {
      Settings settings;
      set_setting(settings, info.name, name);
      CHECK(setting_text(settings, info) == name);
      CHECK(info.choices[static_cast<std::size_t>(get_setting(settings, info))] == name);
    }
    if (info.choices.empty()) continue;
    CHECK(info.maximum == static_cast<double>(info.choices.size() - 1));
    Settings settings;
    for (const char* name : {"", "0", "ogcc"})
      CHECK_THROWS_WITH(set_setting(settings, info.name, name), ContainsSubstring(std::string(info.choices.back())));
    CHECK(settings == Settings{});
  }
}
