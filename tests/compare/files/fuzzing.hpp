// Damages files at random and gives each to a reader. The reader must not die or hang, must name the file in its error,
// and must not take more than 100 MB plus twice the file's size beyond the program's memory. Cases run in separate
// processes under a limit on memory.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "compare/problem/error.hpp"
#include "tests/catch.hpp"
#include "tests/compare/files/number_bytes.hpp"

namespace ogc::tests {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool limits_memory = false;  // the sanitizer's shadow memory is reserved address space
#else
inline constexpr bool limits_memory = true;
#endif
inline constexpr std::size_t most_memory = 100'000'000;  ///< limit beyond the program's memory [bytes]

struct Sample {
  std::string name, bytes;
};

class Mutator {
 public:
  Mutator(std::string whole, std::mt19937_64& random) : bytes_(std::move(whole)), random_(random) {}

  /// Returns the file after one to four changes, each applied to the result of the previous change.
  std::string mutated() {
    for (std::size_t k = 1 + below(4); k-- > 0 && !bytes_.empty();) change();
    return bytes_;
  }

 private:
  std::size_t below(std::size_t count) { return std::uniform_int_distribution<std::size_t>(0, count - 1)(random_); }
  std::size_t place() { return below(bytes_.size()); }
  std::string part() { return bytes_.substr(place(), 1 + below(40)); }

  void change() {
    switch (below(9)) {
      case 0: bytes_[place()] ^= static_cast<char>(1U << below(8)); break;
      case 1: bytes_[place()] = static_cast<char>(below(256)); break;
      case 2: bytes_.resize(place()); break;
      case 3: bytes_.erase(place(), 1 + below(20)); break;
      case 4: bytes_.insert(place(), part()); break;
      case 5: bytes_.replace(place(), 1 + below(10), part()); break;
      case 6: binary_number(); break;
      default: word(); break;
    }
  }

  /// Writes four or eight bytes of an extreme count.
  void binary_number() {
    constexpr std::array<std::uint64_t, 7> numbers{0,          1,           0x7fffffff,        0x80000000,
                                                   0xffffffff, 0x100000000, 0xffffffffffffffff};
    std::string raw;
    append_number(raw, numbers[below(numbers.size())], below(2) == 0 ? std::endian::little : std::endian::big);
    const std::size_t width = below(2) == 0 ? 4 : 8;
    bytes_.replace(place(), width, raw.substr(below(9 - width), width));
  }

  /// Replaces a number or a name in the text.
  void word() {
    constexpr std::array<const char*, 16> words{"4294967295", "-1",     "1e999", "nan",     "99999999999999999999", "0",
                                                "2147483648", "1.#INF", "1e300", "1e-320",  "400000000000",         "3",
                                                "\r",         "#",      "\\\n",  "16777217"};
    const std::size_t digit = bytes_.find_first_of("0123456789", place());
    const std::size_t begin = digit == std::string::npos ? place() : digit;
    const std::size_t end = std::min(bytes_.find_first_not_of("0123456789.-", begin), bytes_.size());
    bytes_.replace(begin, end - begin, words[below(words.size())]);
  }

  std::string bytes_;
  std::mt19937_64& random_;
};

/// Reads a damaged file and returns "", or a description of what the reader did wrong.
using Judge = std::string (*)(const std::string& bytes, const std::string& name);

/// Returns the process's address space [bytes]. It allocates nothing, because a limit may already forbid that.
inline std::size_t address_space() {
  std::array<char, 64> text{};
  const int file = open("/proc/self/statm", O_RDONLY);
  REQUIRE(file >= 0);
  REQUIRE(read(file, text.data(), text.size() - 1) > 0);
  close(file);
  return std::strtoull(text.data(), nullptr, 10) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Runs the cases in this process, a child process of the test. Writes to `out` the number of each case and the error
/// of the first that fails. Never returns.
[[noreturn]] inline void run_cases(const Sample& sample, Judge judge, std::uint64_t seed, std::size_t cases, int out) {
  const auto say = [&](const std::string& text) {
    if (write(out, text.data(), text.size()) < 0) _exit(3);
  };
  // Signals of a reader must end this process, so Catch's handlers are removed.
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGBUS, SIGALRM}) std::signal(signal, SIG_DFL);
  if (limits_memory) {
    const std::size_t most = address_space() + most_memory + 2 * sample.bytes.size();
    const rlimit limit{most, most};
    setrlimit(RLIMIT_AS, &limit);
  }
  std::mt19937_64 random(seed);
  for (std::size_t i = 0; i < cases; ++i) {
    const std::string bytes = Mutator(sample.bytes, random).mutated();
    say("\n" + std::to_string(i) + " ");
    alarm(20);
    const std::string fault = judge(bytes, sample.name);
    if (fault.empty()) continue;
    say(fault);
    _exit(1);
  }
  _exit(0);
}

/// Runs the cases in a child process. Returns "" if every case passes, else the first case that failed and its error.
inline std::string failure(const Sample& sample, Judge judge, std::uint64_t seed, std::size_t cases) {
  std::array<int, 2> ends{};
  REQUIRE(pipe(ends.data()) == 0);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) run_cases(sample, judge, seed, cases, ends[1]);
  close(ends[1]);
  std::string last;
  std::array<char, 4096> buffer{};
  for (ssize_t got = 0; (got = read(ends[0], buffer.data(), buffer.size())) > 0;) {
    last.append(buffer.data(), static_cast<std::size_t>(got));
    last.erase(0, std::min(last.rfind('\n'), last.size()));
  }
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
  const std::string how = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status)) : "";
  last.erase(0, 1);
  return sample.name + ", seed " + std::to_string(seed) + ", case " + last + how;
}

/// Runs `read` and returns "" or a description of its fault (see Judge).
template <class Read>
std::string fault_of_reading(const std::string& name, Read read) {
  try {
    read();
  } catch (const compare::InputError& error) {
    const std::string text = error.what();
    if (text.find(name) == std::string::npos) return "is refused without its name: " + text;
    if (text.size() > 10'000) return "is refused with " + std::to_string(text.size()) + " bytes of text";
  } catch (const std::exception& error) {
    return std::string("ends in ") + error.what();
  }
  return "";
}

/// Checks `cases` (or OGC_FUZZ_CASES) damaged files of each sample; the sample itself must be readable.
inline void fuzz(const std::vector<Sample>& samples, Judge judge, std::uint64_t seed, std::size_t cases) {
  if (const char* given = std::getenv("OGC_FUZZ_CASES")) cases = std::strtoull(given, nullptr, 10);
  for (const Sample& sample : samples) {
    INFO(sample.name);
    REQUIRE(judge(sample.bytes, sample.name).empty());
    CHECK(failure(sample, judge, seed++, cases) == "");
  }
}

}  // namespace ogc::tests
