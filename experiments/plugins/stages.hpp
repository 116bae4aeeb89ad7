// Lists the stages that a plug-in can have. The worker fills the C structures of a stage with the arrays of a question,
// member by member as structures.cpp describes them. The judge's side (contestant.cpp) lists the arrays in the same
// order.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "experiments/plugins/structures.hpp"

namespace ogc::experiments {

/// Length or capacity of each list; 1 for `none`, which is no list.
using ListSizes = std::array<std::int64_t, list_count>;

/// Describes one output array of a stage. An array of structures counts as one of their first member's type.
struct OutputInfo {
  std::string_view name;   ///< name in compare/plugin.h
  Element element;         ///< type of the array
  std::size_t elements;    ///< number of elements per group
  Per per;                 ///< what has one group of elements
  List list = List::none;  ///< if not `none`: the output has these groups for each entry of this list
};

/// Returns the size of one group [bytes].
constexpr std::size_t group_bytes(const OutputInfo& info) { return bytes_of(info.element) * info.elements; }
/// Returns the number of groups in the output (see Per and OutputInfo::list).
std::size_t groups(const OutputInfo& info, const QuestionSizes& sizes, const ListSizes& lists);
/// Returns the capacities of the lists at the first call.
ListSizes first_capacities(const QuestionSizes& sizes);
/// Returns upper limits of the lengths of the lists in a correct answer; never below first_capacities.
ListSizes most_entries(const QuestionSizes& sizes);
/// Returns the name of the list's entries, in the plural.
std::string_view list_name(List list);

/// Holds what one call of a plug-in's function needs besides its structures.
struct CallArrays {
  const QuestionSizes& sizes;           ///< numbers of the question
  std::span<const void* const> inputs;  ///< in the order of the structures' members
  std::span<void* const> outputs;       ///< in the order of the structures' members
  const ListSizes& capacities;          ///< room in the lists
};

/// Describes one stage of compare/plugin.h.
struct PluginStage {
  std::string_view name;            ///< name of the stage; its function is ogc_NAME
  const Structure* in;              ///< structure of the question
  const Structure* out;             ///< structure of the answer
  std::size_t inputs = 0;           ///< number of input arrays
  std::vector<OutputInfo> outputs;  ///< in the order of the structures' members
};

/// Result of a call.
struct CallReturn {
  int status = 0;       ///< what the function returned
  ListSizes counts{1};  ///< lengths of the lists; 1 for `none`
};

/// Fills both structures of a stage and calls the function with them.
CallReturn call_plugin(const PluginStage& stage, void* function, const CallArrays& arrays);

/// Returns all stages.
std::span<const PluginStage> plugin_stages();

/// Returns the index of a stage in plugin_stages().
std::optional<std::size_t> find_plugin_stage(std::string_view name);

}  // namespace ogc::experiments
