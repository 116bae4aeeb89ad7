#include "compare/files/durable_file.hpp"

#include <fstream>
#include <iterator>

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/scratch.hpp"
#include "tests/compare/files/small_disk.hpp"

using namespace ogc::compare;
using ogc::tests::Scratch;
using ogc::tests::SmallDisk;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("a file gets its name when it is whole, and replaces an earlier one", "[unit]") {
  const Scratch folder;
  write_durably(folder / "a", "first");
  write_durably(folder / "a", "second");
  CHECK(text_of(folder / "a") == "second");
  CHECK_FALSE(std::filesystem::exists(partial_name(folder / "a")));
}

TEST_CASE("a write that stops half-way leaves neither name, or the earlier file", "[unit]") {
  const Scratch folder;
  write_durably(folder / "old", "whole");
  {
    const SmallDisk disk(1000);
    const std::string bytes(5000, 'x');
    CHECK_THROWS_WITH(write_durably(folder / "old", bytes),
                      ContainsSubstring((folder / "old").string()) && ContainsSubstring("free space"));
    CHECK_THROWS_AS(write_durably(folder / "new", bytes), ResourceError);
  }
  CHECK(text_of(folder / "old") == "whole");
  CHECK_FALSE(std::filesystem::exists(folder / "new"));
  CHECK_FALSE(std::filesystem::exists(partial_name(folder / "old")));
  CHECK_FALSE(std::filesystem::exists(partial_name(folder / "new")));
}

TEST_CASE("a full disk is reported with the path", "[unit]") {
  const Scratch folder;
  std::filesystem::create_symlink("/dev/full", partial_name(folder / "a"));
  CHECK_THROWS_WITH(write_durably(folder / "a", "bytes"),
                    ContainsSubstring((folder / "a").string()) && ContainsSubstring("No space left"));
  CHECK_FALSE(std::filesystem::exists(folder / "a"));
  CHECK_THROWS_AS(write_durably(folder / "no such folder/a", "bytes"), ResourceError);
  CHECK_THROWS_AS(sync_to_disk(folder / "nothing"), ResourceError);
}

TEST_CASE("space that can't be reserved leaves no file", "[unit]") {
  const Scratch folder;
  {
    const SmallDisk disk(100000);
    CHECK_THROWS_WITH(write_and_reserve(folder / "a", "head", 200000), ContainsSubstring("reserve 195 KiB"));
  }
  CHECK_FALSE(std::filesystem::exists(folder / "a"));
  write_and_reserve(folder / "a", "head", 200000);
  CHECK(std::filesystem::file_size(folder / "a") == 200000);
}

TEST_CASE("lines that the disk does not take leave the file as it was, and later ones follow", "[unit]") {
  const Scratch folder;
  LineAppender lines(folder / "lines");
  lines.append("one\n");
  {
    const SmallDisk disk(6);
    CHECK_THROWS_WITH(lines.append("two\nthree\n"), ContainsSubstring((folder / "lines").string()));
  }
  CHECK(text_of(folder / "lines") == "one\n");
  lines.append("four\n");
  CHECK(text_of(folder / "lines") == "one\nfour\n");
  CHECK_THROWS_AS(LineAppender(folder / "no such folder/lines"), ResourceError);
}

TEST_CASE("a group of files gets its names together, and names that can't be given are told", "[unit]") {
  const Scratch folder;
  const std::vector<std::filesystem::path> files{folder / "a", folder / "b"};
  for (const auto& file : files) write_partial(file, file.filename().string());
  CHECK_FALSE(std::filesystem::exists(folder / "a"));
  CHECK(text_of(partial_name(folder / "b")) == "b");
  commit_group(folder / "", files);
  CHECK(text_of(folder / "a") == "a");
  CHECK(text_of(folder / "b") == "b");
  CHECK_FALSE(std::filesystem::exists(partial_name(folder / "a")));
  CHECK_THROWS_WITH(commit_group(folder / "", files), ContainsSubstring((folder / "a").string()));
  CHECK_THROWS_AS(commit_group(folder / "nowhere", {}), ResourceError);
  const SmallDisk disk(1000);
  CHECK_THROWS_AS(write_partial(folder / "c", std::string(5000, 'x')), ResourceError);
  CHECK_FALSE(std::filesystem::exists(partial_name(folder / "c")));
  CHECK_THROWS_WITH(reserve(folder / "a", 1, 200000), ContainsSubstring("reserve 195 KiB"));
}
