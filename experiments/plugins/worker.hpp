// Declares the process in which a plug-in lives: `ogc plugin-worker FILE`, which only PluginProcess starts. It loads
// the library, reports what it found, and answers questions until the other side closes the socket. What the library
// breaks, it breaks here.
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
  loaded,  ///< a block with the name follows, then one with a byte for each of plugin_stages(): 1 if the library has it
  refused,  ///< wrong file, version or memory; a block with the reason follows
  failed,   ///< missing device; a block with the reason follows
};

/// Result of a call. A block of text follows (why it failed), then, if it was answered, the outputs.
struct CallResult {
  /// broken: a fresh process is needed
  enum class Status : std::uint8_t { answered, failed, broken } status = Status::answered;
  ListSizes counts{1};  ///< entries of the lists that the stage has
  double seconds = 0;   ///< time of the plug-in's function, the device's work included
};

/// The question: a stage of plugin_stages(), sizes, time limit; its arrays follow.
struct CallRequest {
  std::uint64_t stage = 0;     ///< its position in plugin_stages()
  QuestionSizes sizes;         ///< sizes of the question
  unsigned limit_seconds = 0;  ///< the worker ends itself soon after, in case no process is left to end it
};

/// Exit status of a worker that could not send its answer.
inline constexpr int worker_lost_socket = 70;

/// Adds the hidden subcommand.
void add_plugin_worker_command(CLI::App& app, CommandContext& context);

}  // namespace ogc::experiments
