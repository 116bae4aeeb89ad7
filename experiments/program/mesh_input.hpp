// Reads users' meshes: declares the options of all commands that take a mesh file, and turns the file into a mesh whose
// elements are named by the file's own numbers.
#pragma once

#include <string>
#include <vector>

#include "compare/files/meshes/polygon_mesh.hpp"
#include "compare/problem/element_names.hpp"
#include "experiments/program/commands.hpp"

namespace ogc::experiments {

/// Holds a valid mesh and the names of its elements.
struct MeshInput {
  compare::Mesh mesh;           ///< mesh in the form that stages require
  compare::MeshSource source;   ///< numbers of its elements in the file
  compare::ElementNames names;  ///< names of its elements in messages
  compare::Vec3 origin{};       ///< origin of the positions, in the file's coordinates [m]
};

/// Adds --triangulate and --drop-unused (both on by default), --strict and --weld. `options` must outlive the parsing.
void add_mesh_options(CLI::App& command, compare::MeshOptions& options);

/// Returns one sentence for each change to the file's mesh and for each likely problem: cut faces, merged or dropped
/// elements, vertices at one position, and dust (tiny numbers in place of 0, compare/problem/dust.hpp).
/// `dust_treatment`: what is done with dust, in words.
std::vector<std::string> words_about(const compare::LoadedMesh& loaded, const std::string& dust_treatment);

/// Reads a mesh file in the form that stages require. If the mesh is far from 0, its positions become relative to a
/// point near it. Dust (tiny numbers in place of 0) is set to 0, and coordinates are rounded to single precision. Logs
/// the sentences of `words_about`. Throws compare::InputError that names the file and, by the file's numbers, the
/// elements that are not allowed (compare::validate).
MeshInput read_mesh_input(const std::string& file, const compare::MeshOptions& options);

/// Throws compare::InputError that names flat or inverted tetrahedra, because a solid with them can't be simulated.
void expect_solid(const MeshInput& input);

}  // namespace ogc::experiments
