#include "experiments/plugins/process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <utility>

#include "compare/contestant.hpp"
#include "compare/problem/error.hpp"
#include "experiments/plugins/memory.hpp"
#include "experiments/plugins/table.hpp"

extern char** environ;

namespace ogc::experiments {

namespace {

using compare::ContestantFailure;

/// Least time limit after a hang [s].
constexpr unsigned least_limit = 1;

constexpr const char* lost_socket =
    "it closed the worker's socket, or read what was for the worker; the socket is not its own";

std::string in_seconds(unsigned seconds) { return std::to_string(seconds) + (seconds == 1 ? " second" : " seconds"); }

bool is_python(const std::filesystem::path& file) { return file.extension() == ".py"; }

/// Returns the words of the worker's command.
std::vector<std::string> command_of(const PluginOptions& options) {
  if (!is_python(options.file)) return {options.program.string(), "plugin-worker", options.file.string()};
  const char* const interpreter = std::getenv("OGC_PYTHON");
  return {interpreter && *interpreter ? interpreter : "python3", "-c", python_worker(), options.file.string()};
}

/// Starts the worker with one end of a socket as its descriptor worker_descriptor. Sets `channel` to the other end.
/// Returns the process.
pid_t spawn(const PluginOptions& options, Channel& channel) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw compare::ResourceError("plug-in: no socket: " + std::string(std::strerror(errno)));
  channel = Channel(ends[0]);
  const Channel other(ends[1]);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  // dup2 of a descriptor onto itself would keep its close-on-exec flag, so the descriptor is copied first.
  const int above = fcntl(ends[1], F_DUPFD_CLOEXEC, worker_descriptor + 1);
  posix_spawn_file_actions_adddup2(&actions, above, worker_descriptor);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  // The process gets a group of its own, so that it and all processes that it starts can be ended together.
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::vector<std::string> command = command_of(options);
  std::vector<char*> words;
  for (std::string& word : command) words.push_back(word.data());
  words.push_back(nullptr);
  pid_t process = -1;
  const int error = posix_spawnp(&process, words[0], &actions, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(above);
  if (error != 0 && is_python(options.file))
    throw compare::InputError(options.file.string() + ": the interpreter " + command[0] + " can't be started: " +
                              std::strerror(error) + "; name one with NumPy by the environment's OGC_PYTHON");
  if (error != 0) throw compare::ResourceError("plug-in: no process: " + std::string(std::strerror(error)));
  return process;
}

/// Returns whether the process is still running. An ended process stays a zombie for waitpid.
bool runs(pid_t process) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(process), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
}

/// Waits at most a second for a process whose socket is closed; returns whether it ended.
bool ended_by_itself(pid_t process) {
  for (int i = 0; i < 100 && runs(process); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return !runs(process);
}

/// Kills the process and all processes that it started, unless they have left its group. Returns its status.
int end_group(pid_t process) {
  // The signal precedes waitpid, after which the number may belong to another process.
  kill(-process, SIGKILL);
  int status = 0;
  waitpid(process, &status, 0);
  return status;
}

}  // namespace

PluginProcess::PluginProcess(PluginOptions options)
    : options_(std::move(options)), limit_seconds_(options_.limit_seconds) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(options_.file, error))
    throw compare::InputError(
        options_.file.string() +
        ": there is no such file; give the shared library or the Python file that holds your kernels");
  options_.file = std::filesystem::absolute(options_.file);  // dlopen searches elsewhere for a bare name
  start();
}

Patience PluginProcess::patience() const {
  // Loading keeps its limit after a hang: an interpreter with its packages takes longer than a call.
  const unsigned limit = is_loaded_ ? limit_seconds_ : options_.limit_seconds;
  return {static_cast<double>(limit), [process = process_] { return runs(process); }};
}

void PluginProcess::send(Bytes block) {
  if (const Transfer sent = channel_.send(block, patience()); sent != Transfer::whole)
    throw ContestantFailure(ending(sent));
}

template <class Read>
auto PluginProcess::received(Read read) {
  try {
    return read([this](BlockLength allowed) {
      std::vector<std::byte> block;
      if (const Transfer got = channel_.receive(block, allowed, patience()); got != Transfer::whole)
        throw ContestantFailure(ending(got));
      return block;
    });
  } catch (const ImpossibleCount& wrong) {
    stop();
    throw ContestantFailure("it " + std::string(wrong.what()));
  } catch (const MalformedBlock& wrong) {
    stop();
    throw ContestantFailure("its worker sent a message that " + std::string(wrong.what()) +
                            ": it wrote into the worker's socket, descriptor " + std::to_string(worker_descriptor) +
                            ", which is not its own");
  }
}

bool PluginProcess::has(std::string_view stage) const {
  const auto at = find_plugin_stage(stage);
  return at && has_[*at] != 0;
}

std::string PluginProcess::missing(std::string_view stage) const {
  const std::string what = is_python(options_.file) ? "kernel of " : "function ogc_";
  return "it has no " + what + std::string(stage) + "; its stages: " + offered();
}

std::string PluginProcess::offered() const {
  std::string text;
  for (const PluginStage& stage : plugin_stages())
    if (has(stage.name)) text += (text.empty() ? "" : ", ") + std::string(stage.name);
  return text;
}

double PluginProcess::seconds(std::string_view stage) const {
  const auto at = seconds_.find(stage);
  return at == seconds_.end() ? 0 : at->second;
}

PluginProcess::Answer PluginProcess::ask(std::string_view stage_name, const QuestionSizes& sizes,
                                         std::span<const Bytes> inputs) {
  if (!channel_.is_open()) start();
  const std::size_t number = find_plugin_stage(stage_name).value();
  const PluginStage& stage = plugin_stages()[number];
  const CallRequest request{number, sizes, limit_seconds_};
  send(bytes_of_one(request));
  for (const Bytes& input : inputs) send(input);
  WorkerAnswer said = received([&](const NextBlock& next) { return read_answer(next, stage, sizes); });
  if (said.result.status == CallResult::Status::broken) stop();
  if (said.result.status != CallResult::Status::answered) throw ContestantFailure(said.why);
  Answer answer{std::move(said.outputs), said.result.counts};
  seconds_[std::string(stage_name)] += said.result.seconds;
  note(stage, answer);
  return answer;
}

void PluginProcess::start() {
  stop();
  is_loaded_ = false;
  process_ = spawn(options_, channel_);
  if (is_python(options_.file)) {
    const std::string layout = python_layout();
    send(bytes_of(layout));
  }
  const Greeting greeting = received(read_greeting);
  if (greeting.status == LoadStatus::refused) throw compare::InputError(options_.file.string() + ": " + greeting.text);
  if (greeting.status == LoadStatus::failed)
    throw compare::ResourceError(options_.file.string() + ": " + greeting.text);
  name_ = greeting.text;
  has_ = greeting.has;
  is_loaded_ = true;
}

std::string PluginProcess::ending(Transfer how) {
  if (how == Transfer::timeout) {
    stop();
    const std::string text = "it hangs: no answer within " +
                             in_seconds(is_loaded_ ? limit_seconds_ : options_.limit_seconds);
    limit_seconds_ = std::max(least_limit, options_.limit_seconds / 10);
    return text;
  }
  channel_.close();
  const bool by_itself = ended_by_itself(process_);
  const int status = end_group(std::exchange(process_, -1));
  if (!by_itself) return lost_socket;
  if (WIFEXITED(status) && WEXITSTATUS(status) == worker_lost_socket) return lost_socket;
  if (WIFSIGNALED(status))
    return "it crashed: signal " + std::to_string(WTERMSIG(status)) + ", " + strsignal(WTERMSIG(status));
  return "it ended the process, exit status " + std::to_string(WEXITSTATUS(status));
}

void PluginProcess::stop() {
  channel_.close();
  if (process_ >= 0) end_group(std::exchange(process_, -1));
}

void PluginProcess::note(const PluginStage& stage, const Answer& answer) {
  for (std::size_t k = 0; k < stage.outputs.size(); ++k) {
    const OutputInfo& info = stage.outputs[k];
    std::uint64_t unwritten = 0, not_a_number = 0;
    if (info.element == Element::byte) {
      unwritten = static_cast<std::uint64_t>(
          std::count(answer.outputs[k].begin(), answer.outputs[k].end(), std::byte{unwritten_byte}));
    } else {
      std::vector<std::uint32_t> words(answer.outputs[k].size() / 4);
      std::memcpy(words.data(), answer.outputs[k].data(), 4 * words.size());
      unwritten = static_cast<std::uint64_t>(std::count(words.begin(), words.end(), unwritten_word));
      if (info.element == Element::number)
        not_a_number = static_cast<std::uint64_t>(
                           std::count_if(words.begin(), words.end(),
                                         [](std::uint32_t w) { return std::isnan(std::bit_cast<float>(w)); })) -
                       unwritten;
    }
    const std::string name = std::string(stage.name) + "." + std::string(info.name);
    if (unwritten > 0 && info.list != List::none)
      throw ContestantFailure("it counted " + std::to_string(answer.counts[static_cast<std::size_t>(info.list)]) + " " +
                              std::string(list_name(info.list)) + ", and did not write all of them" + " (`" +
                              std::string(info.name) + "`)");
    if (unwritten > 0) notes_.unwritten[name] += unwritten;
    if (not_a_number > 0) notes_.not_a_number[name] += not_a_number;
  }
}

}  // namespace ogc::experiments
