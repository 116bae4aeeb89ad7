// Tests the refusals of `ogc run --devices`. tests/fast/cpu/parts.cpp and tests/fast/cuda/parts.cu test the division.
#include "tests/catch.hpp"
#include "tests/experiments/program.hpp"

using namespace ogc;
using namespace ogc::tests;

TEST_CASE("what several devices cannot divide is refused by name") {
  const auto refused = [](const std::string& options, const std::string& word) {
    CAPTURE(options);
    const ProgramResult result = run_ogc("run twist --scale smoke --devices " + options);
    CHECK(result.status == 2);
    CHECK_THAT(result.err, ContainsSubstring("--devices"));
    CHECK_THAT(result.err, ContainsSubstring(word));
  };
  refused("0", "1 to 64");
  refused("65", "1 to 64");
  refused("2", "--backend cuda");
  refused("2 --backend cuda --profile", "--profile");
  refused("2 --backend cuda --worlds 3", "worlds");
}
