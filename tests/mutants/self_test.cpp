// Checks that processes end as tests/mutants/judge.cpp expects (tests/mutants.py --self-test) and prints what is wrong.
#include "tests/mutants/apart.hpp"

#include <chrono>
#include <cstdio>
#include <string>

namespace {

using namespace ogc::tests;

int wrong = 0;

void check(bool right, const char* what) {
  if (right) return;
  std::printf("work apart: %s\n", what);
  ++wrong;
}

std::string busy(double seconds) {
  const auto start = std::chrono::steady_clock::now();
  volatile double x = 0;
  while (seconds_since(start) < seconds) x = x + 1;
  return "done";
}

void check_endings() {
  const Ended said = apart(5, [] { return busy(0.1) + std::string(100000, '.'); });
  check(said.ending == Ending::says && said.said.size() == 100004, "what is said gets lost");
  check(said.seconds > 0.01 && said.seconds < 1, "its time is not that of the processor");
  const Ended late = apart(0.2, [] { return busy(60); });
  check(late.ending == Ending::late && late.seconds > 0.1, "what takes longer than it may is not late");
  check(apart(5, [] { return raise(SIGSEGV), std::string(); }).said == "signal 11", "a crash is not seen");
  check(apart(5, [] { return std::string(std::size_t{most_memory}, 'x'); }).ending == Ending::crashes,
        "memory has no limit");
  check(apart(5, [] { return std::exit(3), std::string(); }).said == "exit status 3", "an exit is not seen");
  const auto stand_still = [] { return alarm(1), pause(), std::string(); };
  check(apart(5, stand_still).ending == Ending::still, "standing still is not seen");
}

void check_parallel() {
  const auto squares = in_parallel(3, 50, [](std::size_t i) { return i == 7 ? "" : std::to_string(i * i); });
  for (std::size_t i = 0; i < 50; ++i)
    check(squares[i] == (i == 7 ? "" : std::to_string(i * i)), "answers are mixed up");
  int left = 5;
  const auto start = std::chrono::steady_clock::now();
  hand_out(
      1, 1000, [](std::size_t) { usleep(100000); }, [&] { return left-- > 0; });
  check(seconds_since(start) < 5, "work is handed out beyond the end");
}

}  // namespace

int main() {
  check_endings();
  check_parallel();
  return wrong;
}
