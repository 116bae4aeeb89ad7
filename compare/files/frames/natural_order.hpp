// Orders file names as people count: frame_2 before frame_10, with any number of leading zeros.
#pragma once

#include <string_view>

namespace ogc::compare {

/// Returns whether `a` comes before `b`: runs of digits compare as numbers, everything else byte by byte; if names
/// differ only in leading zeros, the one with fewer comes first. A strict total order.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace ogc::compare
