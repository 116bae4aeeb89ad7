// Builds a scene from a mesh file alone: cloth, or a solid, that falls onto a ground, with settings derived from the
// mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/files/scenes/scene_files.hpp"
#include "experiments/program/mesh_input.hpp"

namespace ogc::experiments {

/// Returns the default height of the fall: a tenth of the mesh's size [m].
double default_fall(const compare::Mesh& mesh);

/// Returns the smallest y of the mesh [m].
double lowest_point(const compare::Mesh& mesh);

/// Returns a scene with the mesh of `file` as body "cloth" (scenes/materials.hpp, `layer_cloth`) above a fixed square,
/// body "ground", at the height y = `ground` [m], three times as wide as the mesh. Without `ground` it lies
/// `default_fall` below the mesh. A mesh with tetrahedra is body "solid" (`soft_rubber`, changed by the solid_…
/// constants among `assignments`, each "key=value"). Gravity pulls along −y. Radius, stiffness, step and iterations are
/// those of `suggest`, and are logged with their reasons. The run lasts half a second longer than the fall, so that the
/// body comes to rest, and at least one second. Throws compare::InputError for a mesh that can't be used, that has
/// loose edges, or that is not above the ground.
compare::SceneFile mesh_scene(const std::string& file, const compare::MeshOptions& options,
                              std::optional<double> ground, const std::vector<std::string>& assignments = {});

}  // namespace ogc::experiments
