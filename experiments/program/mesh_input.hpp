// Reads meshes of users: the options of all commands that take a mesh file, and the way from the file to a mesh whose
// elements are named with the file's own numbers.
#pragma once

#include <string>
#include <vector>

#include "compare/files/meshes/polygon_mesh.hpp"
#include "compare/problem/element_names.hpp"
#include "experiments/program/commands.hpp"

namespace ogc::experiments {

/// Holds a valid mesh and the names of its elements.
struct MeshInput {
  compare::Mesh mesh;           ///< as stages get it
  compare::MeshSource source;   ///< the numbers of its elements in the file
  compare::ElementNames names;  ///< the names of its elements in messages
  compare::Vec3 origin{};       ///< origin of the positions, in the file's coordinates [m]
};

/// Adds --triangulate, --drop-unused (both on by default), --strict and --weld. The options must outlive the parsing.
void add_mesh_options(CLI::App& command, compare::MeshOptions& options);

/// Returns one sentence for each thing that was taken differently from the file or that a user should know: faces that
/// were cut, elements that were merged or left out, vertices at one position, dust and how it is treated
/// (`dust_treatment`).
std::vector<std::string> words_about(const compare::LoadedMesh& loaded, const std::string& dust_treatment);

/// Reads a mesh file as stages get it: relative to a point near it if it is far from 0, dust set to 0, coordinates
/// rounded to single precision. Logs what `words_about` finds. Throws compare::InputError that names the file and, with
/// the file's numbers, the elements that no mesh may have (compare::validate).
MeshInput read_mesh_input(const std::string& file, const compare::MeshOptions& options);

/// Throws compare::InputError that names the flat or inverted tetrahedra, because a solid with them can't be simulated.
void expect_solid(const MeshInput& input);

}  // namespace ogc::experiments
