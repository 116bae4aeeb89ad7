// The unit tests of what is rewritten (tests/mutants.py says which), compiled over it.
#pragma once

namespace ogc::tests {

/// How many assertions fail; stops at the first. Once a process.
int failing_unit_tests();

}  // namespace ogc::tests
