// Tests that settings declared by contestants become part of the problem's table, for all code that reads it. All other
// tests of this program also see the rows that this file declares.
#include <algorithm>
#include <array>
#include <vector>

#include "compare/problem/error.hpp"
#include "compare/problem/settings.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

namespace {

constexpr std::array<std::string_view, 3> ways{"first", "second", "third"};
constexpr std::array<SettingInfo, 3> rows{{
    {"tests_share", "m", "a length that one contestant reads", 0, 2, DeclaredSetting{SettingKind::real, 0.5}},
    {"tests_count", "1", "a number that one contestant reads", 1, 9, DeclaredSetting{SettingKind::whole, 3}},
    {"tests_way", "1", "a choice that one contestant reads", 0, 2, DeclaredSetting{SettingKind::choice, 2}, ways},
}};
constexpr std::array<SettingInfo, 1> other_rows{{
    {"another_share", "1", "a share that another contestant reads", 0, 1, DeclaredSetting{SettingKind::real, 0.25}},
}};
const SettingsDeclaration declaration("tests", rows), other("another", other_rows);

std::size_t index_of(std::string_view name) {
  const auto table = setting_table();
  return static_cast<std::size_t>(std::ranges::find(table, name, &SettingInfo::name) - table.begin());
}

}  // namespace

TEST_CASE("declared settings follow the problem's, by the names of their contestants", "[unit]") {
  // Contestants are sorted by name. So settings of other linked contestants may lie between those of "another" and
  // "tests".
  const std::size_t own = index_of("tests_share");
  CHECK(index_of("another_share") == index_of("rod_start") + 1);
  CHECK(index_of("another_share") < own);
  CHECK(setting_table().size() == own + 3);
  CHECK(index_of("tests_count") == own + 1);
  CHECK(index_of("tests_way") == own + 2);
}

TEST_CASE("a declared setting has its default until it is set, and is a value like any other then", "[unit]") {
  Settings settings;
  CHECK(get_setting(settings, "tests_share") == 0.5);
  CHECK(get_setting(settings, "tests_count") == 3);
  CHECK(get_setting(settings, "tests_way") == 2);
  set_setting(settings, "tests_share", "0.75");
  set_setting(settings, "tests_count", 9.0);
  set_setting(settings, "tests_way", "first");
  CHECK(get_setting(settings, "tests_share") == 0.75);
  CHECK(get_setting(settings, "tests_count") == 9);
  CHECK(get_setting(settings, "tests_way") == 0);
  CHECK(settings != Settings{});
}

TEST_CASE("a declared setting that is set to its default leaves the settings as they were", "[unit]") {
  Settings settings;
  set_setting(settings, "tests_share", "0.75");
  set_setting(settings, "tests_share", "0.5");
  set_setting(settings, "tests_way", "third");
  CHECK(settings == Settings{});
}

TEST_CASE("messages about declared settings name the range, and the nearest name for an unknown one", "[unit]") {
  Settings settings;
  CHECK_THROWS_WITH(set_setting(settings, "tests_count", "10"),
                    ContainsSubstring("'tests_count' can't be '10'; give a whole number from 1 to 9"));
  CHECK_THROWS_WITH(set_setting(settings, "tests_way", "fourth"), ContainsSubstring("one of first, second, third"));
  CHECK_THROWS_WITH(set_setting(settings, "tests_shares", 1.0), ContainsSubstring("did you mean 'tests_share'?"));
  CHECK(settings == Settings{});
}
