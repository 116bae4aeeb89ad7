// Lists the inputs of a case by name and unit, for printing and for other programs.
#pragma once

#include <string>
#include <vector>

#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// A number, a name, or a list of either. `labels` name the entries of a list if their indices are not clear enough.
struct Quantity {
  std::string name, unit{};           ///< "m", "N/m", "1" for a pure number, "" for names, indices and flags
  std::size_t width = 1;              ///< numbers in each entry: 3 for points
  std::vector<double> numbers{};      ///< entry after entry
  std::vector<std::string> words{};   ///< one for each entry, instead of numbers
  std::vector<std::string> labels{};  ///< one for each entry; may be empty
  bool is_list = false;               ///< distinguishes a list of one entry from a single value

  /// Returns the number of entries: groups of `width` numbers, or words.
  std::size_t entries() const { return words.empty() ? numbers.size() / width : words.size(); }
};

/// Returns the inputs in the order of the case's contract (compare/stages). Inputs of a scene are its mesh, bodies,
/// settings and states.
std::vector<Quantity> inputs_of(const TestCase& test);

}  // namespace ogc::compare
