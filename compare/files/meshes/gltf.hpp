// Reads glTF 2: .gltf with buffers in base64 or in files beside it, and .glb.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// Returns the triangles of all nodes of the file's scene, one after the other, in the scene's coordinates. Lines
/// become loose edges; points and other scenes are left out, with a note. Vertices that no face of a primitive uses are
/// left out; different primitives share no vertices.
///
/// `name` is the file's path. It begins the errors, and buffers in other files are looked for beside it. Throws
/// InputError that names the primitive and its face, the accessor, view, buffer or node: an index out of range, data
/// beyond their buffer, a node that is its own ancestor or has two parents, a coordinate that is not finite, compressed
/// or sparse data, glTF 1.
PolygonMesh parse_gltf(std::string_view bytes, const std::string& name);

}  // namespace ogc::compare
