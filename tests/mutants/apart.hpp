// Runs work in separate processes and reports what each one writes, its processor time, and how it ends if it fails.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

namespace ogc::tests {

/// How a process ended. `late`: it took more processor time than its limit; `still`: it hardly used the processor.
enum class Ending { says, crashes, late, still };

struct Ended {
  Ending ending = Ending::says;
  std::string said;    ///< what the work wrote, or how it crashed
  double seconds = 0;  ///< processor time
};

inline constexpr rlim_t most_memory = rlim_t{6} << 30;  ///< limit of one process [bytes]; an allocation beyond it fails

/// Returns the wall-clock seconds after which a process with this limit of processor time counts as `still`, on a
/// machine that has other work as well.
inline unsigned clock_limit(double seconds) { return static_cast<unsigned>(std::ceil(10 + 5 * seconds)); }

inline void write_all(int file, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t written = write(file, text.data() + at, text.size() - at);
    if (written < 0) _exit(4);
    at += static_cast<std::size_t>(written);
  }
}

inline void limit_this_process(double seconds) {
  const rlimit memory{most_memory, most_memory}, none{0, 0};
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CORE, &none);
  const double whole = std::floor(seconds);
  const timeval time{static_cast<time_t>(whole), static_cast<suseconds_t>(1e6 * (seconds - whole))};
  const itimerval timer{{}, time};
  setitimer(ITIMER_PROF, &timer, nullptr);
  alarm(clock_limit(seconds));
}

/// Runs `work` in its own process, limited to `seconds` > 0 of processor time, and returns its text and how it ended.
template <class Work>
Ended apart(double seconds, Work work) {
  int ends[2];
  if (pipe(ends) != 0) return {Ending::crashes, "no pipe", 0};
  const pid_t child = fork();
  if (child < 0) return {Ending::crashes, "no process", 0};
  if (child == 0) {
    close(ends[0]);
    limit_this_process(seconds);
    write_all(ends[1], work());
    _exit(0);
  }
  close(ends[1]);
  Ended ended;
  char buffer[4096];
  for (ssize_t got = 0; (got = read(ends[0], buffer, sizeof buffer)) > 0;)
    ended.said.append(buffer, static_cast<std::size_t>(got));
  close(ends[0]);
  int status = 0;
  rusage used{};
  wait4(child, &status, 0, &used);
  for (const timeval& time : {used.ru_utime, used.ru_stime})
    ended.seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  const int sent = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (sent == SIGPROF)
    ended.ending = Ending::late;
  else if (sent == SIGALRM)
    ended.ending = Ending::still;
  else if (sent != 0)
    ended = {Ending::crashes, "signal " + std::to_string(sent), ended.seconds};
  else if (WEXITSTATUS(status) != 0)
    ended = {Ending::crashes, "exit status " + std::to_string(WEXITSTATUS(status)), ended.seconds};
  return ended;
}

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Runs work(0) … work(count - 1) in `processes` processes. Each takes the next number when it has finished one, until
/// `may_go_on` returns false.
template <class Work, class MayGoOn>
void hand_out(std::size_t processes, std::size_t count, Work work, MayGoOn may_go_on) {
  using Number = std::atomic<std::size_t>;
  void* shared = mmap(nullptr, sizeof(Number), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) std::abort();
  auto* next = new (shared) Number(0);
  std::vector<pid_t> children;
  for (std::size_t k = 0; k < processes; ++k) {
    children.push_back(fork());
    if (children.back() != 0) continue;
    for (std::size_t i = 0; may_go_on() && (i = (*next)++) < count;) work(i);
    _exit(0);
  }
  for (const pid_t child : children) waitpid(child, nullptr, 0);
  munmap(shared, sizeof(Number));
}

/// Returns the text of work(i), one line without its end, for each i, computed in `processes` processes. It is empty
/// where a process broke.
template <class Work>
std::vector<std::string> in_parallel(std::size_t processes, std::size_t count, Work work) {
  std::FILE* file = std::tmpfile();
  if (file == nullptr) std::abort();
  fcntl(fileno(file), F_SETFL, O_APPEND);
  const auto noted = [&](std::size_t i) { write_all(fileno(file), std::to_string(i) + ' ' + work(i) + '\n'); };
  hand_out(processes, count, noted, [] { return true; });
  std::rewind(file);
  std::vector<std::string> said(count);
  std::size_t i = 0;
  while (std::fscanf(file, "%zu%*c", &i) == 1 && i < count)
    for (int c = 0; (c = std::fgetc(file)) != EOF && c != '\n';) said[i] += static_cast<char>(c);
  std::fclose(file);
  return said;
}

}  // namespace ogc::tests
