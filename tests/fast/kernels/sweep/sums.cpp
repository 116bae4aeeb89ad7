#include "fast/kernels/sweep/sums.hpp"

#include <vector>

#include "tests/catch.hpp"

using namespace ogc::fast;

namespace {

template <class... Sums>
std::vector<unsigned> gives(SumList<Sums...>) {
  return {Sums::gives...};
}

constexpr unsigned everything = Kinds::bits | (first_kind_bit - 1);

}  // namespace

TEST_CASE("a scene takes the first sum that gives all it asks for, and there is always one", "[unit]") {
  for (const std::vector<unsigned>& sums : {gives(DeviceSums{}), gives(HostSums{})}) {
    CHECK(sums.back() == everything);
    for (unsigned asked = 0; asked <= everything; ++asked) {
      const bool on_device = sums.size() == DeviceSums::count;
      const auto number = static_cast<std::size_t>(on_device ? DeviceSums::first_that_gives(asked)
                                                             : HostSums::first_that_gives(asked));
      REQUIRE(number < sums.size());
      CHECK((asked & ~sums[number]) == 0);
      for (std::size_t before = 0; before < number; ++before) CHECK((asked & ~sums[before]) != 0);
    }
  }
}

TEST_CASE("each sum of a device is one that some scene takes", "[unit]") {
  const std::vector<unsigned> sums = gives(DeviceSums{});
  for (std::size_t number = 0; number < sums.size(); ++number)
    CHECK(DeviceSums::first_that_gives(sums[number]) == static_cast<int>(number));
}

TEST_CASE("surfaces that bend isometrically take a sum without what they do not have", "[unit]") {
  const unsigned sheet = Kinds::bit<TriangleKind> | Kinds::bit<HingeKind>;
  const auto sum_of = [](unsigned asked) {
    return gives(DeviceSums{}).at(static_cast<std::size_t>(DeviceSums::first_that_gives(asked)));
  };
  CHECK(sum_of(sheet) == GatherSurfaces::gives);
  CHECK(sum_of(sheet | asks_any_bending) == GatherBentSurfaces::gives);
  CHECK((sum_of(sheet | asks_any_stretch) & Kinds::bit<TetrahedronKind>) != 0);
}
