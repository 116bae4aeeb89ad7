#include "experiments/bench/processes.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "compare/files/bytes.hpp"
#include "experiments/bench/results.hpp"

namespace ogc::experiments {

namespace {

/// Runs this program; what it prints as its result is dropped, what it logs is shown.
int run_self(std::vector<std::string> words) {
  words.insert(words.begin(), "ogc");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failed = posix_spawn(&child, "/proc/self/exe", &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) throw std::runtime_error("can't start a process for a benchmark");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

void bench_in_processes(const std::vector<std::string>& arguments, int count, const std::filesystem::path& file) {
  const std::filesystem::path part = file.string() + ".part";
  Json all;
  for (int k = 0; k < count; ++k) {
    log_line("process " + std::to_string(k + 1) + " of " + std::to_string(count));
    std::vector<std::string> words = arguments;
    words.insert(words.end(), {"--json", part.string()});
    if (const int status = run_self(words); status != 0)
      throw std::runtime_error("process " + std::to_string(k + 1) + " ended with status " + std::to_string(status));
    Json one = parse_results(part);
    std::filesystem::remove(part);
    for (Json& run : one.at("benchmarks")) run["process"] = k;
    if (all.is_null()) {
      all = std::move(one);
      continue;
    }
    for (Json& run : one.at("benchmarks")) all.at("benchmarks").push_back(std::move(run));
  }
  compare::write_bytes(file, all.dump(1) + "\n");
}

}  // namespace ogc::experiments
