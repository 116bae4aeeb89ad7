// Drives a plug-in from the outside: starts its worker process, asks it, times it, ends it, and starts it again after
// it broke.
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

/// Options of a plug-in's process.
struct PluginOptions {
  std::filesystem::path file;                        ///< the shared library
  std::filesystem::path program = "/proc/self/exe";  ///< `ogc`, which is the worker, too
  unsigned limit_seconds = 10;                       ///< for each call, and for loading
};

/// Observations that are no failure of the process, but are reported at the end: for each output, how many elements
/// were NaN, or were never written.
struct PluginNotes {
  /// number of elements by output
  std::map<std::string, std::uint64_t, std::less<>> not_a_number, unwritten;
};

/// Runs a plug-in in a process of its own, which is started again after it breaks.
class PluginProcess {
 public:
  /// Loads the library. Throws InputError if there is no such file, it can't be loaded, is no plug-in or of another
  /// version, ResourceError if the device that it asks for is missing, and ContestantFailure if it crashed or hung
  /// while it was loaded.
  explicit PluginProcess(PluginOptions options);
  ~PluginProcess() { stop(); }
  PluginProcess(const PluginProcess&) = delete;
  PluginProcess& operator=(const PluginProcess&) = delete;

  /// Returns the plug-in's own name.
  const std::string& name() const { return name_; }
  /// Returns whether it answers this stage.
  bool has(std::string_view stage) const;
  /// Returns the stages that it offers, separated by commas.
  std::string offered() const;

  /// A plug-in's answer.
  struct Answer {
    std::vector<std::vector<std::byte>> outputs;  ///< by output of the stage, in its order
    ListSizes counts{};                           ///< entries of each list
  };
  /// Asks the plug-in. Throws ContestantFailure, which says what the plug-in did instead, if there is no answer.
  Answer ask(std::string_view stage, const QuestionSizes& sizes, std::span<const Bytes> inputs);

  /// Returns the time in the plug-in's functions, by stage [s].
  double seconds(std::string_view stage) const;
  const PluginNotes& notes() const { return notes_; }

 private:
  void start();
  void stop();
  /// Ends the process; returns how it ended by itself, or that it had to be ended.
  std::string ending(Transfer how);
  /// Sends a block or throws ContestantFailure.
  void send(Bytes block);
  /// Returns what `read` makes of the blocks that come; throws ContestantFailure if none come, or wrong ones.
  template <class Read>
  auto received(Read read);
  Patience patience() const;
  void note(const PluginStage& stage, const Answer& answer);

  PluginOptions options_;
  unsigned limit_seconds_;  ///< shorter after a hang: the search for the case that hangs waits many times
  pid_t process_ = -1;
  Channel channel_;
  std::string name_;
  std::vector<std::uint8_t> has_;
  std::map<std::string, double, std::less<>> seconds_;
  PluginNotes notes_;
};

}  // namespace ogc::experiments
