// Lists the inputs of a case by name and unit, for people and for other programs.
#pragma once

#include <string>
#include <vector>

#include "compare/judge/cases/cases.hpp"

namespace ogc::compare {

/// A number, a name, or a list of either. `labels` name the entries of a list, where their numbers do not say enough.
struct Quantity {
  std::string name, unit{};           ///< "m", "N/m", "1" for a pure number, "" for names, indices and flags
  std::size_t width = 1;              ///< numbers of an entry: 3 for points
  std::vector<double> numbers{};      ///< entry after entry
  std::vector<std::string> words{};   ///< one an entry, in place of numbers
  std::vector<std::string> labels{};  ///< one an entry, or none
  bool is_list = false;               ///< a list may have one entry, or none

  /// Returns the number of entries, which are numbers or words.
  std::size_t entries() const { return words.empty() ? numbers.size() / width : words.size(); }
};

/// Returns the inputs in the order of the case's contract (compare/stages); of scenes mesh, bodies, settings and
/// states.
std::vector<Quantity> inputs_of(const TestCase& test);

}  // namespace ogc::compare
