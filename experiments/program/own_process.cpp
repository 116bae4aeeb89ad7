#include "experiments/program/own_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <map>
#include <stdexcept>
#include <thread>

#include "experiments/program/interrupt.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/progress.hpp"

namespace ogc::experiments {

namespace {

int exit_status(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

}  // namespace

pid_t start_self(std::vector<std::string> words, const std::filesystem::path& log) {
  words.insert(words.begin(), "ogc");
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const int out = open("/dev/null", O_WRONLY | O_CLOEXEC),
            errors = log.empty() ? STDERR_FILENO : open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  const pid_t parent = getpid(), child = out < 0 || errors < 0 ? -1 : fork();
  if (child == 0) {
    // The child dies with its parent: a killed parent can't stop it, and two processes must not write into one folder.
    if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != parent) _exit(127);
    if (!log.empty()) setpgid(0, 0);
    if (dup2(out, STDOUT_FILENO) < 0 || dup2(errors, STDERR_FILENO) < 0) _exit(127);
    execv("/proc/self/exe", pointers.data());
    _exit(127);
  }
  if (out >= 0) close(out);
  if (errors >= 0 && !log.empty()) close(errors);
  if (child < 0)
    throw std::runtime_error("can't start another process of this program" +
                             (log.empty() ? std::string() : ", whose log is " + log.string()));
  return child;
}

int status_of(pid_t child) {
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {}
  return exit_status(status);
}

void run_side_by_side(const std::vector<OwnCommand>& commands, int jobs) {
  std::map<pid_t, const OwnCommand*> running;
  std::size_t next = 0;
  std::int64_t done = 0;
  Progress progress(0, static_cast<std::int64_t>(commands.size()), "run");
  bool were_told = false;
  while (!running.empty() || (next < commands.size() && !interrupted())) {
    while (next < commands.size() && running.size() < static_cast<std::size_t>(jobs) && !interrupted()) {
      const OwnCommand& command = commands[next++];
      progress.end();
      log_line(command.name);
      running.emplace(start_self(command.words, command.log), &command);
    }
    if (interrupted() && !were_told) {
      for (const auto& [child, command] : running) kill(child, SIGTERM);
      were_told = true;
    }
    int status = 0;
    const pid_t ended = waitpid(-1, &status, WNOHANG);
    const auto of = running.find(ended);
    if (of == running.end()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      continue;
    }
    if (exit_status(status) == 0) std::filesystem::remove(of->second->log);
    running.erase(of);
    progress.show(++done, "");
  }
}

}  // namespace ogc::experiments
