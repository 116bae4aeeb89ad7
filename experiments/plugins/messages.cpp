#include "experiments/plugins/messages.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace ogc::experiments {

namespace {

/// Returns an item with the received bytes. The caller checks its members.
template <class Item>
Item item(const NextBlock& next) {
  Item item;
  const std::vector<std::byte> block = next(exactly(sizeof item));
  std::memcpy(&item, block.data(), sizeof item);
  return item;
}

std::string text(const NextBlock& next) { return text_of(next({0, most_text})); }

template <class Code>
void check_code(Code code, Code last, const char* what) {
  if (code > last) throw MalformedBlock("holds " + std::to_string(static_cast<unsigned>(code)) + " as the " + what);
}

void check(const CallResult& result, const QuestionSizes& sizes) {
  check_code(result.status, CallResult::Status::broken, "outcome of a call");
  if (!(result.seconds >= 0) || std::isinf(result.seconds)) throw MalformedBlock("holds a time that is none");
  if (result.status != CallResult::Status::answered) return;
  const ListSizes most = most_entries(sizes);
  for (std::size_t k = 0; k < list_count; ++k)
    if (result.counts[k] < 0 || result.counts[k] > most[k])
      throw ImpossibleCount("counts " + std::to_string(result.counts[k]) + " " +
                            std::string(list_name(static_cast<List>(k))) + ", at most " + std::to_string(most[k]) +
                            " being possible");
  if (result.counts[0] != most[0]) throw MalformedBlock("counts nothing where one is due");
}

}  // namespace

Greeting read_greeting(const NextBlock& next) {
  Greeting greeting;
  greeting.status = item<LoadStatus>(next);
  check_code(greeting.status, LoadStatus::failed, "outcome of loading");
  greeting.text = text(next);
  if (greeting.status != LoadStatus::loaded) return greeting;
  const std::vector<std::byte> has = next(exactly(plugin_stages().size()));
  std::transform(has.begin(), has.end(), std::back_inserter(greeting.has),
                 [](std::byte b) { return static_cast<std::uint8_t>(b); });
  return greeting;
}

WorkerAnswer read_answer(const NextBlock& next, const PluginStage& stage, const QuestionSizes& sizes) {
  WorkerAnswer answer;
  answer.result = item<CallResult>(next);
  check(answer.result, sizes);
  answer.why = text(next);
  if (answer.result.status != CallResult::Status::answered) return answer;
  for (const OutputInfo& info : stage.outputs)
    answer.outputs.push_back(next(exactly(group_bytes(info) * groups(info, sizes, answer.result.counts))));
  return answer;
}

std::string short_enough(std::string text) {
  text.resize(std::min<std::size_t>(text.size(), most_text));
  return text;
}

}  // namespace ogc::experiments
