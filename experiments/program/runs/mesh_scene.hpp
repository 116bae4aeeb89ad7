// A scene for a mesh file alone: cloth, or a solid, that falls on a ground, with settings that follow from the mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/files/scenes/scene_files.hpp"
#include "experiments/program/mesh_input.hpp"

namespace ogc::experiments {

/// How far a mesh falls where nobody says: a tenth of its size [m].
double default_fall(const compare::Mesh& mesh);

/// The smallest y of the mesh [m].
double lowest_point(const compare::Mesh& mesh);

/// The mesh of `file` as body "cloth" (scenes/materials.hpp, `layer_cloth`) above a fixed square, body "ground", at the
/// height y = `ground` [m], three times as wide as the mesh; without `ground` `default_fall` below it. A mesh with
/// tetrahedra is body "solid" (`soft_rubber`, but for the solid_… constants among `assignments`, each "key=value").
/// Gravity pulls along −y. Radius, stiffness, step and iterations are those of `suggest`, and are said on standard
/// error with their reasons; it runs until what fell has had half a second to come to rest, at least for a second.
/// Throws compare::InputError for a mesh that can't be used, with loose edges, or not above the ground.
compare::SceneFile mesh_scene(const std::string& file, const compare::MeshOptions& options,
                              std::optional<double> ground, const std::vector<std::string>& assignments = {});

}  // namespace ogc::experiments
