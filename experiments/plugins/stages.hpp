// The stages that a plug-in can have: their arrays, how the worker makes the C structures of compare/plugin.h from them, and what it
// expects back. The judge's side (contestant.cpp) names the same arrays in the same order.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "compare/plugin.h"

namespace ogc::experiments {

/// The sizes and numbers of a question; in host memory always.
struct QuestionSizes {
  std::int64_t cases = 0;
  std::int32_t vertices = 0, edges = 0, triangles = 0;
  float first = 0, second = 0;
  friend bool operator==(const QuestionSizes&, const QuestionSizes&) = default;
};

/// What the elements of an output are, and of what there is one group of them.
enum class Element : std::uint8_t { number, byte, index };
enum class Per : std::uint8_t { item, vertex, edge, triangle, contact };

struct OutputInfo {
  std::string_view name;
  Element element;
  std::size_t elements;  ///< in a group
  Per per;
};

/// Bytes of one element, and of one group.
constexpr std::size_t bytes_of(Element element) { return element == Element::byte ? 1 : 4; }
constexpr std::size_t group_bytes(const OutputInfo& info) { return bytes_of(info.element) * info.elements; }
/// How many groups there are; for contacts `contacts`.
std::size_t groups(const OutputInfo& info, const QuestionSizes& sizes, std::int64_t contacts);

/// The arrays of one call, taken one after another.
class CallArrays {
 public:
  /// A pointer that becomes what it is assigned to.
  template <class Void>
  struct Any {
    Void* data;
    template <class T>
    operator T*() const {
      return static_cast<T*>(data);
    }
  };

  CallArrays(const QuestionSizes& of, std::span<const void* const> inputs, std::span<void* const> outputs, std::int64_t room)
      : sizes(of), capacity(room), inputs_(inputs), outputs_(outputs) {}
  Any<const void> in() { return {inputs_[next_input_++]}; }
  Any<void> out() { return {outputs_[next_output_++]}; }

  const QuestionSizes& sizes;
  const std::int64_t capacity;  ///< of the list of contacts
  std::int64_t count = 0;       ///< of contacts, as the plug-in says

 private:
  std::span<const void* const> inputs_;
  std::span<void* const> outputs_;
  std::size_t next_input_ = 0, next_output_ = 0;
};

struct PluginStage {
  std::string_view name;    ///< of the stage; its function is ogc_NAME
  std::size_t inputs;       ///< how many arrays
  std::span<const OutputInfo> outputs;
  int (*call)(void* function, CallArrays& arrays);  ///< what the function returned
};

std::span<const PluginStage> plugin_stages();

/// Position in plugin_stages().
std::optional<std::size_t> find_plugin_stage(std::string_view name);

}  // namespace ogc::experiments
