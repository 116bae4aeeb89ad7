// Skips tests that need a device if there is none: the run ends before its first test case with exit status 77, ctest's
// SKIP_RETURN_CODE. Listing the test cases, which happens at build time, starts no run and needs no device.
#include <cstdio>
#include <cstdlib>

#define CATCH_CONFIG_EXTERNAL_INTERFACES
#include "tests/catch.hpp"

#include "fast/cuda/cuda.hpp"

namespace {

#if __has_include(<catch2/catch_all.hpp>)
using ListenerBase = Catch::EventListenerBase;
#else
using ListenerBase = Catch::TestEventListenerBase;
#endif

struct SkipWithoutDevice : ListenerBase {
  using ListenerBase::ListenerBase;
  void testRunStarting(const Catch::TestRunInfo&) override {
    const ogc::fast::BackendInfo info = ogc::fast::cuda_info();
    if (info.usable) return;
    std::printf("skipped: %s\n", info.description.c_str());
    std::fflush(stdout);
    std::_Exit(77);
  }
};

CATCH_REGISTER_LISTENER(SkipWithoutDevice)

}  // namespace
