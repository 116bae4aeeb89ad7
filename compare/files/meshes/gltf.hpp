// This reads glTF 2: .gltf with buffers in base64 or in files beside it, and .glb.
#pragma once

#include <string>
#include <string_view>

#include "compare/files/meshes/polygon_mesh.hpp"

namespace ogc::compare {

/// The triangles of all nodes of the file's scene, one after the other, in the scene's coordinates; lines become loose
/// edges, points are left out with a word, and so are other scenes. Corners that a primitive's faces don't name are
/// left out; vertices of different primitives are not shared. `name` is the file's path: it stands in the errors, and
/// buffers stand beside it. Throws InputError that names the primitive and its face, the accessor, view, buffer or
/// node: an index out of range, data beyond their buffer, a node that is its own ancestor or has two parents, a
/// coordinate that is not finite, compressed or sparse data, glTF 1.
PolygonMesh parse_gltf(std::string_view bytes, const std::string& name);

}  // namespace ogc::compare
