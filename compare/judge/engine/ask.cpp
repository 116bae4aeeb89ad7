#include "compare/judge/engine/ask.hpp"

#include "compare/judge/cases/stage_traits.hpp"

namespace ogc::compare {

void ask(Stage stage, Cases cases, const Contestant& contestant, const Authority& authority,
         std::mutex& contestant_turn, Tally& tally) {
  if (cases.empty()) return;
  Asker asker(contestant_turn, tally);
  traits_of(stage).ask(cases, contestant, authority, asker, tally);
}

}  // namespace ogc::compare
