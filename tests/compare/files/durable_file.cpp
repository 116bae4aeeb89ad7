#include "compare/files/durable_file.hpp"

#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/scratch.hpp"

using namespace ogc::compare;
using ogc::tests::Scratch;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A disk that takes no file longer than `bytes`, as long as the object lives.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limited{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

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
    CHECK_THROWS_WITH(write_durably(folder / "old", bytes), ContainsSubstring((folder / "old").string()) && ContainsSubstring("free space"));
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
  CHECK_THROWS_WITH(write_durably(folder / "a", "bytes"), ContainsSubstring((folder / "a").string()) && ContainsSubstring("No space left"));
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
