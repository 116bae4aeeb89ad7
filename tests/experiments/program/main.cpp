#include "tests/experiments/program.hpp"

#include "compare/problem/settings.hpp"
#include "tests/catch.hpp"

using namespace ogc;
using namespace ogc::tests;

TEST_CASE("ogc without or with an unknown subcommand exits 2 and says where help is", "[unit]") {
  for (const char* arguments :
       {"", "simulate", "run", "scenes --colour red", "run twist --backend abacus", "contacts"}) {
    const ProgramResult result = run_ogc(arguments);
    INFO(arguments << "\n" << result.err);
    CHECK(result.status == 2);
    CHECK(result.out.empty());
    CHECK(contains(result.err, {"ogc: ", "--help"}));
  }
}

TEST_CASE("every subcommand teaches: --help goes to standard output, shows an example and offers --json", "[unit]") {
  for (const std::string command :
       {"scenes", "run", "ablate", "contacts", "audit", "suggest", "compare", "export", "bench"}) {
    const ProgramResult result = run_ogc(command + " --help");
    INFO(command << "\n" << result.out << result.err);
    CHECK(result.status == 0);
    CHECK(contains(result.out, {"xample", "ogc " + command, "--json"}));
    CHECK(result.err.empty());
  }
}

TEST_CASE("the help of run lists every setting with its unit", "[unit]") {
  const ProgramResult result = run_ogc("run --help");
  CHECK(contains(result.out, {"unit", "range", "default"}));
  for (const compare::SettingInfo& setting : compare::setting_table())
    CHECK(contains(result.out, {"\n  " + std::string(setting.name) + " "}));
}

TEST_CASE("ogc --version names version, commit, compiler, CUDA and both backends", "[unit]") {
  const ProgramResult result = run_ogc("--version");
  CHECK(result.status == 0);
  CHECK(contains(result.out, {"OGC Testbed ", "commit ", "compiler ", "CUDA ", "cpu: usable", "cuda: "}));
}

TEST_CASE("a full disk behind standard output exits 3", "[unit]") {
  const ProgramResult result = run_ogc("scenes --schema > /dev/full");
  CHECK(result.status == 3);
  CHECK(contains(result.err, {"ogc: standard output"}));
}
