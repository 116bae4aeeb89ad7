#include "experiments/program/output.hpp"

#include "tests/catch.hpp"

using namespace ogc;

// The 64-bit FNV-1a hash of no bytes is the offset basis. The hash of twelve zero bytes is the basis times prime¹²
// modulo 2⁶⁴.
TEST_CASE("the state's hash is FNV-1a of the positions' bits", "[unit]") {
  CHECK(experiments::state_hash({}) == "cbf29ce484222325");
  std::uint64_t expected = 0xcbf29ce484222325;
  for (int i = 0; i < 12; ++i) expected *= 0x100000001b3;
  const std::vector<compare::Vec3f> zero{{0, 0, 0}};
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(expected));
  CHECK(experiments::state_hash(zero) == text);
}

TEST_CASE("the state's hash sees every bit and the order", "[property]") {
  const std::vector<compare::Vec3f> a{{1, 2, 3}, {4, 5, 6}}, b{{4, 5, 6}, {1, 2, 3}}, c{{1, 2, 3}, {4, 5, 6.0000005f}},
      d{{-0.f, 0, 0}}, e{{0, 0, 0}};
  CHECK(experiments::state_hash(a) != experiments::state_hash(b));
  CHECK(experiments::state_hash(a) != experiments::state_hash(c));
  CHECK(experiments::state_hash(d) != experiments::state_hash(e));
}

TEST_CASE("a table aligns its columns and ends no line with a blank", "[unit]") {
  CHECK(experiments::table({{"a", "b", "c"}, {"long", "22", "3"}}, 1) == "a      b  c\nlong  22  3\n");
  CHECK(experiments::table({{"…", "1"}, {"bb", "2"}}, 1) == "…   1\nbb  2\n");
  CHECK(experiments::table({{"a", ""}, {"bb", "c"}}, 2) == "a\nbb  c\n");
}

TEST_CASE("counts are written in the singular and in the plural", "[unit]") {
  CHECK(experiments::counted(1, "contact") == "1 contact");
  CHECK(experiments::counted(0, "contact") == "0 contacts");
}
