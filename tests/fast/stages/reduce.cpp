#include "fast/stages/reduce.hpp"

#include <vector>

#include "fast/cpu/backend.hpp"
#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

/// n items of each of two kinds, in columns of their own.
struct TwoKinds {
  int n;
  void add(int chunk, int chunks, double* sum) const {
    for (int i = chunk; i < n; i += chunks) sum[0] += i + 1;
    for (int i = chunk; i < n; i += chunks) sum[2] += i + 1;
  }
};

}  // namespace

TEST_CASE("sums hold every item once, in its column, whatever their number", "[property]") {
  CpuBackend backend;
  for (const int n : {0, 1, 31, 1023, 1024, 1025, 2048, 2049, 5000, 32767, 32768, 32769, 70000}) {
    Reduction<CpuBackend, 3> reduction(backend, n);
    std::vector<double> total(3, -1);
    for (int repeat = 0; repeat < 2; ++repeat) {
      reduction.sum(total.data(), TwoKinds{n});
    }
    const double expected = n * (n + 1.0) / 2;
    CHECK(total[0] == expected);
    CHECK(total[1] == 0);
    CHECK(total[2] == expected);
  }
}
