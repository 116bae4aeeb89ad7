// Replaces the default models of a generated scene, for the stages that use all models at once.
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

/// Returns any choice except `usual` and `none`.
template <class Choice>
Choice another(Random& random, Choice usual) {
  std::array<Choice, choice_count<Choice>> others{};
  std::size_t count = 0;
  for (const Choice choice : choices<Choice>)
    if (choice != usual && name_of(choice) != "none") others[count++] = choice;
  return count == 1 ? others[0] : random.pick(std::span<const Choice>(others.data(), count));
}

/// Sets a random activation and, in one of three scenes, DampingForm::per_vertex. Replaces each membrane and bending
/// model of a body, except `none`, by a random model. Adds springs by add_springs and rounds the scene again.
void choose_models(Random& random, Scene& scene);

/// Adds up to three springs, each between two vertices, or between a vertex and a point between two other vertices. At
/// least one of the first two vertices of a spring is free. In half of the cases excludes the pairs of vertices that
/// springs connect. Does not round the scene.
void add_springs(Random& random, Scene& scene);

/// Replaces the bending model of each body that bends by a random model other than discrete hinges.
void bend_otherwise(Random& random, Scene& scene);

}  // namespace ogc::compare
