#include "compare/judge/loose.hpp"

namespace ogc::compare {

std::optional<std::string_view> reason_of_loose(Stage stage, std::string_view metric) {
  for (const LooseTolerance& listed : listed_loose)
    if (listed.stage == stage && listed.metric == metric) return listed.reason;
  return std::nullopt;
}

}  // namespace ogc::compare
