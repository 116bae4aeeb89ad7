// Formats that assimp reads for us: STL, OFF, glTF. It holds coordinates in single precision, which is what stages see.
#pragma once

#include <filesystem>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Whether this program was built with assimp.
bool has_assimp();

/// All meshes of a file, one after the other, with the transforms of the file's nodes (glTF), with faces
/// counted from 0 through all of them; lines become loose edges, points are left out. `shares_vertices`: the file's
/// faces name vertices by number (OFF), so that vertices are counted, too. Throws InputError with assimp's reason where
/// it can't be read, or where this program was built without assimp: then with what to install.
PolygonMesh read_with_assimp(const std::filesystem::path& path, bool shares_vertices);

}  // namespace ogc::compare
