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
#include <cstring>
#include <thread>

#include "compare/problem/contestant.hpp"
#include "compare/problem/error.hpp"
#include "experiments/plugins/memory.hpp"

extern char** environ;

namespace ogc::experiments {

namespace {

using compare::ContestantFailure;

/// Least time limit after a hang.
constexpr unsigned least_limit = 1;

constexpr const char* lost_socket = "it closed the worker's socket, which is not its own";

std::string in_seconds(unsigned seconds) { return std::to_string(seconds) + (seconds == 1 ? " second" : " seconds"); }

/// Starts `program plugin-worker file` with one end of a socket as worker_descriptor; returns the process and the other end.
pid_t spawn(const PluginOptions& options, Channel& channel) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) throw compare::ResourceError("plug-in: no socket: " + std::string(std::strerror(errno)));
  channel = Channel(ends[0]);
  const Channel other(ends[1]);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  // dup2 onto itself would leave the descriptor to be closed.
  const int above = fcntl(ends[1], F_DUPFD_CLOEXEC, worker_descriptor + 1);
  posix_spawn_file_actions_adddup2(&actions, above, worker_descriptor);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);  // with what it starts, it is ended together
  std::string program = options.program.string(), command = "plugin-worker", file = options.file.string();
  char* const words[] = {program.data(), command.data(), file.data(), nullptr};
  pid_t process = -1;
  const int error = posix_spawn(&process, program.c_str(), &actions, &attributes, words, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(above);
  if (error != 0) throw compare::ResourceError("plug-in: no process: " + std::string(std::strerror(error)));
  return process;
}

/// Waits a second at most for a process whose socket is closed.
bool ended_by_itself(pid_t process, int& status) {
  for (int i = 0; i < 100; ++i) {
    if (waitpid(process, &status, WNOHANG) == process) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace

PluginProcess::PluginProcess(PluginOptions options) : options_(std::move(options)), limit_seconds_(options_.limit_seconds) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(options_.file, error))
    throw compare::InputError(options_.file.string() + ": there is no such file; give the shared library that holds your kernels");
  options_.file = std::filesystem::absolute(options_.file);  // dlopen looks elsewhere for a bare name
  start();
}

bool PluginProcess::has(std::string_view stage) const {
  const auto at = find_plugin_stage(stage);
  return at && has_[*at] != 0;
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

PluginProcess::Answer PluginProcess::ask(std::string_view stage_name, const QuestionSizes& sizes, std::span<const Bytes> inputs) {
  if (!channel_.is_open()) start();
  const std::size_t number = find_plugin_stage(stage_name).value();
  const PluginStage& stage = plugin_stages()[number];
  const CallRequest request{number, sizes, limit_seconds_};
  bool sent = channel_.send(bytes_of_one(request));
  for (const Bytes& input : inputs) sent = sent && channel_.send(input);
  if (!sent) throw ContestantFailure(ending(Received::end));
  CallResult result;
  const std::vector<std::byte> block = receive();
  std::memcpy(&result, block.data(), sizeof result);
  const std::string why = text_of(receive());
  if (result.status == CallResult::Status::broken) stop();
  if (result.status != CallResult::Status::answered) throw ContestantFailure(why);
  Answer answer;
  answer.counts = result.counts;
  for (std::size_t k = 0; k < stage.outputs.size(); ++k) answer.outputs.push_back(receive());
  seconds_[std::string(stage_name)] += result.seconds;
  note(stage, answer);
  return answer;
}

void PluginProcess::start() {
  stop();
  process_ = spawn(options_, channel_);
  LoadStatus status{};
  const std::vector<std::byte> block = receive();
  std::memcpy(&status, block.data(), sizeof status);
  const std::string text = text_of(receive());
  if (status == LoadStatus::refused) throw compare::InputError(options_.file.string() + ": " + text);
  if (status == LoadStatus::failed) throw compare::ResourceError(options_.file.string() + ": " + text);
  name_ = text;
  const std::vector<std::byte> has = receive();
  has_.assign(reinterpret_cast<const std::uint8_t*>(has.data()), reinterpret_cast<const std::uint8_t*>(has.data()) + has.size());
}

std::vector<std::byte> PluginProcess::receive() {
  std::vector<std::byte> block;
  const Received received = channel_.receive(block, limit_seconds_);
  if (received != Received::block) throw ContestantFailure(ending(received));
  return block;
}

std::string PluginProcess::ending(Received received) {
  if (received == Received::timeout) {
    stop();
    const std::string text = "it hangs: no answer within " + in_seconds(limit_seconds_);
    limit_seconds_ = std::max(least_limit, options_.limit_seconds / 10);
    return text;
  }
  int status = 0;
  channel_.close();
  if (!ended_by_itself(process_, status)) {
    stop();
    return lost_socket;
  }
  process_ = -1;
  if (WIFEXITED(status) && WEXITSTATUS(status) == worker_lost_socket) return lost_socket;
  if (WIFSIGNALED(status)) return "it crashed: signal " + std::to_string(WTERMSIG(status)) + ", " + strsignal(WTERMSIG(status));
  return "it ended the process, exit status " + std::to_string(WEXITSTATUS(status));
}

void PluginProcess::stop() {
  channel_.close();
  if (process_ < 0) return;
  kill(-process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  process_ = -1;
}

void PluginProcess::note(const PluginStage& stage, const Answer& answer) {
  for (std::size_t k = 0; k < stage.outputs.size(); ++k) {
    const OutputInfo& info = stage.outputs[k];
    std::uint64_t unwritten = 0, not_a_number = 0;
    if (info.element == Element::byte) {
      unwritten = static_cast<std::uint64_t>(std::count(answer.outputs[k].begin(), answer.outputs[k].end(), std::byte{unwritten_byte}));
    } else {
      std::vector<std::uint32_t> words(answer.outputs[k].size() / 4);
      std::memcpy(words.data(), answer.outputs[k].data(), 4 * words.size());
      unwritten = static_cast<std::uint64_t>(std::count(words.begin(), words.end(), unwritten_word));
      if (info.element == Element::number)
        not_a_number = static_cast<std::uint64_t>(std::count_if(words.begin(), words.end(), [](std::uint32_t w) { return std::isnan(std::bit_cast<float>(w)); })) - unwritten;
    }
    const std::string name = std::string(stage.name) + "." + std::string(info.name);
    if (unwritten > 0 && info.list != List::none)
      throw ContestantFailure("it counted " + std::to_string(answer.counts[static_cast<std::size_t>(info.list)]) + " " + std::string(list_name(info.list)) +
                              ", and did not write all of them" + " (`" + std::string(info.name) + "`)");
    if (unwritten > 0) notes_.unwritten[name] += unwritten;
    if (not_a_number > 0) notes_.not_a_number[name] += not_a_number;
  }
}

}  // namespace ogc::experiments
