#define CATCH_CONFIG_RUNNER
#include "tests/catch.hpp"
#include "tests/mutants/kernel_tests.hpp"

namespace ogc::tests {

int failing_kernel_tests() {
  Catch::Session session;
  session.configData().outputFilename = "/dev/null";
  session.configData().abortAfter = 1;
  return session.run();
}

}  // namespace ogc::tests
