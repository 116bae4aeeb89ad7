// Meshes that users bring: the options of all commands that take one, and the way from the file to a mesh that is named
// as the file counts it.
#pragma once

#include <string>
#include <vector>

#include "compare/files/meshes/polygon_mesh.hpp"
#include "compare/problem/element_names.hpp"
#include "experiments/program/commands.hpp"

namespace ogc::experiments {

/// A valid mesh and what its elements are called.
struct MeshInput {
  compare::Mesh mesh;           ///< as stages see it
  compare::MeshSource source;   ///< where its elements stand in the file
  compare::ElementNames names;  ///< what messages call them
  compare::Vec3 origin{};       ///< what positions are relative to, in the file's coordinates [m]
};

/// Adds --triangulate, --drop-unused (both on unless refused), --strict and --weld. The options must outlive the
/// parsing.
void add_mesh_options(CLI::App& command, compare::MeshOptions& options);

/// What was taken otherwise than it stands in the file, or should be known of it, a sentence each: what was cut, merged
/// and left out, vertices at one position, dust and what became of it (`dust_treatment`).
std::vector<std::string> words_about(const compare::LoadedMesh& loaded, const std::string& dust_treatment);

/// Reads a mesh file as stages see it: relative to a point near it where it is far from 0, dust is 0, coordinates are
/// rounded to single precision. Says on standard error what `words_about` finds. Throws compare::InputError that names
/// the file and, as the file counts them, the elements that no mesh may have (compare::validate).
MeshInput read_mesh_input(const std::string& file, const compare::MeshOptions& options);

/// Throws compare::InputError that names the tetrahedra that are flat or inverted: a solid of them can't be simulated.
void expect_solid(const MeshInput& input);

}  // namespace ogc::experiments
