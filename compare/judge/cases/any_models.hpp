// A scene of a generator with models that are not the default ones, for the stages that use all of them at once.
#pragma once

#include <array>
#include <span>

#include "compare/judge/cases/random.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Any model but `none`.
template <class Model>
Model any_model(Random& random) {
  static_assert(Model::none == Model{});
  constexpr auto last = static_cast<int>(choice_count<Model>) - 1;
  return static_cast<Model>(last - random.below(last));
}

/// Any other than the usual one, and no `none`.
template <class Choice>
Choice another(Random& random, Choice usual) {
  std::array<Choice, choice_count<Choice>> others{};
  std::size_t count = 0;
  for (const Choice choice : choices<Choice>)
    if (choice != usual && name_of(choice) != "none") others[count++] = choice;
  return count == 1 ? others[0] : random.pick(std::span<const Choice>(others.data(), count));
}

/// Any activation and form of damping, any models of the bodies that have one, and up to three springs between
/// vertices, or a vertex and a point between two, of which at least one is free, with the pairs beside them left out or
/// not. The scene is rounded again.
void choose_models(Random& random, Scene& scene);

/// Such springs alone, with the pairs beside them left out or not; the scene is not rounded.
void add_springs(Random& random, Scene& scene);

/// Gives each body with a bending energy another model than hinges.
void bend_otherwise(Random& random, Scene& scene);

}  // namespace ogc::compare
