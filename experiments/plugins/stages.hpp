// Describes the stages that a plug-in can have: their input arrays, the C structures of compare/plugin.h that the
// worker builds from them, and the expected outputs. The judge's side (contestant.cpp) lists the arrays in the same
// order.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "compare/plugin.h"

namespace ogc::experiments {

/// Holds the sizes and numbers of a question, always in host memory.
struct QuestionSizes {
  std::int64_t cases = 0;                               ///< cases of a stage with independent cases
  std::int32_t vertices = 0, edges = 0, triangles = 0;  ///< sizes of a mesh
  float first = 0, second = 0;  ///< two numbers of a stage beside its arrays; for a detection r and r_q
  /// sizes of a scene, and of its rest state
  std::int32_t hinges = 0, bodies = 0, springs = 0, tetrahedra = 0;
  std::int32_t rest_triangles = 0, rest_hinges = 0, rest_tetrahedra = 0;
  std::int64_t vertex_facet = 0, edge_edge = 0;  ///< contacts that the question contains
  ogc_settings settings{};
  ogc_vec3 gravity{};
};

/// `Element` is the type of an output's elements. An output has one group of elements in all (`one`), or one for each
/// case (`item`), each vertex, …, each pair of bodies (`two_bodies`).
enum class Element : std::uint8_t { number, byte, index, real };
enum class Per : std::uint8_t { one, item, vertex, edge, triangle, two_bodies };
/// Lists of outputs whose length the plug-in determines.
enum class List : std::uint8_t {
  none,
  vertex_facet,
  edge_edge,
  triangles,
  hinges,
  tetrahedra,
  events,
  detections,
  planes,
  volume_contacts
};
inline constexpr std::size_t list_count = 10;
/// Length or capacity of each list; 1 for `none`, which is no list.
using ListSizes = std::array<std::int64_t, list_count>;

/// Describes one output array of a stage.
struct OutputInfo {
  std::string_view name;   ///< name in compare/plugin.h
  Element element;         ///< type of the array
  std::size_t elements;    ///< number of elements per group
  Per per;                 ///< what has one group of elements
  List list = List::none;  ///< if not `none`: the output has these groups for each entry of this list
};

/// Returns the size of one element [bytes]. `group_bytes` returns the size of one group [bytes].
constexpr std::size_t bytes_of(Element element) {
  return element == Element::byte ? 1 : element == Element::real ? 8 : 4;
}
constexpr std::size_t group_bytes(const OutputInfo& info) { return bytes_of(info.element) * info.elements; }
/// Returns the number of groups in the output (see Per and OutputInfo::list).
std::size_t groups(const OutputInfo& info, const QuestionSizes& sizes, const ListSizes& lists);
/// Returns the capacities of the lists at the first call.
ListSizes first_capacities(const QuestionSizes& sizes);
/// Returns upper limits of the lengths of the lists in a correct answer; never below first_capacities.
ListSizes most_entries(const QuestionSizes& sizes);
/// Returns the name of the list's entries, in the plural.
std::string_view list_name(List list);

/// Provides the arrays of one call, one after another.
class CallArrays {
 public:
  /// Holds a pointer that converts to the type to which it is assigned.
  template <class Void>
  struct Any {
    Void* data;
    template <class T>
    operator T*() const {
      return static_cast<T*>(data);
    }
  };

  CallArrays(const QuestionSizes& of, std::span<const void* const> inputs, std::span<void* const> outputs,
             const ListSizes& room)
      : sizes(of), capacities(room), inputs_(inputs), outputs_(outputs) {}
  Any<const void> in() { return {inputs_[next_input_++]}; }
  Any<void> out() { return {outputs_[next_output_++]}; }

  std::int64_t capacity(List list) const { return capacities[static_cast<std::size_t>(list)]; }
  std::int64_t& count(List list) { return counts[static_cast<std::size_t>(list)]; }

  const QuestionSizes& sizes;
  const ListSizes& capacities;
  ListSizes counts{1};  ///< counts that the plug-in returned

 private:
  std::span<const void* const> inputs_;
  std::span<void* const> outputs_;
  std::size_t next_input_ = 0, next_output_ = 0;
};

/// Describes one stage of compare/plugin.h.
struct PluginStage {
  std::string_view name;                            ///< name of the stage; its function is ogc_NAME
  std::size_t inputs;                               ///< number of input arrays
  std::span<const OutputInfo> outputs;              ///< in the order of the function's arguments
  int (*call)(void* function, CallArrays& arrays);  ///< calls the function and returns its result
};

/// Returns all stages.
std::span<const PluginStage> plugin_stages();

/// Returns the index of a stage in plugin_stages().
std::optional<std::size_t> find_plugin_stage(std::string_view name);

}  // namespace ogc::experiments
