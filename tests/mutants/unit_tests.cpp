#define CATCH_CONFIG_RUNNER
#include "tests/catch.hpp"
#include "tests/mutants/unit_tests.hpp"

namespace ogc::tests {

int failing_unit_tests() {
  Catch::Session session;
  session.configData().outputFilename = "/dev/null";
  session.configData().abortAfter = 1;
  return session.run();
}

}  // namespace ogc::tests
