// assimp parses and nothing else: it would merge, cut and drop elements by tolerances, without a word.
#include "compare/files/meshes/assimp_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "compare/problem/error.hpp"

#ifdef OGC_HAS_ASSIMP
#include <assimp/config.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>
#endif

namespace ogc::compare {

#ifdef OGC_HAS_ASSIMP

namespace {

class SceneCollector {
 public:
  SceneCollector(const aiScene& scene, PolygonMesh& mesh) : scene_(scene), mesh_(mesh) {}

  void collect(const aiNode& node, const aiMatrix4x4& parent) {
    const aiMatrix4x4 transform = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene_.mMeshes[node.mMeshes[i]], transform);
    for (unsigned i = 0; i < node.mNumChildren; ++i) collect(*node.mChildren[i], transform);
  }

 private:
  void add(const aiMesh& part, const aiMatrix4x4& transform) {
    const auto first = static_cast<Index>(mesh_.positions.size());
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D p = transform * part.mVertices[v];
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw InputError(mesh_.source.file + ": vertex " + std::to_string(mesh_.positions.size()) +
                         ": a coordinate is not finite; give three finite numbers [m]");
      mesh_.positions.push_back({p.x, p.y, p.z});
    }
    std::vector<Index> corners;
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      corners.clear();
      for (unsigned k = 0; k < face.mNumIndices; ++k) corners.push_back(first + static_cast<Index>(face.mIndices[k]));
      if (corners.size() == 2)
        mesh_.loose_edges.push_back({std::min(corners[0], corners[1]), std::max(corners[0], corners[1])});
      if (corners.size() > 2) mesh_.add_face(corners);
    }
  }

  const aiScene& scene_;
  PolygonMesh& mesh_;
};

}  // namespace

bool has_assimp() { return true; }

PolygonMesh read_with_assimp(const std::filesystem::path& path, bool shares_vertices) {
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path.string(), 0);
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw InputError(path.string() + ": can't be read: " + importer.GetErrorString());
  PolygonMesh mesh;
  mesh.source.file = path.string();
  mesh.source.shares_vertices = shares_vertices;
  SceneCollector(*scene, mesh).collect(*scene->mRootNode, aiMatrix4x4());
  return mesh;
}

#else

bool has_assimp() { return false; }

PolygonMesh read_with_assimp(const std::filesystem::path& path, bool) {
  throw InputError(path.string() + ": this ogc was built without assimp, which reads '" + path.extension().string() +
                   "': install it (Debian, Ubuntu: apt-get install libassimp-dev) and build again, "
                   "or convert the mesh to .ply or .obj");
}

#endif

}  // namespace ogc::compare
