// Tests the CUDA backend against its definition in fast/stages/backend.hpp, which is computed here as simply as
// possible.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "tests/catch.hpp"

#include "compare/problem/error.hpp"
#include "fast/cuda/backend.cuh"
#include "fast/kernels/arithmetic/atomic.hpp"
#include "fast/kernels/team.hpp"

using namespace ogc::fast;

namespace {

template <class T>
CudaBuffer<T> on_device(const std::vector<T>& items) {
  CudaBuffer<T> buffer;
  buffer.upload(items.data(), items.size());
  return buffer;
}

template <class T>
std::vector<T> on_host(const CudaBuffer<T>& buffer) {
  std::vector<T> items(buffer.size());
  buffer.download(items.data(), items.size());
  return items;
}

struct SetToNumber {
  int* target;
  OGC_HD void operator()(int i) const { target[i] = i + 1; }
};

struct AddOne {
  int* target;
  OGC_HD void operator()(int i) const { atomic_add(target + i, 1); }
};

// Writes, for item i, the smallest k ≥ 2 below i mod 40 with k mod 7 = i mod 7, and the smallest of 50 − k.
struct SearchTogether {
  int *visits, *first;
  double* smallest;
  template <class Lanes>
  OGC_HD void operator()(int i, const Lanes& lanes) const {
    const int found = lanes.first(i % 40, 2, [i](int k) { return k % 7 == i % 7; });
    const double least = lanes.smallest(i % 40, 60, [](int k) { return 50.0 - k; });
    if (!lanes.leader()) return;
    atomic_add(visits + i, 1);
    first[i] = found;
    smallest[i] = least;
  }
};

struct Assign {
  int* target;
  int value;
  OGC_HD void operator()(int) const { *target = value; }
};

struct Subtract {
  int* target;
  int value;
  OGC_HD void operator()(int) const { *target -= value; }
};

struct AddBoth {
  const int *first, *second;
  int* sum;
  OGC_HD void operator()(int) const { *sum += *first + *second; }
};

// Holds sums of different kinds in one accumulator. Terms span many magnitudes, so that another order of additions
// gives other bits.
struct Sums {
  float large = 0, small = 0;
  int count = 0;
  OGC_HD Sums& operator+=(const Sums& other) {
    large = add(large, other.large);
    small = add(small, other.small);
    count += other.count;
    return *this;
  }
};

struct TwoOfRow {
  static constexpr int rank = 16;
  float *least, *after;
  OGC_HD void operator()(int i, float smallest, float after_rank) const { least[i] = smallest, after[i] = after_rank; }
};

// After a sum, searches a row for its first number below 20, and for the second one if the row's count is even. Also
// computes the minimum of 45 and the row's numbers. Teams of one warp search different numbers of times, so that their
// control flow diverges.
struct AskRow {
  static constexpr int parts = 1;
  const int* offsets;
  const float* values;
  int* out;
  template <class Lanes>
  OGC_HD void ask(int row, int begin, int count, const Lanes& lanes, bool writes) const {
    const auto is_low = [this, begin](int k) { return values[begin + k] < 20; };
    const int first = lanes.first(count, 0, is_low);
    const int next = first < count && count % 2 == 0 ? lanes.first(count, first + 1, is_low) : -1;
    const double least = lanes.smallest(count, 45, [this, begin](int k) { return double{values[begin + k]}; });
    if (writes) out[3 * row] = first, out[3 * row + 1] = next, out[3 * row + 2] = static_cast<int>(least);
  }
  template <class Team>
  OGC_HD void operator()(int row, Team team) const {
    const int begin = offsets[row], count = offsets[row + 1] - begin;
    team.template sum<Sums>(part(
        count, [this, begin](int k) { return values[begin + k]; },
        [](float term, Sums& sums) {
          sums += Sums{term, term, 1};
        }));
    if (team.holds_total()) ask(row, begin, count, team, team.leader());
  }
};

// Sums a row as three parts of unequal length. The last part is pooled; the first is empty in some rows.
struct RowSums {
  static constexpr int parts = 3;
  const int* offsets;
  const float* terms;
  Sums* out;
  template <class Team>
  OGC_HD void operator()(int row, Team team) const {
    const int begin = offsets[row], count = offsets[row + 1] - begin, first = count / 5, second = first + count / 2;
    const auto load_from = [this](int start) { return [from = terms + start](int k) { return from[k]; }; };
    const auto add = [](float term, Sums& sums) { sums += Sums{term, mul(term, term), 1}; };
    const Sums sums = team.template sum<Sums>(part(first, load_from(begin), add),
                                              part(second - first, load_from(begin + first), add),
                                              pooled_part(begin + second, count - second, load_from(0), [](float term) {
                                                return Sums{term, mul(term, term), 1};
                                              }));
    if (team.leader()) out[row] = sums;
  }
};

struct Rows {
  std::vector<int> offsets{0};
  std::vector<float> terms;
};

Rows random_rows(int count) {
  std::mt19937 random(7);
  Rows rows;
  for (int row = 0; row < count; ++row) {
    const int length = static_cast<int>(random() % 90);
    for (int k = 0; k < length; ++k) {
      rows.terms.push_back(
          std::ldexp(static_cast<float>(random() % 2001) - 1000.0f, static_cast<int>(random() % 40) - 20));
    }
    rows.offsets.push_back(static_cast<int>(rows.terms.size()));
  }
  return rows;
}

template <int W>
void check_team(int count) {
  const Rows rows = random_rows(count);
  std::vector<Sums> expected(static_cast<std::size_t>(count));
  for (int row = 0; row < count; ++row)
    RowSums{rows.offsets.data(), rows.terms.data(), expected.data()}(row, SerialTeam<W>{});
  CudaBackend backend;
  const CudaBuffer<int> offsets = on_device(rows.offsets);
  const CudaBuffer<float> terms = on_device(rows.terms);
  CudaBuffer<Sums> out;
  out.resize(static_cast<std::size_t>(count));
  for (const Start start : {Start::after_previous, Start::overlapping}) {
    out.fill_zero();
    backend.for_each_team<W>(count, RowSums{offsets.data(), terms.data(), out.data()}, start);
    const std::vector<Sums> found = on_host(out);
    int different = 0;
    for (std::size_t row = 0; row < found.size(); ++row)
      different += std::memcmp(&found[row], &expected[row], sizeof(Sums)) != 0;
    CHECK(different == 0);
  }
}

}  // namespace

TEST_CASE("for_each visits every index once, also where there are more indices than threads", "[gpu]") {
  CudaBackend backend;
  for (const int n : {0, 1, 2, 31, 127, 128, 129, 5000, 3'000'000}) {
    CudaBuffer<int> visits;
    visits.resize(static_cast<std::size_t>(n) + 1);
    backend.for_each(n, AddOne{visits.data()});
    std::vector<int> expected(static_cast<std::size_t>(n) + 1, 1);
    expected.back() = 0;
    CHECK((on_host(visits) == expected));
  }
}

TEST_CASE("for_each_group visits every item once, and its lanes search as one lane does", "[gpu]") {
  for (const LaunchShape& shape : {LaunchShape{}, LaunchShape{32, 1}}) {
    CudaBackend backend(shape);
    for (const int n : {1, 7, 129, 100'000}) {
      const auto items = static_cast<std::size_t>(n);
      CudaBuffer<int> visits, first;
      CudaBuffer<double> smallest;
      visits.resize(items), first.resize(items), smallest.resize(items);
      visits.fill_zero();
      backend.for_each_group<16>(n, SearchTogether{visits.data(), first.data(), smallest.data()});
      std::vector<int> once(items), expected_first(items);
      std::vector<double> expected_smallest(items);
      const SearchTogether alone{once.data(), expected_first.data(), expected_smallest.data()};
      for (int i = 0; i < n; ++i) alone(i, SerialTeam<1>{});
      CHECK((on_host(visits) == once));
      CHECK((on_host(first) == expected_first));
      CHECK((on_host(smallest) == expected_smallest));
    }
  }
}

TEST_CASE("for_each_counted reads its count on the device and never passes the capacity", "[gpu]") {
  CudaBackend backend;
  for (const int count : {0, 1, 700, 1000, 2000}) {
    CudaBuffer<int> visits;
    visits.resize(2000);
    const CudaBuffer<int> n = on_device(std::vector<int>{count});
    backend.for_each_counted(n.data(), 1000, AddOne{visits.data()});
    const std::vector<int> found = on_host(visits);
    const int expected = std::min(count, 1000);
    CHECK(std::count(found.begin(), found.begin() + expected, 1) == expected);
    CHECK(std::count(found.begin() + expected, found.end(), 0) == 2000 - expected);
  }
}

TEST_CASE(
    "a team of lanes gives the bits of SerialTeam for every width, in launches that fill the device and in small ones",
    "[gpu]") {
  for (const int count : {1001, 50'003}) {
    check_team<1>(count);
    check_team<2>(count);
    check_team<4>(count);
    check_team<8>(count);
    check_team<16>(count);
    check_team<32>(count);
  }
}

TEST_CASE("a scan gives n + 1 sums, in place too", "[gpu]") {
  CudaBackend backend;
  for (const std::size_t n : {0u, 1u, 2u, 1000u, 1'000'003u}) {
    std::vector<int> items(n + 1, 0), expected(n + 1, 0);
    for (std::size_t i = 0; i < n; ++i) items[i] = static_cast<int>(i * 7919 % 13);
    for (std::size_t i = 0; i < n; ++i) expected[i + 1] = expected[i] + items[i];
    CudaBuffer<int> in = on_device(items), in_place = on_device(items), out;
    out.resize(n + 1);
    backend.exclusive_scans({in.data(), out.data(), static_cast<int>(n)},
                            {in_place.data(), in_place.data(), static_cast<int>(n)});
    CHECK((on_host(out) == expected));
    CHECK((on_host(in_place) == expected));
  }
}

TEST_CASE("two scans at once give the sums of each", "[gpu]") {
  CudaBackend backend;
  for (const std::size_t n : {0u, 5u, 2048u, 70'000u}) {
    for (const std::size_t m : {0u, 3000u, 100'000u}) {
      std::vector<int> items[2] = {std::vector<int>(n + 1, 0), std::vector<int>(m + 1, 0)}, expected[2];
      for (std::vector<int>& all : items) {
        for (std::size_t i = 0; i + 1 < all.size(); ++i) all[i] = static_cast<int>((i + all.size()) * 7919 % 13);
      }
      for (int k = 0; k < 2; ++k) {
        expected[k].assign(items[k].size(), 0);
        for (std::size_t i = 0; i + 1 < items[k].size(); ++i) expected[k][i + 1] = expected[k][i] + items[k][i];
      }
      CudaBuffer<int> in[2] = {on_device(items[0]), on_device(items[1])}, out[2];
      out[0].resize(n + 1), out[1].resize(m + 1);
      backend.exclusive_scans({in[0].data(), out[0].data(), static_cast<int>(n)},
                              {in[1].data(), out[1].data(), static_cast<int>(m)});
      CHECK((on_host(out[0]) == expected[0]));
      CHECK((on_host(out[1]) == expected[1]));
    }
  }
}

TEST_CASE("of each row the smallest number, and the one that so many come before", "[gpu]") {
  CudaBackend backend;
  std::mt19937 random(5);
  const int rows = 20'000;
  std::vector<int> offsets{0};
  std::vector<float> values;
  for (int row = 0; row < rows; ++row) {
    const auto count = row < 70 ? static_cast<unsigned long>(row) : random() % (row % 100 == 0 ? 2000 : 90);
    for (auto k = count; k > 0; --k) values.push_back(static_cast<float>(random() % (row % 3 == 0 ? 7 : 100000)));
    offsets.push_back(static_cast<int>(values.size()));
  }
  CudaBuffer<int> device_offsets = on_device(offsets);
  CudaBuffer<float> device_values = on_device(values), least, after;
  least.resize(rows), after.resize(rows);
  backend.for_each_row(rows, device_offsets.data(), device_values.data(), TwoOfRow{least.data(), after.data()});
  std::vector<float> expected_least, expected_after;
  for (std::size_t row = 0; row < rows; ++row) {
    std::vector<float> sorted(values.begin() + offsets[row], values.begin() + offsets[row + 1]);
    std::sort(sorted.begin(), sorted.end());
    sorted.resize(sorted.size() + TwoOfRow::rank + 1, std::numeric_limits<float>::infinity());
    expected_least.push_back(sorted[0]), expected_after.push_back(sorted[TwoOfRow::rank]);
  }
  CHECK((on_host(least) == expected_least));
  CHECK((on_host(after) == expected_after));
}

TEST_CASE("what lanes ask together is what one lane finds", "[gpu]") {
  CudaBackend backend;
  const int rows = 3000;
  std::mt19937 random(6);
  std::vector<int> offsets{0};
  std::vector<float> values;
  for (int row = 0; row < rows; ++row) {
    for (auto k = random() % 40; k > 0; --k) values.push_back(static_cast<float>(random() % 50));
    offsets.push_back(static_cast<int>(values.size()));
  }
  std::vector<int> expected(3 * rows);
  for (int row = 0; row < rows; ++row) {
    const int begin = offsets[static_cast<std::size_t>(row)], end = offsets[static_cast<std::size_t>(row) + 1];
    AskRow{offsets.data(), values.data(), expected.data()}.ask(row, begin, end - begin, OneLane{}, true);
  }
  CudaBuffer<int> device_offsets = on_device(offsets);
  CudaBuffer<float> device_values = on_device(values);
  const auto asked = [&]<int W>(int count) {
    CudaBuffer<int> answers = on_device(std::vector<int>(3 * rows, -1));
    backend.for_each_team<W>(count, AskRow{device_offsets.data(), device_values.data(), answers.data()},
                             Start::after_previous);
    std::vector<int> found = on_host(answers);
    found.resize(3 * static_cast<std::size_t>(count));
    return found;
  };
  for (const int count : {1, 7, rows}) {  // few rows take SpreadTeams; many rows and wide teams take SerialLaneTeams
    const std::vector<int> wanted(expected.begin(), expected.begin() + 3 * count);
    CHECK((asked.operator()<1>(count) == wanted));
    CHECK((asked.operator()<4>(count) == wanted));
    CHECK((asked.operator()<16>(count) == wanted));
    CHECK((asked.operator()<32>(count) == wanted));
  }
}

TEST_CASE("sort_pairs is stable and ascending over all 64 bits", "[gpu]") {
  CudaBackend backend;
  std::mt19937_64 random(3);
  for (const std::size_t n : {0u, 1u, 2u, 100u, 4097u, 500'000u}) {
    std::vector<std::uint64_t> keys(n);
    std::vector<int> values(n);
    std::iota(values.begin(), values.end(), 0);
    for (auto& key : keys) key = random() % 1000 == 0 ? ~random() : (random() % 97) << (random() % 50);
    std::vector<int> expected = values;
    std::stable_sort(expected.begin(), expected.end(), [&](int a, int b) {
      return keys[static_cast<std::size_t>(a)] < keys[static_cast<std::size_t>(b)];
    });
    CudaBuffer<std::uint64_t> device_keys = on_device(keys);
    CudaBuffer<int> device_values = on_device(values);
    backend.sort_pairs(device_keys.data(), device_values.data(), static_cast<int>(n));
    std::sort(keys.begin(), keys.end());
    CHECK((on_host(device_keys) == keys));
    CHECK((on_host(device_values) == expected));
  }
}

TEST_CASE("a sort looks at the bits it is told, and keys that differ elsewhere keep their order", "[gpu]") {
  CudaBackend backend;
  std::mt19937_64 random(4);
  for (const std::size_t n : {5u, 4097u, 200'000u}) {
    std::vector<std::uint64_t> keys(n);
    for (auto& key : keys) key = random();
    std::vector<int> values(n), expected(n);
    std::iota(values.begin(), values.end(), 0);
    std::iota(expected.begin(), expected.end(), 0);
    const auto part = [&](int i) { return keys[static_cast<std::size_t>(i)] >> 30 & 0xffU; };
    std::stable_sort(expected.begin(), expected.end(), [&](int a, int b) { return part(a) < part(b); });
    CudaBuffer<std::uint64_t> device_keys = on_device(keys);
    CudaBuffer<int> device_values = on_device(values);
    backend.sort_pairs(device_keys.data(), device_values.data(), static_cast<int>(n), {30, 38});
    CHECK((on_host(device_values) == expected));
  }
}

TEST_CASE("when decides at its turn, both at once and in a replay", "[gpu]") {
  CudaBackend backend;
  CudaBuffer<int> flag, count;
  flag.resize(1);
  count.resize(1);
  // The flag is 0 for the first body, which does not run. It is 1 for the second body, which counts, sorts, scans and
  // clears the flag. So the third body does not run.
  std::vector<std::uint64_t> keys{3, 1, 2};
  CudaBuffer<std::uint64_t> device_keys;
  CudaBuffer<int> values, sums, sums_again;
  sums.resize(4), sums_again.resize(4);
  const auto body = [&] {
    backend.when(Assign{flag.data(), 0}, flag.data(), [&] { backend.for_each(1, AddOne{count.data()}); });
    backend.when(Assign{flag.data(), 1}, flag.data(), [&] {
      backend.for_each(1, AddOne{count.data()});
      backend.sort_pairs(device_keys.data(), values.data(), 3);
      backend.exclusive_scans({values.data(), sums.data(), 3}, {values.data(), sums_again.data(), 3});
      backend.for_each(1, Assign{flag.data(), 0});
    });
    backend.when(Subtract{flag.data(), 0}, flag.data(), [&] { backend.for_each(1, AddOne{count.data()}); });
  };
  CudaRecording recording;
  for (const int times : {0, 1, 5}) {
    device_keys.upload(keys.data(), 3);
    values.upload(std::vector<int>{10, 20, 30}.data(), 3);
    count.fill_zero();
    if (times == 0) {
      body();
    } else {
      backend.replay(recording, times, body);
    }
    backend.synchronize();
    CHECK(on_host(count)[0] == std::max(times, 1));
    CHECK((on_host(values) == std::vector<int>{20, 30, 10}));
    CHECK((on_host(sums) == std::vector<int>{0, 20, 50, 60}));
    if (times > 0) CHECK(backend.replay_milliseconds().size() == static_cast<std::size_t>(times));
  }
}

TEST_CASE("repeat goes on until its flag falls, both at once and in a replay, and not at all where it is down",
          "[gpu]") {
  CudaBackend backend;
  CudaBuffer<int> left, count;
  left.resize(1);
  count.resize(1);
  CudaRecording recording;
  for (const int rounds : {0, 1, 7}) {
    for (const bool recorded : {false, true}) {
      count.fill_zero();
      recording.clear();
      const auto body = [&] {
        backend.repeat(
            Assign{left.data(), rounds}, left.data(), [&] { backend.for_each(1, AddOne{count.data()}); },
            Subtract{left.data(), 1});
      };
      if (recorded)
        backend.replay(recording, 3, body);
      else
        body();
      backend.synchronize();
      CHECK(on_host(count)[0] == (recorded ? 3 * rounds : rounds));
    }
  }
}

TEST_CASE("two branches part and meet, both at once and in a replay, at the top and in a round", "[gpu]") {
  CudaBackend backend;
  CudaBuffer<int> left, aside, main, sum;
  for (auto* buffer : {&left, &aside, &main, &sum}) buffer->resize(1);
  CudaRecording recording;
  // a launch that does not wait for both branches reads a sum below 3
  const auto branches = [&] {
    backend.for_each(1, Assign{aside.data(), 1});
    backend.for_each(1, Assign{main.data(), 1});
    backend.at_once(
        [&] {
          for (int k = 0; k < 2; ++k) backend.for_each(1, AddOne{aside.data()});
        },
        [&] {
          for (int k = 0; k < 2; ++k) backend.for_each(1, AddOne{main.data()});
        });
    backend.for_each(1, AddBoth{aside.data(), main.data(), sum.data()});
  };
  const auto body = [&] {
    branches();
    backend.repeat(Assign{left.data(), 3}, left.data(), branches, Subtract{left.data(), 1});
    branches();
  };
  for (const bool recorded : {false, true}) {
    sum.fill_zero();
    if (recorded)
      backend.replay(recording, 2, body);
    else
      body();
    backend.synchronize();
    CHECK(on_host(sum)[0] == (recorded ? 2 : 1) * 5 * 6);
  }
}

TEST_CASE("branches inside a branch's body have scans of their own", "[gpu]") {
  // so long that a scan needs temporary memory
  constexpr int n = 1 << 20;
  CudaBackend backend;
  CudaBuffer<int> ones, twos, sums_of_ones, sums_of_twos, none_beside_ones, none_beside_twos, aside;
  for (auto* buffer : {&sums_of_ones, &sums_of_twos}) buffer->resize(n + 1);
  for (auto* buffer : {&none_beside_ones, &none_beside_twos, &aside}) buffer->resize(1);
  aside.fill_zero();
  const std::vector<int> one(n, 1), two(n, 2);
  ones.upload(one.data(), one.size());
  twos.upload(two.data(), two.size());
  const auto body = [&] {
    backend.at_once([&] { backend.for_each(1, AddOne{aside.data()}); },
                    [&] {
                      backend.at_once(
                          [&] {
                            for (int k = 0; k < 8; ++k)
                              backend.exclusive_scans({ones.data(), sums_of_ones.data(), n},
                                                      {ones.data(), none_beside_ones.data(), 0});
                          },
                          [&] {
                            for (int k = 0; k < 8; ++k)
                              backend.exclusive_scans({twos.data(), sums_of_twos.data(), n},
                                                      {twos.data(), none_beside_twos.data(), 0});
                          });
                    });
  };
  CudaRecording recording;
  backend.replay(recording, 4, body);
  backend.synchronize();
  CHECK(on_host(aside)[0] == 4);
  const std::vector<int> by_one = on_host(sums_of_ones), by_two = on_host(sums_of_twos);
  int wrong = 0;
  for (std::size_t i = 0; i <= n; ++i)
    wrong += by_one[i] != static_cast<int>(i) || by_two[i] != static_cast<int>(2 * i);
  CHECK(wrong == 0);
}

TEST_CASE("a recording runs its body on the host again only when a Buffer has moved", "[gpu]") {
  CudaBackend backend;
  CudaBuffer<int> items;
  items.resize(10);
  CudaRecording recording;
  int recorded = 0;
  const auto body = [&] {
    ++recorded;
    backend.for_each(static_cast<int>(items.size()), SetToNumber{items.data()});
  };
  backend.replay(recording, 3, body);
  backend.replay(recording, 2, body);
  CHECK(recorded == 1);
  items.resize(100'000);
  backend.replay(recording, 1, body);
  CHECK(recorded == 2);
  const std::vector<int> found = on_host(items);
  CHECK(found.front() == 1);
  CHECK(found.back() == 100'000);
}

TEST_CASE("a body that throws while it is recorded leaves the backend usable", "[gpu]") {
  CudaBackend backend;
  CudaBuffer<int> items;
  items.resize(4);
  CudaRecording recording;
  CHECK_THROWS_AS(
      backend.replay(recording, 1,
                     [&] {
                       backend.when(Subtract{items.data(), 0}, items.data(), [&] { throw std::runtime_error("body"); });
                     }),
      std::runtime_error);
  backend.replay(recording, 1, [&] { backend.for_each(4, SetToNumber{items.data()}); });
  backend.synchronize();
  CHECK((on_host(items) == std::vector<int>{1, 2, 3, 4}));
}

TEST_CASE("a request that does not fit says what was asked for and what to do", "[gpu]") {
  CudaBuffer<double> buffer;
  try {
    buffer.resize(std::size_t{1} << 45);
    FAIL("256 TiB were granted");
  } catch (const ogc::compare::ResourceError& error) {
    const std::string text = error.what();
    CHECK(text.find("268435456.0 MiB") != std::string::npos);
    CHECK(text.find("run with the backend cpu") != std::string::npos);
  }
  buffer.resize(8);
  CHECK((on_host(buffer) == std::vector<double>(8, 0.0)));
}
