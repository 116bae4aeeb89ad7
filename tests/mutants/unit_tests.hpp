// The unit tests of what is rewritten (tests/mutants.py says which), compiled over it.
#pragma once

#include <string>
#include <vector>

namespace ogc::tests {

std::vector<std::string> unit_test_names();

/// Whether this one fails; it stops where it does. Once a process.
bool unit_test_fails(const std::string& name);

}  // namespace ogc::tests
