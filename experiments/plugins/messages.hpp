// Reads a worker's messages, block by block. The plug-in shares the worker's process and may have written any of it.
// Each length, code and count is therefore checked against the question before it is used.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/plugins/channel.hpp"
#include "experiments/plugins/worker.hpp"

namespace ogc::experiments {

/// Function that returns the next block. It throws MalformedBlock if the block's length is not allowed, and another
/// error if no block arrives.
using NextBlock = std::function<std::vector<std::byte>(BlockLength allowed)>;

/// Holds a worker's message about the library that it has loaded.
struct Greeting {
  LoadStatus status = LoadStatus::loaded;  ///< result of loading
  std::string text;                        ///< the plug-in's name, or why it was not loaded
  /// for each of plugin_stages(): 1 if the library has this stage, else 0; empty if the library was not loaded
  std::vector<std::uint8_t> has;
};

/// Holds a worker's answer to one question.
struct WorkerAnswer {
  CallResult result;  ///< outcome of the call
  std::string why;    ///< the reason if the question was not answered
  std::vector<std::vector<std::byte>>
      outputs;  ///< outputs of the stage, in its order; the counts and the question's sizes determine their lengths
};

/// Thrown if an answer counts more entries of a list than are possible. what() completes the sentence "it …".
struct ImpossibleCount : MalformedBlock {
  using MalformedBlock::MalformedBlock;
};

/// read_greeting and read_answer read a message. Both throw MalformedBlock, which describes what is wrong with the
/// message.
Greeting read_greeting(const NextBlock& next);
WorkerAnswer read_answer(const NextBlock& next, const PluginStage& stage, const QuestionSizes& sizes);

/// Largest length of a text [bytes]; short_enough() cuts a text to this length.
inline constexpr std::uint64_t most_text = 1 << 16;
std::string short_enough(std::string text);

}  // namespace ogc::experiments
