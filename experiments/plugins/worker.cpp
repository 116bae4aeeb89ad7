#include "experiments/plugins/worker.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "experiments/plugins/channel.hpp"
#include "experiments/plugins/memory.hpp"
#include "experiments/plugins/messages.hpp"

namespace ogc::experiments {

namespace {

struct Refusal : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Number of the process that was started. A copy forked by the plug-in has another number.
const pid_t worker = getpid();

/// Ends this process if it is a copy that the plug-in forked. The plug-in's function then returned in both processes,
/// and the parent answers the question.
void end_if_copy() {
  if (getpid() != worker) _exit(exit_success);
}

/// Closes the socket in processes that the plug-in forks or starts, so that they neither write to it nor keep it open.
void keep_from_children() {
  fcntl(worker_descriptor, F_SETFD, FD_CLOEXEC);
  pthread_atfork(nullptr, nullptr, [] { close(worker_descriptor); });
}

/// Makes this process, and all that the plug-in has started, end soon after `ogc` was killed. The end of the socket
/// would tell, but only between two questions; this also ends a plug-in that never returns. A signal at the parent's
/// end is no choice: it comes when the thread ends that started this process.
void end_with_parent() {
  std::thread([parent = getppid()] {
    while (getppid() == parent) std::this_thread::sleep_for(std::chrono::milliseconds(200));
    if (getpgrp() == getpid()) kill(0, SIGKILL);
    _exit(exit_check_failed);
  }).detach();
}

/// Holds the library, its stages, and the kind of memory that it requires.
class Library {
 public:
  explicit Library(const std::string& file) {
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    end_if_copy();
    if (!library) throw Refusal(std::string("it can't be loaded: ") + dlerror());
    const ogc_plugin_info* (*describe)() = nullptr;
    void* const symbol = dlsym(library, "ogc_plugin");
    if (!symbol)
      throw Refusal(
          "it has no function ogc_plugin, so it is no plug-in; write OGC_PLUGIN(\"name\", OGC_HOST_MEMORY) into it "
          "(compare/plugin.h)");
    std::memcpy(&describe, &symbol, sizeof symbol);
    const ogc_plugin_info* const info = describe();
    end_if_copy();
    if (!info) throw Refusal("ogc_plugin() returns a null pointer");
    if (info->version != OGC_PLUGIN_VERSION)
      throw Refusal("it was built for version " + std::to_string(info->version) +
                    " of compare/plugin.h, and this program takes version " + std::to_string(OGC_PLUGIN_VERSION) +
                    "; build it with this program's header");
    if (info->memory != OGC_HOST_MEMORY && info->memory != OGC_DEVICE_MEMORY)
      throw Refusal("it asks for memory " + std::to_string(info->memory) +
                    "; known: OGC_HOST_MEMORY (0), OGC_DEVICE_MEMORY (1)");
    name = info->name ? info->name : "";
    for (const PluginStage& stage : plugin_stages())
      functions.push_back(dlsym(library, ("ogc_" + std::string(stage.name)).c_str()));
    memory = info->memory == OGC_HOST_MEMORY ? host_memory() : device_memory();
  }

  std::string name;
  std::vector<void*> functions;  ///< by plugin_stages(); null if the library lacks the stage
  std::unique_ptr<PluginMemory> memory;
};

/// Answers one question: copies the arrays, calls the plug-in and collects the outputs.
class Call {
 public:
  Call(Library& library, const CallRequest& request, const std::vector<std::vector<std::byte>>& inputs)
      : library_(library),
        memory_(*library.memory),
        stage_(plugin_stages()[request.stage]),
        function_(library.functions[request.stage]),
        request_(request) {
    capacities_ = first_capacities(request.sizes);
    for (const auto& input : inputs) inputs_.push_back(memory_.input(input));
  }
  ~Call() {
    try {
      memory_.release();
    } catch (const std::runtime_error&) {  // a device that has failed, which was reported before
    }
  }
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  /// Calls the plug-in, a second time if a list was too short. Throws std::runtime_error that says what the plug-in did
  /// wrong.
  CallResult run() {
    CallResult result = attempt();
    if (!too_long(result)) return result;
    const ListSizes first = result.counts;
    for (std::size_t k = 0; k < list_count; ++k) capacities_[k] = std::max(capacities_[k], first[k]);
    result = attempt();
    if (const auto k = too_long(result))
      throw std::runtime_error("it found " + counted(first, *k) + ", and, given room for as many, " +
                               counted(result.counts, *k));
    return result;
  }

  std::vector<std::vector<std::byte>> outputs(const CallResult& result) {
    std::vector<std::vector<std::byte>> all;
    for (std::size_t k = 0; k < stage_.outputs.size(); ++k)
      all.push_back(memory_.content(
          first_ + k, group_bytes(stage_.outputs[k]) * groups(stage_.outputs[k], request_.sizes, result.counts)));
    return all;
  }

 private:
  CallResult attempt() {
    std::vector<void*> outputs;
    first_ += made_;
    made_ = stage_.outputs.size();
    for (const OutputInfo& info : stage_.outputs)
      outputs.push_back(
          memory_.output(group_bytes(info) * groups(info, request_.sizes, capacities_), bytes_of(info.element)));
    const CallArrays arrays{request_.sizes, inputs_, outputs, capacities_};
    memory_.synchronize();
    const auto start = std::chrono::steady_clock::now();
    const auto [status, counts] = call_plugin(stage_, function_, arrays);
    memory_.synchronize();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (status != 0)
      throw std::runtime_error("ogc_" + std::string(stage_.name) + " returned " + std::to_string(status) +
                               " instead of 0");
    check_guards();
    check_counts(counts);
    return {CallResult::Status::answered, counts, seconds};
  }

  /// Returns the index of the first list that exceeds its capacity.
  std::optional<std::size_t> too_long(const CallResult& result) const {
    for (std::size_t k = 0; k < list_count; ++k)
      if (result.counts[k] > capacities_[k]) return k;
    return std::nullopt;
  }

  static std::string counted(const ListSizes& counts, std::size_t k) {
    return std::to_string(counts[k]) + " " + std::string(list_name(static_cast<List>(k)));
  }

  void check_counts(const ListSizes& counts) const {
    const ListSizes most = most_entries(request_.sizes);
    for (std::size_t k = 0; k < list_count; ++k) {
      if (counts[k] < 0)
        throw std::runtime_error("it did not set the count of " + std::string(list_name(static_cast<List>(k))) +
                                 ", or to a negative number (" + std::to_string(counts[k]) + ")");
      if (counts[k] > most[k])
        throw std::runtime_error("it counted " + counted(counts, k) + ", at most " + std::to_string(most[k]) +
                                 " being possible");
    }
  }

  void check_guards() {
    for (std::size_t k = 0; k < stage_.outputs.size(); ++k) {
      const Damage damage = memory_.damage(first_ + k);
      if (damage == Damage::none) continue;
      throw std::runtime_error(
          "it wrote out of range: " +
          std::string(damage == Damage::before ? "before the beginning of `" : "behind the end of `") +
          std::string(stage_.outputs[k].name) + "`");
    }
  }

  Library& library_;
  PluginMemory& memory_;
  const PluginStage& stage_;
  void* function_;
  const CallRequest& request_;
  ListSizes capacities_{};
  std::vector<const void*> inputs_;
  std::size_t first_ = 0, made_ = 0;
};

bool sent(Channel& channel, Bytes block) { return channel.send(block) == Transfer::whole; }
bool sent_text(Channel& channel, const std::string& text) { return sent(channel, bytes_of(short_enough(text))); }

bool answer(Channel& channel, Library& library, const CallRequest& request,
            const std::vector<std::vector<std::byte>>& inputs) {
  CallResult result;
  std::vector<std::vector<std::byte>> outputs;
  std::string why;
  alarm(request.limit_seconds + 2);
  try {
    Call call(library, request, inputs);
    result = call.run();
    outputs = call.outputs(result);
  } catch (const std::exception& error) {
    result.status = library.memory->can_go_on() ? CallResult::Status::failed : CallResult::Status::broken;
    why = error.what();
  }
  end_if_copy();
  alarm(0);
  bool all = sent(channel, bytes_of_one(result)) && sent_text(channel, why);
  for (const auto& output : outputs) all = all && sent(channel, output);
  return all;
}

/// Reads a question; returns nothing if `ogc` has closed the socket. Throws MalformedBlock if bytes are missing because
/// the plug-in itself has read from the socket.
std::optional<std::pair<CallRequest, std::vector<std::vector<std::byte>>>> next_question(Channel& channel) {
  std::vector<std::byte> block;
  CallRequest request;
  if (channel.receive(block, exactly(sizeof request)) != Transfer::whole) return std::nullopt;
  std::memcpy(&request, block.data(), sizeof request);
  if (request.stage >= plugin_stages().size()) throw MalformedBlock("asks for a stage that there is not");
  std::vector<std::vector<std::byte>> inputs(plugin_stages()[request.stage].inputs);
  for (auto& input : inputs)
    if (channel.receive(input, {}) != Transfer::whole) return std::nullopt;
  return std::pair(request, std::move(inputs));
}

/// Answers questions until `ogc` closes the socket.
void serve(Channel& channel, Library& library) {
  try {
    while (const auto question = next_question(channel))
      if (!answer(channel, library, question->first, question->second)) _exit(worker_lost_socket);
  } catch (const MalformedBlock&) {
    _exit(worker_lost_socket);
  }
}

bool greet(Channel& channel, LoadStatus status, const std::string& text) {
  return sent(channel, bytes_of_one(status)) && sent_text(channel, text);
}

int work(const std::string& file) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  dup2(STDERR_FILENO, STDOUT_FILENO);  // the plug-in's output must not appear in a result
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
  keep_from_children();
  end_with_parent();
  Channel channel(worker_descriptor);
  std::unique_ptr<Library> library;
  try {
    library = std::make_unique<Library>(file);
  } catch (const Refusal& refusal) {
    greet(channel, LoadStatus::refused, refusal.what());
    return exit_bad_input;
  } catch (const std::exception& error) {
    greet(channel, LoadStatus::failed, error.what());
    return exit_out_of_resource;
  }
  std::vector<std::uint8_t> has;
  for (const void* function : library->functions) has.push_back(function != nullptr);
  if (greet(channel, LoadStatus::loaded, library->name) && sent(channel, bytes_of(has))) serve(channel, *library);
  // Ends the processes that the plug-in has started; does not wait for them.
  signal(SIGTERM, SIG_IGN);
  if (getpgrp() == getpid()) kill(0, SIGTERM);
  // Skips the library's destructors: all answers are sent, so a failure in a destructor does not matter.
  _exit(exit_success);
}

}  // namespace

void add_plugin_worker_command(CLI::App& app, CommandContext& context) {
  auto file = std::make_shared<std::string>();
  CLI::App* command =
      app.add_subcommand("plugin-worker", "Answers `ogc compare --plugin`; not to be called by hand")->group("");
  command->add_option("FILE", *file, "The shared library")->required();
  command->callback([file, &context] { context.status = work(*file); });
}

}  // namespace ogc::experiments
