// Runs the unit tests of rewritten code (tests/mutants.py names them), compiled with that code.
#pragma once

#include <string>
#include <vector>

namespace ogc::tests {

std::vector<std::string> unit_test_names();

/// Returns whether this test fails; it stops at its first failure. May be called once a process.
bool unit_test_fails(const std::string& name);

}  // namespace ogc::tests
