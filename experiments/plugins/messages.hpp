// Reads a worker's messages, block by block. Each length, code and count is checked against the question before it is
// used: the plug-in shares the worker's process, and may have written any of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/plugins/channel.hpp"
#include "experiments/plugins/worker.hpp"

namespace ogc::experiments {

/// Returns the next block; throws MalformedBlock if its length is not allowed, and its own error if there is none.
using NextBlock = std::function<std::vector<std::byte>(BlockLength allowed)>;

/// A worker's message about the library that it has loaded.
struct Greeting {
  LoadStatus status = LoadStatus::loaded;  ///< result of loading
  std::string text;                        ///< the plug-in's name, or why it was not loaded
  std::vector<std::uint8_t> has;  ///< by plugin_stages(), if it was loaded: 1 if the library has the stage
};

/// A worker's answer to one question.
struct WorkerAnswer {
  CallResult result;  ///< outcome of the call
  std::string why;    ///< reason, if it was not answered
  std::vector<std::vector<std::byte>>
      outputs;  ///< of the stage, in its order, as long as the counts and the question's sizes say
};

/// Read a message; throw MalformedBlock that says what is wrong with it.
Greeting read_greeting(const NextBlock& next);
WorkerAnswer read_answer(const NextBlock& next, const PluginStage& stage, const QuestionSizes& sizes);

/// Longest text [bytes]; short_enough() cuts a text to it.
inline constexpr std::uint64_t most_text = 1 << 16;
std::string short_enough(std::string text);

}  // namespace ogc::experiments
