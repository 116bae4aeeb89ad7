// Orders file names by their numbers: frame_2 before frame_10, with any number of leading zeros.
#pragma once

#include <string_view>

namespace ogc::compare {

/// Returns whether `a` comes before `b`, in a strict total order. Runs of digits compare as numbers, everything else
/// byte by byte. If names differ only in leading zeros, the name with fewer zeros comes first.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace ogc::compare
