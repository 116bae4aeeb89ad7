// A plug-in from the outside: its worker process, started, asked, timed, ended, and started again after it broke.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <sys/types.h>

#include "experiments/plugins/channel.hpp"
#include "experiments/plugins/messages.hpp"
#include "experiments/plugins/worker.hpp"

namespace ogc::experiments {

/// How a plug-in is asked.
struct PluginOptions {
  std::filesystem::path file;                        ///< the shared library
  std::filesystem::path program = "/proc/self/exe";  ///< `ogc`, which is the worker, too
  unsigned limit_seconds = 10;                       ///< for each call, and for loading
};

/// What is no failure of the process, but worth saying at the end: by output, how many elements were no number, or were
/// never written.
struct PluginNotes {
  /// by output: elements
  std::map<std::string, std::uint64_t, std::less<>> not_a_number, unwritten;
};

/// A plug-in in a process of its own, which is started again where it breaks.
class PluginProcess {
 public:
  /// Loads the library. Throws InputError where there is no such file, it can't be loaded, is no plug-in or of another
  /// version, ResourceError where the device that it asks for is missing, and ContestantFailure where it crashed or
  /// hung while it was loaded.
  explicit PluginProcess(PluginOptions options);
  ~PluginProcess() { stop(); }
  PluginProcess(const PluginProcess&) = delete;
  PluginProcess& operator=(const PluginProcess&) = delete;

  /// What the plug-in calls itself.
  const std::string& name() const { return name_; }
  /// Whether it answers this stage.
  bool has(std::string_view stage) const;
  /// The stages that it offers, separated by commas.
  std::string offered() const;

  /// What a plug-in answered.
  struct Answer {
    std::vector<std::vector<std::byte>> outputs;  ///< of the stage, in its order
    ListSizes counts{};                           ///< entries of each list
  };
  /// Throws ContestantFailure where there is no answer: what the plug-in did instead.
  Answer ask(std::string_view stage, const QuestionSizes& sizes, std::span<const Bytes> inputs);

  /// Time in the plug-in's functions, by stage [s].
  double seconds(std::string_view stage) const;
  const PluginNotes& notes() const { return notes_; }

 private:
  void start();
  void stop();
  /// Ends the process and says how it ended by itself, or that it had to be ended.
  std::string ending(Transfer how);
  /// Sends a block or throws ContestantFailure.
  void send(Bytes block);
  /// What `read` makes of the blocks that come; ContestantFailure where none come, or wrong ones.
  template <class Read>
  auto received(Read read);
  Patience patience() const;
  void note(const PluginStage& stage, const Answer& answer);

  PluginOptions options_;
  unsigned limit_seconds_;  ///< shorter once it hung: who looks for the case that hangs must wait many times
  pid_t process_ = -1;
  Channel channel_;
  std::string name_;
  std::vector<std::uint8_t> has_;
  std::map<std::string, double, std::less<>> seconds_;
  PluginNotes notes_;
};

}  // namespace ogc::experiments
