// A scene of a generator with models that are not the default ones, for the stages that use all of them at once.
#pragma once

#include "compare/judge/cases/random.hpp"
#include "compare/problem/scene.hpp"

namespace ogc::compare {

/// Any activation and form of damping, any models of the bodies that have one, and up to three springs between
/// vertices, or a vertex and a point between two, of which at least one is free, with the pairs beside them left out or
/// not. The scene is rounded again.
void choose_models(Random& random, Scene& scene);

/// Such springs alone, with the pairs beside them left out or not; the scene is not rounded.
void add_springs(Random& random, Scene& scene);

/// The isometric model for every body with a bending energy.
void bend_isometrically(Scene& scene);

}  // namespace ogc::compare
