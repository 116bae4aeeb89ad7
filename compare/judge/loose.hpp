// Tolerances that no error of ours comes near. Each is either tightened or stands here with its reason: a test holds
// the list to what is seen, both ways.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "compare/judge/stage.hpp"

namespace ogc::compare {

struct LooseTolerance {
  Stage stage = Stage::bound;
  std::string_view metric, reason;
};

inline constexpr std::array<LooseTolerance, 1> listed_loose{
    {{Stage::bound, "bound",
      "ours is the exact product, rounded down: its error is 0. Other errors are whole units in the last place, 1 or 2 "
      "u b each, of which 4 u b accepts the first ones only"}}};

/// Why the metric may be loose; nothing where it is not listed.
std::optional<std::string_view> reason_of_loose(Stage stage, std::string_view metric);

}  // namespace ogc::compare
