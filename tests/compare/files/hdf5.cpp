#include "compare/files/hdf5.hpp"

#include <fstream>
#include <random>

#include "compare/files/durable_file.hpp"
#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/scratch.hpp"

using namespace ogc::compare;
using ogc::tests::Scratch;

namespace {

template <class T>
void check_round_trip(const std::filesystem::path& path, const std::vector<T>& values) {
  Hdf5File file = Hdf5File::create_in_memory(path);
  file.create_group("group");
  file.write("group/flat", std::span(values));
  file.write("group/rows", std::span(values), 3);
  file.set_attribute("/", "step", std::array<std::int64_t, 1>{1LL << 40});
  file.set_attribute("/", "time", 0.1);
  write_durably(path, file.image());
  const Hdf5File back = Hdf5File::open(path);
  CHECK(back.shape("group/flat") == std::vector<std::size_t>{values.size()});
  CHECK(back.shape("group/rows") == std::vector<std::size_t>{values.size() / 3, 3});
  CHECK(back.read<T>("group/flat") == values);
  CHECK(back.read<T>("group/rows") == values);
  CHECK(back.attribute<std::int64_t>("step") == 1LL << 40);
  CHECK(back.attribute<double>("time") == 0.1);
}

}  // namespace

TEST_CASE("values of every type come back bit for bit, from none to several chunks", "[unit]") {
  const Scratch folder;
  std::mt19937 random(1);
  for (const std::size_t count : {0u, 3u, 3u * 1024u, 3u * 70000u}) {
    std::vector<float> floats(count);
    for (float& value : floats)
      value = std::ldexp(static_cast<float>(random()), static_cast<int>(random() % 200) - 140);
    check_round_trip(folder / "floats.h5", floats);
    check_round_trip(folder / "doubles.h5", std::vector<double>(floats.begin(), floats.end()));
    std::vector<std::int64_t> integers(count);
    for (std::int64_t& value : integers) value = static_cast<std::int64_t>(random()) << (random() % 32);
    check_round_trip(folder / "integers.h5", integers);
    check_round_trip(folder / "indices.h5", std::vector<std::int32_t>(count, -7));
  }
}

TEST_CASE("rows written one part after the other make one dataset", "[unit]") {
  const Scratch folder;
  Hdf5File file = Hdf5File::create(folder / "parts.h5", 1 << 20);
  file.create_dataset<float>("rows", 4, 2, 2);
  file.write_rows("rows", 2, std::span<const float>(std::array{5.f, 6.f, 7.f, 8.f}));
  file.write_rows("rows", 0, std::span<const float>(std::array{1.f, 2.f, 3.f, 4.f}));
  file.close();
  CHECK(Hdf5File::open(folder / "parts.h5").read<float>("rows") == std::vector{1.f, 2.f, 3.f, 4.f, 5.f, 6.f, 7.f, 8.f});
}

TEST_CASE(
    "a file takes no more disk than was reserved for it, even where nothing can be compressed, and gives the rest back",
    "[property]") {
  const Scratch folder;
  std::mt19937 random(2);
  for (const auto& [rows, part] : std::vector<std::pair<std::size_t, std::size_t>>{{1, 1},
                                                                                   {1000, 1000},
                                                                                   {2048, 1},
                                                                                   {5000, 7},
                                                                                   {65536, 65536},
                                                                                   {65537, 65537},
                                                                                   {140000, 70000},
                                                                                   {1000000, 1000},
                                                                                   {1000000, 1000000}}) {
    std::vector<std::int32_t> noise(rows);
    for (std::int32_t& value : noise) value = static_cast<std::int32_t>(random());
    const std::size_t reserved = Hdf5File::largest_size(rows, sizeof noise[0], part) + 4096;
    Hdf5File file = Hdf5File::create(folder / "noise.h5", reserved);
    CHECK(std::filesystem::file_size(folder / "noise.h5") == reserved);
    file.create_dataset<std::int32_t>("noise", rows, 0, part);
    for (std::size_t first = 0; first < rows; first += part)
      file.write_rows("noise", first,
                      std::span<const std::int32_t>(noise).subspan(first, std::min(part, rows - first)));
    file.close();
    const std::size_t size = std::filesystem::file_size(folder / "noise.h5");
    CHECK(size >= rows * sizeof noise[0]);
    CHECK(size < reserved);
  }
}

TEST_CASE("files that are missing, no HDF5 or without the dataset are refused with their names", "[unit]") {
  const Scratch folder;
  CHECK_THROWS_WITH(Hdf5File::open(folder / "none.h5"), ContainsSubstring("none.h5") && ContainsSubstring("missing"));
  std::ofstream(folder / "text.h5") << "text";
  CHECK_THROWS_AS(Hdf5File::open(folder / "text.h5"), InputError);
  write_durably(folder / "empty.h5", Hdf5File::create_in_memory("empty").image());
  const Hdf5File empty = Hdf5File::open(folder / "empty.h5");
  CHECK_THROWS_WITH(empty.read<float>("positions"), ContainsSubstring("empty.h5") && ContainsSubstring("'positions'"));
  CHECK_THROWS_WITH(empty.attribute<double>("time"), ContainsSubstring("'time'"));
}

TEST_CASE("a truncated file is refused", "[unit]") {
  const Scratch folder;
  Hdf5File file = Hdf5File::create_in_memory("x");
  file.write("values", std::span<const float>(std::vector<float>(1000, 1.5f)));
  const std::string bytes = file.image();
  write_durably(folder / "half.h5", bytes.substr(0, bytes.size() / 2));
  CHECK_THROWS_AS(Hdf5File::open(folder / "half.h5").read<float>("values"), InputError);
}

TEST_CASE("a dataset that announces more than its file can hold is refused before memory is taken", "[unit]") {
  const Scratch folder;
  const std::vector<float> values(0x1235, 0.5f);
  Hdf5File file = Hdf5File::create_in_memory(folder / "x.h5");
  file.write("values", std::span(values));
  std::string bytes = file.image();
  const auto as_bytes = [](std::uint64_t number) {
    return std::string(reinterpret_cast<const char*>(&number), sizeof number);
  };
  std::size_t found = 0;
  for (std::size_t at = 0; (at = bytes.find(as_bytes(values.size()), at)) != std::string::npos; ++found)
    bytes.replace(at, 8, as_bytes(std::uint64_t{1} << 44));
  REQUIRE(found > 0);
  write_durably(folder / "x.h5", bytes);
  CHECK_THROWS_WITH(Hdf5File::open(folder / "x.h5").read<float>("values"),
                    ContainsSubstring("x.h5") && ContainsSubstring("announces more values"));
}
