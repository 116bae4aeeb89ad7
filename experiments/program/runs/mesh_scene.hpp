// Builds a scene from a single mesh file: cloth or a solid falls onto a ground, with settings derived from the mesh.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/files/scenes/scene_files.hpp"
#include "experiments/program/mesh_input.hpp"

namespace ogc::experiments {

/// Returns the default height of the fall [m], a tenth of the mesh's size.
double default_fall(const compare::Mesh& mesh);

/// Returns the smallest y of the mesh [m].
double lowest_point(const compare::Mesh& mesh);

/// Returns a scene in which the mesh of `file` falls onto body "ground", a fixed square three times as wide as the
/// mesh. A mesh of triangles is body "cloth" (scenes/materials.hpp, `layer_cloth`). A mesh with tetrahedra is body
/// "solid" (`soft_rubber`, changed by the solid_… constants among `assignments`, each "key=value"). The ground lies at
/// y = `ground` [m], by default `default_fall` below the mesh; gravity acts along −y. `suggest` gives the contact
/// radius, the contact stiffness, the time step and the number of iterations, which are logged with their reasons. The
/// run lasts half a second longer than the fall, so that the body comes to rest, and at least one second. Throws
/// compare::InputError if the mesh can't be used, has loose edges, or is not above the ground.
compare::SceneFile mesh_scene(const std::string& file, const compare::MeshOptions& options,
                              std::optional<double> ground, const std::vector<std::string>& assignments = {});

}  // namespace ogc::experiments
