// Gives a generator's scene models that are not the default ones, for the stages that use all of them at once.
#pragma once

#include <array>
#include <span>

#include "compare/judge/cases/random.hpp"
#include "compare/problem/names.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Returns any model but `none`.
template <class Model>
Model any_model(Random& random) {
  static_assert(Model::none == Model{});
  constexpr auto last = static_cast<int>(choice_count<Model>) - 1;
  return static_cast<Model>(last - random.below(last));
}

/// Returns any choice but the usual one and `none`.
template <class Choice>
Choice another(Random& random, Choice usual) {
  std::array<Choice, choice_count<Choice>> others{};
  std::size_t count = 0;
  for (const Choice choice : choices<Choice>)
    if (choice != usual && name_of(choice) != "none") others[count++] = choice;
  return count == 1 ? others[0] : random.pick(std::span<const Choice>(others.data(), count));
}

/// Sets any activation and form of damping, and any models of the bodies that have one. Adds up to three springs
/// between vertices, or between a vertex and a point between two; at least one of the first two vertices is free. The
/// pairs beside the springs are left out or not. The scene is rounded again.
void choose_models(Random& random, Scene& scene);

/// Adds the springs of choose_models alone, with the pairs beside them left out or not; the scene is not rounded.
void add_springs(Random& random, Scene& scene);

/// Gives each body with a bending energy another model than hinges.
void bend_otherwise(Random& random, Scene& scene);

}  // namespace ogc::compare
