// The kernels' own tests (tests/fast/kernels), compiled over rewritten kernels.
#pragma once

namespace ogc::tests {

/// How many assertions fail; stops at the first. Once a process.
int failing_kernel_tests();

}  // namespace ogc::tests
