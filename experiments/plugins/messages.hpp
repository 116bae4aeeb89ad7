// What a worker says, block by block. Each length, code and count is checked against the question before anything is
// done with it: the plug-in shares the worker's process, and may have written any of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/plugins/channel.hpp"
#include "experiments/plugins/worker.hpp"

namespace ogc::experiments {

/// The next block; throws MalformedBlock where it has no allowed length, and whatever else where there is none.
using NextBlock = std::function<std::vector<std::byte>(BlockLength allowed)>;

/// What a worker says of the library that it has loaded.
struct Greeting {
  LoadStatus status = LoadStatus::loaded;  ///< what became of the library
  std::string text;                        ///< the plug-in's name, or why it was not loaded
  std::vector<std::uint8_t> has;  ///< of plugin_stages(), where it was loaded: 1 where the library has the stage
};

/// What a worker says of one question.
struct WorkerAnswer {
  CallResult result;  ///< what the call came to
  std::string why;    ///< where it was not answered
  std::vector<std::vector<std::byte>>
      outputs;  ///< of the stage, in its order, as long as the counts and the question's sizes say
};

/// Throw MalformedBlock that says what is wrong with a message.
Greeting read_greeting(const NextBlock& next);
WorkerAnswer read_answer(const NextBlock& next, const PluginStage& stage, const QuestionSizes& sizes);

/// A text as it may be sent: its first most_text bytes.
inline constexpr std::uint64_t most_text = 1 << 16;
std::string short_enough(std::string text);

}  // namespace ogc::experiments
