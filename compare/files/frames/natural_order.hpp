// The order in which people count files: frame_2 before frame_10, however many zeros stand in front.
#pragma once

#include <string_view>

namespace ogc::compare {

/// Whether `a` comes before `b`: runs of digits compare as numbers, everything else byte by byte; of names that differ
/// in leading zeros alone the one with fewer comes first. A strict total order.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace ogc::compare
