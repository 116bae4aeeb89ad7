// Compares the judge's random numbers on the device and on the host, bit for bit. `between` adds a product and is left
// out, because contraction may change it on the device. Names are literals with a given length: a host function counts
// the length of a plain literal, and nvcc then drops the whole kernel without a message.
#include <bit>
#include <cstdint>
#include <string_view>
#include <vector>

#include "tests/catch.hpp"

#include "compare/judge/cases/random.hpp"
#include "fast/cuda/backend.cuh"

using namespace ogc::fast;
using namespace std::string_view_literals;

namespace {

constexpr int numbers_a_case = 10;

/// Writes ten random numbers of the case with this index, by different functions of Random.
struct NumbersOfCase {
  std::uint64_t* target;
  OGC_HD void operator()(int index) const {
    ogc::compare::Random random("detect_edge_edge"sv, "ladder.sheets"sv, 7, static_cast<std::uint64_t>(index));
    std::uint64_t* out = target + numbers_a_case * index;
    out[0] = random.bits();
    out[1] = std::bit_cast<std::uint64_t>(random.unit());
    out[2] = static_cast<std::uint64_t>(random.below(12345));
    out[3] = std::bit_cast<std::uint32_t>(random.pattern());
    out[4] = std::bit_cast<std::uint64_t>(random.rung());
    out[5] = std::bit_cast<std::uint64_t>(random.sign());
    random.be_fine();
    out[6] = std::bit_cast<std::uint64_t>(random.rung());
    out[7] = std::bit_cast<std::uint32_t>(random.pattern(0x1p-6f, 0x1p6f));
    out[8] = std::bit_cast<std::uint32_t>(random.last_bits(0.3f, 17));
    out[9] = random.bits();
  }
};

}  // namespace

TEST_CASE("the numbers of a case are the same bits on the device, in any order", "[gpu]") {
  constexpr int cases = 10000;
  std::vector<std::uint64_t> host(numbers_a_case * cases), device(host.size());
  for (int index = cases; index-- > 0;) NumbersOfCase{host.data()}(index);
  CudaBackend backend;
  CudaBuffer<std::uint64_t> buffer;
  buffer.resize(device.size());
  backend.for_each(cases, NumbersOfCase{buffer.data()});
  backend.synchronize();
  buffer.download(device.data(), device.size());
  CHECK(device == host);
}
