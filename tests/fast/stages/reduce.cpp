#include "fast/stages/reduce.hpp"

#include <algorithm>
#include <vector>

#include "fast/cpu/backend.hpp"
#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

/// Two kinds of n items each, which are added in columns 0 and 2.
struct TwoKinds {
  int n;
  void add(int chunk, int chunks, double* sum) const {
    for (int i = chunk; i < n; i += chunks) sum[0] += i + 1;
    for (int i = chunk; i < n; i += chunks) sum[2] += i + 1;
  }
};

struct Count {
  std::vector<int>* calls;
  void operator()(int i) const { ++(*calls)[static_cast<std::size_t>(i)]; }
};

}  // namespace

TEST_CASE(
    "sums hold every item once, in its column, whatever their number and whenever it was added; what stands beside "
    "them "
    "runs once",
    "[property]") {
  CpuBackend backend;
  for (const int n : {0, 1, 31, 1023, 1024, 1025, 2048, 2049, 5000, 32767, 32768, 32769, 70000}) {
    Reduction<CpuBackend, 6> reduction(backend, n);
    std::vector<double> total(6, -1);
    for (int repeat = 0; repeat < 2; ++repeat) {
      std::vector<int> early(static_cast<std::size_t>(n)), late(3), first(1), last(40000);
      reduction.add<0, 3>(TwoKinds{n}, n, Count{&early});
      reduction.add<3, 3>(TwoKinds{2 * n}, 3, Count{&late});
      reduction.total(total.data(), 1, Count{&first}, 40000, Count{&last});
      for (const std::vector<int>& calls : {early, late, first, last})
        CHECK(std::ranges::count(calls, 1) == std::ssize(calls));
    }
    const double early = n * (n + 1.0) / 2, late = n * (2 * n + 1.0);
    CHECK(total == std::vector<double>{early, 0, early, late, 0, late});
  }
}
