// Declares the process in which a plug-in runs: `ogc plugin-worker FILE`, which only PluginProcess starts. The process
// loads the library, reports the result, and answers questions until PluginProcess closes the socket. A failure of the
// library affects this process alone.
#pragma once

#include <array>
#include <cstdint>

#include "experiments/plugins/stages.hpp"
#include "experiments/program/commands.hpp"

namespace ogc::experiments {

/// The socket's descriptor in the worker.
inline constexpr int worker_descriptor = 3;

/// Result of loading a library.
enum class LoadStatus : std::uint8_t {
  /// followed by a block with the plug-in's name, and a block with one byte for each of plugin_stages(): 1 if the
  /// library has this stage
  loaded,
  refused,  ///< wrong file, version or memory; followed by a block with the reason
  failed,   ///< missing device; followed by a block with the reason
};

/// Holds the result of a call. It is followed by a block of text (why the call failed) and, if it was answered, the
/// outputs.
struct CallResult {
  /// broken: the next question needs a new process
  enum class Status : std::uint8_t { answered, failed, broken } status = Status::answered;
  ListSizes counts{1};  ///< number of entries of each list
  double seconds = 0;   ///< time of the plug-in's function, including the device's work
};

/// Holds the beginning of a question. The arrays of the question follow it.
struct CallRequest {
  std::uint64_t stage = 0;  ///< position in plugin_stages()
  QuestionSizes sizes;
  unsigned limit_seconds = 0;  ///< the worker ends itself soon after this time, in case no process is left to end it
};

/// Exit status of a worker that could not send its answer.
inline constexpr int worker_lost_socket = 70;

/// Adds the hidden subcommand plugin-worker.
void add_plugin_worker_command(CLI::App& app, CommandContext& context);

}  // namespace ogc::experiments
