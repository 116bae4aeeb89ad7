#include "compare/problem/text.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "compare/problem/settings.hpp"
#include "tests/catch.hpp"

using namespace ogc::compare;

TEST_CASE("the near name is the one with the fewest typing errors, the first of several", "[unit]") {
  constexpr std::array<std::string_view, 3> known{"density", "friction", "fiction"};
  CHECK(near_name("densty", known) == "density");
  CHECK(near_name("ddensity", known) == "density");
  CHECK(near_name("densitz", known) == "density");
  CHECK(near_name("Denisty", known) == "density");
  CHECK(near_name("ffiction", known) == "friction");
  CHECK(near_name("f", known) == "friction");
  CHECK(near_name("fi", known) == "fiction");
  CHECK(near_name("anything", {}).empty());
}

TEST_CASE("what resembles no name is near none; an abbreviation is near what it is short for", "[unit]") {
  constexpr std::array<std::string_view, 3> models{"none", "st_venant_kirchhoff", "stable_neo_hookean"};
  CHECK(near_name("stvk", models) == "st_venant_kirchhoff");
  CHECK(near_name("non", models) == "none");
  for (const char* other : {"", "h", "linear", "kvts", "tvk", "st_neo_kirchhoff_venant"})
    CHECK(near_name(other, models).empty());
}

// near_name allows one typing error per three letters, so the shortest tested names, of five letters, may have one.
TEST_CASE("a name with one typing error in it is found again among all settings", "[property]") {
  std::vector<std::string_view> names;
  for (const SettingInfo& info : setting_table()) names.push_back(info.name);
  std::mt19937 random(1);
  for (const std::string_view name : names) {
    if (name.size() < 5) continue;
    for (int error = 0; error < 4; ++error) {
      std::string typed(name);
      const std::size_t at = 1 + random() % (typed.size() - 2);
      if (error == 0) typed.erase(at, 1);
      if (error == 1) typed.insert(at, "q");
      if (error == 2) typed[at] = 'q';
      if (error == 3) std::swap(typed[at], typed[at - 1]);
      INFO(typed);
      CHECK(near_name(typed, names) == name);
    }
  }
}

TEST_CASE("a complaint about a name proposes a near one and lists those that there are", "[unit]") {
  constexpr std::array<std::string_view, 2> known{"twist", "knot"};
  CHECK(unknown_name("scene", "twits", known) == "unknown scene 'twits'; did you mean 'twist'? There are: twist, knot");
  CHECK(unknown_name("scene", "dress", known) == "unknown scene 'dress'; there are: twist, knot");
  CHECK(unknown_name("scene", std::string(1000, 'x'), known).size() < 100);
  const std::vector<std::string_view> many(1000, "name");
  CHECK(unknown_name("body", "other", many).ends_with(" and 936 more"));
  CHECK(unknown_name("scene", "twits", {}) == "unknown scene 'twits'");
}

TEST_CASE("printed numbers read back as the same double", "[unit]") {
  using Limits = std::numeric_limits<double>;
  for (const double value : {0.1, 1.0 / 3, -2.5e-7, 1e300, 4.0, Limits::min(), Limits::max(), Limits::denorm_min()}) {
    CHECK(std::strtod(shortest(value).c_str(), nullptr) == value);
  }
  CHECK(shortest(0.1) == "0.1");
}

TEST_CASE("what is printed for a single-precision value is short and rounds to it", "[unit]") {
  CHECK(as_typed(static_cast<double>(0.01f)) == 0.01);
  CHECK(as_typed(static_cast<double>(-9.81f)) == -9.81);
  CHECK(as_typed(0.01) == 0.01);
  CHECK(as_typed(1.0 / 3) == 1.0 / 3);
  CHECK(as_typed(1e300) == 1e300);
  CHECK(std::signbit(as_typed(-0.0)));
  std::mt19937 random(5);
  for (int i = 0; i < 10000; ++i) {
    const auto single = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
    if (std::isfinite(single)) CHECK(static_cast<float>(as_typed(static_cast<double>(single))) == single);
  }
}
