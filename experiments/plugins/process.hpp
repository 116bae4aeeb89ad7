// Controls a plug-in from outside its process: starts the worker, sends it questions, measures and limits its time,
// ends it, and restarts it after a failure.
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
  /// the shared library, or a Python file: the interpreter is `OGC_PYTHON` of the environment, else python3
  std::filesystem::path file;
  std::filesystem::path program = "/proc/self/exe";  ///< the program `ogc`, which also contains the worker
  unsigned limit_seconds = 10;                       ///< limit for each call and for loading
};

/// Holds unusual outputs that are reported but are no failures: for each output, how many elements were NaN and how
/// many were never written.
struct PluginNotes {
  /// number of elements by name of the output
  std::map<std::string, std::uint64_t, std::less<>> not_a_number, unwritten;
};

/// Runs a plug-in in a separate process, which is restarted after a failure.
class PluginProcess {
 public:
  /// Loads the library. Throws InputError if the file does not exist, can't be loaded, is no plug-in, or has another
  /// version. Throws ResourceError if the required device is missing, and ContestantFailure if loading crashed or hung.
  explicit PluginProcess(PluginOptions options);
  ~PluginProcess() { stop(); }
  PluginProcess(const PluginProcess&) = delete;
  PluginProcess& operator=(const PluginProcess&) = delete;

  /// Returns the name that the plug-in gives itself.
  const std::string& name() const { return name_; }
  /// Returns whether the plug-in has this stage.
  bool has(std::string_view stage) const;
  /// Returns a sentence: the plug-in lacks this stage, and which stages it has.
  std::string missing(std::string_view stage) const;
  /// Returns the plug-in's stages, separated by commas.
  std::string offered() const;

  /// Holds a plug-in's answer.
  struct Answer {
    std::vector<std::vector<std::byte>> outputs;  ///< outputs of the stage, in its order
    ListSizes counts{};                           ///< number of entries of each list
  };
  /// Puts a question to the plug-in. Throws ContestantFailure, which describes what the plug-in did, if there is no
  /// answer.
  Answer ask(std::string_view stage, const QuestionSizes& sizes, std::span<const Bytes> inputs);

  /// Returns the time spent in the plug-in's function for this stage [s].
  double seconds(std::string_view stage) const;
  const PluginNotes& notes() const { return notes_; }

 private:
  void start();
  void stop();
  /// Ends the process; returns how it ended, or that it had to be killed.
  std::string ending(Transfer how);
  /// Sends a block; throws ContestantFailure on failure.
  void send(Bytes block);
  /// Returns the result of `read` for the blocks that arrive. Throws ContestantFailure if none arrive or if they are
  /// wrong.
  template <class Read>
  auto received(Read read);
  Patience patience() const;
  void note(const PluginStage& stage, const Answer& answer);

  PluginOptions options_;
  /// shortened after a hang, because the search for the hanging case runs into the limit many times
  unsigned limit_seconds_;
  bool is_loaded_ = false;  ///< the process has sent its greeting
  pid_t process_ = -1;
  Channel channel_;
  std::string name_;
  std::vector<std::uint8_t> has_;
  std::map<std::string, double, std::less<>> seconds_;
  PluginNotes notes_;
};

}  // namespace ogc::experiments
