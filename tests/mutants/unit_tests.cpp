#define CATCH_CONFIG_RUNNER
#include <iterator>

#include "tests/catch.hpp"
#include "tests/mutants/unit_tests.hpp"

namespace ogc::tests {

std::vector<std::string> unit_test_names() {
  const Catch::Config config{Catch::ConfigData{}};
  std::vector<std::string> names;
  for (const auto& test : Catch::getAllTestCasesSorted(config)) names.push_back(test.getTestCaseInfo().name);
  return names;
}

bool unit_test_fails(const std::string& name) {
  std::string escaped;
  for (const char c : name) {
    if (std::string("\\,[]\"").find(c) != std::string::npos) escaped += '\\';
    escaped += c;
  }
  // A name that no test has can only come from a fault above and counts as a failure; Catch2 3 does so without the
  // option.
  const char* words[] = {"tests", escaped.c_str(), "--abort", "--out", "/dev/null", "--warn", "NoTests"};
  const auto count = static_cast<int>(std::size(words)) - (CATCH_VERSION_MAJOR > 2 ? 2 : 0);
  Catch::Session session;
  return session.applyCommandLine(count, words) != 0 || session.run() != 0;
}

}  // namespace ogc::tests
